"""AreaOrientationSensor: kinds, directions and nearness of bodies, nearest first."""

import math
from typing import Any

import numpy as np
import pytest

from ai4u_edu import (
    AreaOrientationSensor,
    BoxShape,
    CircleShape,
    SegmentShape,
    Sensor,
    World,
)
from ai4u_edu.base.errors import BlockError
from tests.builders import small_sim

SMALL = CircleShape(radius=0.1)


def field(**places: tuple[float, float]) -> World:
    """A robot at the origin that faces +x, and small bodies around it."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    for name, place in places.items():
        world.add_body(name, SMALL, position=place, tags=("EMITTER", name[:4]))
    return world


def smelt(world: World, **fields: Any) -> list[list[float]]:
    sensor = AreaOrientationSensor(**fields)
    reading = small_sim([sensor], world=world).agents[0].percept["areasensor"]
    assert sensor.observation_space().contains(reading)
    return [triple for triple in reading.reshape(-1, 3).tolist() if any(triple)]


def test_kind_cosine_and_nearness_nearest_first() -> None:
    world = field(food1=(0, 4), bomb1=(-2, 0), food2=(0.7, 0))
    found = smelt(world, group_code={"food": 30, "bomb": 75})
    assert found == [
        pytest.approx([0.3, 1, 1], abs=1e-6),  # closer than min_distance: 1
        pytest.approx([0.75, -1, 1 / 2], abs=1e-6),
        pytest.approx([0.3, 0, 1 / 4], abs=1e-6),
    ]


def test_the_division_is_of_floats() -> None:
    found = smelt(field(food1=(3, 0)), group_code={"food": 1}, max_code_value=3)
    assert found == [pytest.approx([1 / 3, 1, 1 / 3])]


def test_nearness_grows_with_min_distance() -> None:
    assert smelt(field(food1=(3, 0)), min_distance=1.5) == [pytest.approx([0, 1, 0.5])]


def test_zeros_after_the_last_and_no_more_than_the_limit() -> None:
    places = {f"food{n}": (n + 1.0, 0.0) for n in range(5)}
    sensor = AreaOrientationSensor(max_detection_reported=3, visibility_test=False)
    reading = small_sim([sensor], world=field(**places)).agents[0].percept["areasensor"]
    assert reading.tolist() == pytest.approx([0, 1, 1, 0, 1, 1 / 2, 0, 1, 1 / 3])
    sensor = AreaOrientationSensor()
    reading = small_sim([sensor], world=field(food0=(2, 0))).agents[0].percept["areasensor"]
    assert reading.shape == (60,)
    assert reading.tolist() == pytest.approx([0, 1, 1 / 2] + [0] * 57)


@pytest.mark.parametrize("names", [("food1", "bomb1"), ("bomb1", "food1")])
def test_equally_near_ones_come_by_name(names: tuple[str, str]) -> None:
    places = dict(zip(names, [(0.0, 2.0), (0.0, -2.0)], strict=True))
    found = smelt(field(**places), group_code={"food": 100, "bomb": 50})
    assert [triple[0] for triple in found] == [0.5, 1.0]


def test_only_the_target_group_and_neither_oneself() -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5), tags=("EMITTER",))
    world.add_body("box", SMALL, position=(2, 0), tags=("target",))
    assert smelt(world) == []
    assert len(smelt(world, target_group="target")) == 1


@pytest.mark.parametrize(
    ("fields", "distances"),
    [
        ({}, [2, 3, 5]),
        ({"radius": 3}, [2, 3]),
        ({"radius": 2.99}, [2]),
        ({"area": "garden"}, [3, 5]),
        ({"area": "low"}, [2, 3]),
        ({"area": "low", "radius": 2.5}, [2]),
    ],
)
def test_radius_and_area(fields: dict[str, Any], distances: list[int]) -> None:
    world = field(food1=(2, 0), food2=(0, -3), food3=(0, 5))
    world.add_area("garden", BoxShape(size=(2, 12)))
    world.add_area("low", BoxShape(size=(12, 7)))
    assert [round(1 / each[2]) for each in smelt(world, **fields)] == distances


def test_what_is_hidden_is_not_smelt_unless_it_may_be() -> None:
    world = field(food1=(3, 0), food2=(0, 4))
    world.add_body("wall", SegmentShape(a=(2, -1), b=(2, 1)), kind="static")
    assert [round(1 / each[2]) for each in smelt(world)] == [4]
    assert [round(1 / each[2]) for each in smelt(world, visibility_test=False)] == [3, 4]


def test_a_hidden_one_takes_no_place_away() -> None:
    world = field(food1=(3, 0), food2=(0, 4))
    world.add_body("wall", SegmentShape(a=(2, -1), b=(2, 1)), kind="static")
    assert [round(1 / each[2]) for each in smelt(world, max_detection_reported=1)] == [4]


def test_another_one_looks() -> None:
    world = field(food1=(3, 0))
    world.add_body("tower", SMALL, position=(3, 2), heading_deg=-90, tags=("EMITTER",))
    assert smelt(world, reference="tower") == [pytest.approx([0, 1, 1 / 2])]


def test_what_fell_out_of_the_world_is_gone() -> None:
    world = field(food1=(2, 0), food2=(0, 30))
    world.add_floor("plate", BoxShape(size=(10, 10)))
    sim = small_sim([AreaOrientationSensor()], world=world)
    for _ in range(120):
        reading = sim.step()["areasensor"]
    assert world["food2"].fallen
    assert np.count_nonzero(reading.reshape(-1, 3)[:, 2]) == 1


def test_what_goes_out_of_reach_leaves_zeros_behind() -> None:
    world = field(food1=(2, 0), food2=(0, 2.5))
    sim = small_sim([AreaOrientationSensor(radius=3)], world=world)
    assert np.count_nonzero(sim.agents[0].percept["areasensor"].reshape(-1, 3)[:, 2]) == 2
    world["food2"].move_to(0, 5)
    assert sim.step()["areasensor"].tolist() == pytest.approx([0, 1, 1 / 2] + [0] * 57)


def test_the_cosine_is_that_of_the_bearing() -> None:
    angle = math.radians(50)
    place = (3 * math.cos(angle), 3 * math.sin(angle))
    assert smelt(field(food1=place)) == [pytest.approx([0, math.cos(angle), 1 / 3])]


@pytest.mark.parametrize(
    ("sensor", "text"),
    [
        (
            AreaOrientationSensor(area="gaden"),
            "agent '0', AreaOrientationSensor 'areasensor': no area is named 'gaden'; "
            "did you mean 'garden'?",
        ),
        (
            AreaOrientationSensor(target_group="foo"),
            "agent '0', AreaOrientationSensor 'areasensor': no body carries the tag 'foo'; "
            "did you mean 'food'?",
        ),
        (
            AreaOrientationSensor(reference="robt"),
            "agent '0', AreaOrientationSensor 'areasensor': no body is named 'robt'; "
            "did you mean 'robot'?",
        ),
    ],
)
def test_unknown_names(sensor: Sensor, text: str) -> None:
    world = field(food1=(2, 0))
    world.add_area("garden", BoxShape(size=(2, 2)))
    with pytest.raises(BlockError) as caught:
        small_sim([sensor], world=world)
    assert str(caught.value) == text


def test_a_code_beyond_the_largest_is_refused() -> None:
    with pytest.raises(BlockError) as caught:
        AreaOrientationSensor(group_code={"food": 101})
    assert str(caught.value) == (
        "AreaOrientationSensor 'areasensor': group_code: expected codes up to max_code_value "
        "(100), got 101 for 'food'"
    )
