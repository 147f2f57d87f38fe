"""Rewards for bodies in areas and for parking."""

import math
from typing import Any

import pytest

from ai4u_edu import (
    BodyInAreaRewardFunc,
    BoxShape,
    CircleShape,
    ControlRequestor,
    ParkedRewardFunc,
    PositionSensor,
    RewardFunc,
    Variation,
    World,
)
from ai4u_edu.base.errors import BlockError
from tests.builders import small_sim, small_world


def pushed_to(x: float, sim: ControlRequestor) -> float:
    sim.world["box"].move_to(x, 3)
    sim.step()
    return sim.agents[0].reward


def sim_with_goal(**fields: Any) -> ControlRequestor:
    world = small_world()
    world.add_area("goal", BoxShape(size=(2, 2)), position=(-3, 3))
    reward = BodyInAreaRewardFunc(thing="box", area="goal", reward=4, **fields)
    return small_sim(actuators=[], rewards=[reward], world=world)


def test_a_body_counts_with_its_centre_and_once() -> None:
    sim = sim_with_goal()
    assert [pushed_to(x, sim) for x in (-1.9, -2.1, -2.5, 0, -2.5)] == [0, 4, 0, 0, 0]
    sim.reset()
    assert pushed_to(-3, sim) == 4


def test_a_body_may_count_in_every_decision() -> None:
    sim = sim_with_goal(only_one_time=False)
    assert [pushed_to(x, sim) for x in (-1.9, -2.1, -2.5, 0, -2.5)] == [0, 4, 4, 0, 4]


def test_what_fell_out_of_the_world_lies_in_no_area() -> None:
    world = World(fall_threshold=-0.5)
    world.add_floor("plate", BoxShape(size=(2, 2)))
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", BoxShape(size=(1, 1)), position=(5, 0))
    world.add_area("below", BoxShape(size=(2, 2)), position=(5, 0))
    reward = BodyInAreaRewardFunc(thing="box", area="below", only_one_time=False)
    sim = small_sim(actuators=[], rewards=[reward], world=world)
    amounts = []
    while not world["box"].fallen:
        sim.step()
        amounts.append(sim.agents[0].reward)
    assert amounts[0] == 1
    assert amounts[-1] == 0


def test_the_area_has_to_be_there() -> None:
    refused: dict[str, RewardFunc] = {
        "no area is named 'gaol'; did you mean 'goal'": ParkedRewardFunc(area="gaol"),
        "no area is named 'gal'; did you mean 'goal'": BodyInAreaRewardFunc(
            thing="box", area="gal"
        ),
        "no body is named 'bux'; did you mean 'box'": BodyInAreaRewardFunc(
            thing="bux", area="goal"
        ),
    }
    for text, reward in refused.items():
        world = small_world()
        world.add_area("goal", BoxShape(size=(2, 2)))
        with pytest.raises(BlockError, match=text):
            small_sim(rewards=[reward], world=world)


def parked(
    x: float,
    y: float,
    degrees: float,
    speed: float = 0.0,
    *,
    bay: float = 90,
    scale: float = 1.0,
    jump: float = 0.0,
    **fields: Any,
) -> float:
    """Return the reward of a 2 m x 1 m car in a bay of 3 m x 2 m at (5, 5) that faces +y."""
    world = World(damping=1)
    world.add_body("robot", BoxShape(size=(2, 1)), random=Variation(scale=(scale, scale)))
    world.add_area("bay", BoxShape(size=(3, 2)), position=(5, 5), heading_deg=bay)
    reward = ParkedRewardFunc(area="bay", reward=6, **fields)
    sim = small_sim(actuators=[], rewards=[reward], world=world)
    robot = sim.agents[0].body
    robot.move_to(x, y, heading=math.radians(degrees))
    robot.set_velocity(0, speed)
    robot.jump(jump)
    sim.step()
    return sim.agents[0].reward


@pytest.mark.parametrize(
    ("x", "y", "degrees", "good"),
    [
        (5, 5, 90, True),
        (5, 5, -90, True),
        (5.49, 5.49, 90, True),
        (4.51, 4.51, 270, True),
        (5.51, 5, 90, False),
        (5, 5.51, 90, False),
        (5, 4.49, 90, False),
        (5, 5, 104, True),
        (5, 5, 76, True),
        (5, 5, -104, True),
        (5, 5, 106, False),
        (5, 5, 0, False),
        (5.45, 5, 100, False),  # a corner sticks out
    ],
)
def test_parked_is_inside_and_straight(x: float, y: float, degrees: float, good: bool) -> None:
    assert parked(x, y, degrees) == (6 if good else 0)


def test_parked_is_at_rest() -> None:
    assert parked(5, 5, 90, speed=0.09) == 6
    assert parked(5, 5, 90, speed=-0.11) == 0
    assert parked(5, 5, 90, speed=-0.11, max_speed=0.2) == 6


def test_parked_the_other_way_round_only_where_that_is_fine() -> None:
    assert [parked(5, 5, each, either_way=False) for each in (90, -90, 80)] == [6, 0, 6]


def test_parked_in_a_bay_that_lies_askew() -> None:
    x, y = 5 + 0.49 * math.cos(math.radians(60)), 5 + 0.49 * math.sin(math.radians(60))
    assert [parked(x, y, each, bay=60) for each in (60, 240, 80, 90)] == [6, 6, 0, 0]
    assert parked(5, 5, 70, bay=60) == 6


def test_parked_is_measured_by_how_large_the_car_is_in_this_episode() -> None:
    assert [parked(5, 5, 90, scale=each) for each in (1.4, 1.6)] == [6, 0]


def test_a_car_in_the_air_is_not_parked() -> None:
    assert parked(5, 5, 90, jump=1) == 0


def test_parked_pays_once_an_episode() -> None:
    world = World()
    world.add_body("robot", BoxShape(size=(2, 1)))
    world.add_area("bay", BoxShape(size=(3, 2)))
    sim = small_sim(actuators=[], rewards=[ParkedRewardFunc(area="bay")], world=world)
    amounts = []
    for _ in range(3):
        sim.step()
        amounts.append(sim.agents[0].reward)
    assert amounts == [1, 0, 0]
    sim.reset()
    sim.step()
    assert sim.agents[0].reward == 1


def test_a_position_can_be_an_areas() -> None:
    world = World()
    world.add_floor("low", BoxShape(size=(4, 4)))
    world.add_floor("high", BoxShape(size=(2, 2)), position=(3, 0), top=0.5)
    world.add_body("robot", CircleShape(radius=0.5), heading_deg=90)
    world.add_area("goal", BoxShape(size=(1, 1)), position=(3, 0))
    fields: dict[str, Any] = {"target": "goal", "normalized": False}
    sensors = [
        PositionSensor(perception_key="there", **fields),
        PositionSensor(perception_key="here", frame="local", **fields),
    ]
    percept = small_sim(sensors, world=world).agents[0].percept
    assert percept["there"].tolist() == [3, 0, 0.5]
    assert percept["here"].tolist() == pytest.approx([0, -3, 0.5], abs=1e-6)
    with pytest.raises(BlockError, match="no body or area is named 'gaol'; did you mean"):
        small_sim([PositionSensor(target="gaol")], world=world)
