"""LightSensor: brightness of lamps."""

import math

import pytest

from ai4u_edu import CircleShape, LightSensor, World
from ai4u_edu.base.errors import BlockError
from tests.builders import small_sim


def brightness(*lamps: tuple[float, float], angle_deg: float = 0, reach: float = 5) -> float:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    for number, place in enumerate(lamps):
        shape = CircleShape(radius=0.3)
        world.add_body(f"lamp{number}", shape, position=place, tags=("lamp",))
    sensor = LightSensor(group="lamp", angle_deg=angle_deg, reach=reach)
    percept = small_sim([sensor], world=world).agents[0].percept
    assert percept["light"].shape == (1,)
    return float(percept["light"][0])


def test_half_as_bright_at_the_reach() -> None:
    assert brightness((5, 0)) == pytest.approx(0.5)
    assert brightness((3, 0), reach=3) == pytest.approx(0.5)
    assert brightness((10, 0)) == pytest.approx(0.2)


def test_an_eye_sees_its_own_side_best() -> None:
    at_left = (5 * math.cos(math.radians(40)), 5 * math.sin(math.radians(40)))
    assert brightness(at_left, angle_deg=40) == pytest.approx(0.5)
    assert brightness(at_left, angle_deg=-40) == pytest.approx(0.5 * math.cos(math.radians(80)))
    assert brightness((-5, 0)) == 0


def test_lamps_add_up_and_the_eye_is_dazzled_at_one() -> None:
    assert brightness((5, 0), (0, 5), (10, 0)) == pytest.approx(0.7)
    assert brightness((1.5, 0), (1.5, 1), (1.5, -1)) == 1


def test_what_fell_gives_no_light() -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("lamp", CircleShape(radius=0.3), position=(5, 0), tags=("lamp",))
    sim = small_sim([LightSensor(group="lamp")], world=world)
    world["lamp"].leave()
    assert sim.step()["light"].tolist() == [0.0]


def test_no_such_lamps() -> None:
    with pytest.raises(BlockError, match="no body carries the tag 'lmap'"):
        small_sim([LightSensor(group="lmap")])
