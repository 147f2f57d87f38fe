"""Touch and ground sensors."""

from typing import Any

import pytest

from ai4u_edu import (
    BoxShape,
    CircleShape,
    ControlRequestor,
    GroundStatusSensor,
    GroupTouchSensor,
    Sensor,
    TouchSensor,
    World,
)
from ai4u_edu.base.errors import BlockError
from tests.builders import small_sim, small_world


def ahead(_percept: Any) -> dict[str, Any]:
    return {"move": [1, 0, 0, 0]}


def felt(sim: ControlRequestor, key: str, steps: int) -> list[float]:
    return [float(sim.step()[key][0]) for _ in range(steps)]


def test_touch_is_plus_one_from_the_tick_of_contact_on() -> None:
    sim = small_sim([TouchSensor(target="box")], controller=ahead)
    assert sim.agents[0].percept["touch"].tolist() == [-1.0]
    found = felt(sim, "touch", 100)
    first = found.index(1.0)
    assert first == pytest.approx(90, abs=2)  # 3 m at 2 m/s, 60 ticks a second
    assert set(found[:first]) == {-1.0}
    assert set(found[first:]) == {1.0}


def test_touch_ends_when_they_part() -> None:
    way = iter([1.0] * 100 + [-1.0] * 100)
    sim = small_sim(
        [TouchSensor(target="box")], controller=lambda percept: {"move": [next(way), 0, 0, 0]}
    )
    assert felt(sim, "touch", 100)[-1] == 1.0
    assert felt(sim, "touch", 20)[-1] == -1.0


def test_a_reset_clears_the_touch() -> None:
    sim = small_sim([TouchSensor(target="box")], controller=ahead)
    assert felt(sim, "touch", 100)[-1] == 1.0
    sim.reset()
    assert sim.agents[0].percept["touch"].tolist() == [-1.0]


def test_an_area_is_touched_with_the_centre() -> None:
    world = small_world()
    world.add_area("goal", CircleShape(radius=1), position=(2, 0))
    sim = small_sim([TouchSensor(target="goal")], world=world, controller=ahead)
    found = felt(sim, "touch", 60)
    assert found.index(1.0) == pytest.approx(30, abs=1)  # 1 m at 2 m/s


def test_a_touch_between_two_decisions_is_not_felt() -> None:
    world = World(damping=1.0)
    world.add_body("robot", CircleShape(radius=0.5), elasticity=1.0, velocity=(8, 0))
    wall = BoxShape(size=(1, 4))
    world.add_body("box", wall, position=(4, 0), kind="static", elasticity=1.0)
    sim = small_sim([TouchSensor(target="box")], actuators=[], world=world, skip_frame=59)
    assert sim.step()["touch"].tolist() == [-1.0]
    assert sim.agents[0].body.velocity[0] < 0  # it bounced off


def test_group_touch_feels_any_body_of_the_group_and_no_other() -> None:
    world = small_world()
    world.add_body("wall", BoxShape(size=(1, 9)), position=(7, 0), kind="static", tags=("wall",))
    sensors = [
        GroupTouchSensor(group="target", perception_key="target"),
        GroupTouchSensor(group="wall", perception_key="wall"),
    ]
    sim = small_sim(sensors, world=world, controller=ahead)
    for _ in range(100):
        percept = sim.step()
    assert (percept["target"][0], percept["wall"][0]) == (1.0, -1.0)
    world.remove("box")
    for _ in range(100):
        percept = sim.step()
    assert (percept["target"][0], percept["wall"][0]) == (-1.0, 1.0)


def test_ground_status_is_minus_one_in_the_air() -> None:
    jumps = iter([1.0] + [0.0] * 99)
    sim = small_sim(
        [GroundStatusSensor()], controller=lambda percept: {"move": [0, 0, next(jumps), 0]}
    )
    assert sim.agents[0].percept["ground_status"].tolist() == [1.0]
    found = felt(sim, "ground_status", 30)
    # up and down again at 1 m/s take 2 / 9.81 s
    assert found.count(-1.0) == pytest.approx(60 * 2 / 9.81, abs=1)
    assert found[0] == -1.0
    assert found[-1] == 1.0


def test_ground_status_of_what_fell_out_of_the_world() -> None:
    sim = small_sim([GroundStatusSensor()], world=small_world(plate=2), controller=ahead)
    while not sim.agents[0].done:
        percept = sim.step()
    assert sim.agents[0].body.fallen
    assert percept["ground_status"].tolist() == [-1.0]


@pytest.mark.parametrize(
    ("sensor", "text"),
    [
        (
            TouchSensor(target="bxo"),
            "agent '0', TouchSensor 'touch': no body or area is named 'bxo'; did you mean 'box'?",
        ),
        (
            GroupTouchSensor(group="targte"),
            "agent '0', GroupTouchSensor 'group_touch': no body carries the tag 'targte'; "
            "did you mean 'target'?",
        ),
    ],
)
def test_unknown_targets(sensor: Sensor, text: str) -> None:
    with pytest.raises(BlockError) as caught:
        small_sim([sensor])
    assert str(caught.value) == text
