"""Rewards for collisions, distance, falling below a reference and standing still."""

from typing import Any

import pytest

from ai4u_edu import (
    BoxShape,
    CircleShape,
    CollisionWithRewardFunc,
    ControlRequestor,
    DistanceToTargetRewardFunc,
    DynamicFallReward,
    FallReward,
    RestlessnessRewardFunc,
    RewardFunc,
    World,
)
from ai4u_edu.base.errors import BlockError
from tests.builders import small_sim, small_world


def paid(sim: ControlRequestor, steps: int) -> list[float]:
    amounts = []
    for _ in range(steps):
        sim.step()
        amounts.append(sim.agents[0].reward)
    return amounts


def along(*ways: float) -> Any:
    """Drive with each number for one decision, then stand still."""
    rest = iter(ways)
    return lambda percept: {"move": [next(rest, 0.0), 0, 0, 0]}


def ahead(_percept: Any) -> dict[str, Any]:
    return {"move": [1, 0, 0, 0]}


def cornered() -> World:
    """A robot that touches a wall ahead and a crate on its left, both of them heavy."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    for name, place in (("wall", (1.0, 0.0)), ("crate", (0.0, 1.0))):
        world.add_body(name, BoxShape(size=(1, 1)), position=place, kind="static", tags=(name,))
    return world


@pytest.mark.parametrize("skip_frame", [0, 4, 9])
def test_collision_costs_each_tick(skip_frame: int) -> None:
    sim = small_sim(
        rewards=[CollisionWithRewardFunc(group="wall")],
        world=cornered(),
        controller=ahead,
        skip_frame=skip_frame,
    )
    paid(sim, 3)  # until it has dug in
    assert paid(sim, 3) == [pytest.approx(-0.1 * (skip_frame + 1))] * 3


def test_two_contacts_in_one_tick_count_once() -> None:
    world = cornered()
    world.add_body("post", CircleShape(radius=0.5), position=(0.9, -0.9), kind="static",
                   tags=("wall",))  # fmt: skip
    sim = small_sim(
        rewards=[CollisionWithRewardFunc(reward=-2)],
        world=world,
        controller=lambda percept: {"move": [1, 0, 0, 0]},
    )
    paid(sim, 10)
    assert len(sim.agents[0].view.contacts(sim.agents[0].body)) > 1
    assert paid(sim, 3) == [-2.0] * 3


def test_any_body_or_one_group_only() -> None:
    for group, expected in (("", -0.1), ("wall", -0.1), ("crate", 0.0)):
        world = World()
        world.add_body("robot", CircleShape(radius=0.5))
        for name, place in (("wall", (1.0, 0.0)), ("crate", (0.0, 5.0))):
            world.add_body(name, BoxShape(size=(1, 1)), position=place, kind="static", tags=(name,))
        sim = small_sim(
            rewards=[CollisionWithRewardFunc(group=group)], world=world, controller=ahead
        )
        assert paid(sim, 10)[-1] == expected


def test_no_contact_costs_nothing_and_a_floor_is_no_contact() -> None:
    sim = small_sim(rewards=[CollisionWithRewardFunc()], world=small_world(plate=20))
    assert paid(sim, 5) == [0.0] * 5


@pytest.mark.parametrize(
    ("distance", "fields", "expected"),
    [
        (0.5, {}, 1.0),
        (1.0, {}, 1.0),
        (2.0, {}, 1 / 4),
        (5.0, {}, 1 / 25),
        (5.0, {"square_inverse": False}, 1 / 5),
        (4.0, {"min_distance": 2.0}, 1 / 4),
        (4.0, {"min_distance": 2.0, "square_inverse": False}, 1 / 2),
        (1.5, {"min_distance": 2.0, "max_reward": 3.0}, 3.0),
        (4.0, {"max_reward": -8.0}, -0.5),
    ],
)
def test_nearness_pays(distance: float, fields: dict[str, Any], expected: float) -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.1))
    world.add_body("goal", CircleShape(radius=0.1), position=(0, distance), kind="static")
    sim = small_sim(rewards=[DistanceToTargetRewardFunc(target="goal", **fields)], world=world)
    assert paid(sim, 2) == [pytest.approx(expected)] * 2


def test_dynamic_fall_is_below_the_reference_wherever_that_is() -> None:
    world = World(fall_threshold=-100)
    world.add_floor("plate", BoxShape(size=(4, 4)))
    world.add_floor("shelf", BoxShape(size=(4, 4)), position=(20, 0), top=-7)
    world.add_floor("deep", BoxShape(size=(4, 4)), position=(40, 0), top=-8.5)
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("lift", CircleShape(radius=0.5), position=(-1.5, 0), kind="static")
    reward = DynamicFallReward(reference="lift", threshold=8, max_rewards=2, fail_reward=0.5)
    sim = small_sim(rewards=[reward], world=world)
    body = world["robot"]
    assert paid(sim, 1) == [0.5]
    body.move_to(20, 0)
    assert (body.z, paid(sim, 1)) == (-7, [0.5])
    world["lift"].move_to(-1.5, 0, z=1.5)
    assert paid(sim, 1) == [-1.0]
    body.move_to(0, 0)
    assert paid(sim, 1) == [0.5]
    world["lift"].move_to(-1.5, 0, z=0)
    body.move_to(40, 0)
    assert (body.z, paid(sim, 2)) == (-8.5, [-1.0, 0.5])  # twice an episode, no more
    sim.reset()
    body.move_to(40, 0)
    assert paid(sim, 1) == [-1.0]


def test_what_fell_out_of_the_world_is_below_anything() -> None:
    reward = DynamicFallReward(reference="box", cause_episode_to_end=True)
    world = World(fall_threshold=-2)
    world.add_floor("plate", BoxShape(size=(3, 3)))
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", CircleShape(radius=0.3), position=(-1, 0))
    sim = small_sim(rewards=[reward], world=world, controller=ahead)
    amounts: list[float] = []
    while not sim.agents[0].done:
        amounts += paid(sim, 1)
    assert amounts[-1] == -1.0
    assert amounts.count(0.0) == len(amounts) - 1


def test_standing_still_costs_but_not_at_first() -> None:
    sim = small_sim(rewards=[RestlessnessRewardFunc()], controller=along(0, 0, 1, 1, 0, 0, 0))
    cost = -0.001
    # it takes a tick until a speed that was set moves the body, or stops it
    amounts = paid(sim, 7)
    assert amounts[:2] == [0.0, cost]
    assert amounts[3] == 0.0
    assert amounts[-2:] == [cost, cost]
    sim.reset()
    assert paid(sim, 2) == [0.0, cost]


def test_how_far_counts_as_moving() -> None:
    for distance, expected in ((0.5, -1.0), (2.0, 0.0)):
        sim = small_sim(rewards=[RestlessnessRewardFunc(min_dist=1, reward=-1)], controller=along())
        paid(sim, 1)
        sim.agents[0].body.move_to(0, distance)
        assert paid(sim, 1) == [expected]


@pytest.mark.parametrize(
    ("axis", "place", "expected"),
    [(0, (1, 0), -1), (0, (0, 1), 0), (1, (1, 0), 0), (1, (0, 1), -1), (-1, (0, 1), 0)],
)
def test_an_axis_may_be_left_out(axis: Any, place: Any, expected: float) -> None:
    sim = small_sim(rewards=[RestlessnessRewardFunc(reward=-1, ignored_axis=axis)])
    paid(sim, 1)
    sim.agents[0].body.move_to(*place)
    assert paid(sim, 1) == [expected]


def test_small_ways_do_not_add_up() -> None:
    sim = small_sim(rewards=[RestlessnessRewardFunc(reward=-1)])
    body, amounts = sim.agents[0].body, []
    for decision in range(6):
        body.move_to(0.0007 * decision, 0)
        amounts += paid(sim, 1)
    assert amounts == [0.0] + [-1.0] * 5  # AI4U's: compared with the last place of a move


def test_turning_is_standing_still_and_jumping_is_not() -> None:
    turning = small_sim(
        rewards=[RestlessnessRewardFunc()], controller=lambda percept: {"move": [0, 1, 0, 0]}
    )
    assert paid(turning, 5) == [0.0] + [-0.001] * 4
    jumping = small_sim(
        rewards=[RestlessnessRewardFunc()], controller=lambda percept: {"move": [0, 0, 1, 0]}
    )
    assert paid(jumping, 5) == [0.0] * 5


def test_fall_reward_says_why_it_has_no_axis() -> None:
    assert "z axis and never tip over" in " ".join(str(FallReward.__doc__).split())


@pytest.mark.parametrize(
    ("reward", "text"),
    [
        (
            CollisionWithRewardFunc(group="targte"),
            "CollisionWithRewardFunc 'collision_with': no body carries the tag 'targte'; "
            "did you mean 'target'?",
        ),
        (
            DistanceToTargetRewardFunc(target="bxo"),
            "DistanceToTargetRewardFunc 'distance_to_target': no body is named 'bxo'; "
            "did you mean 'box'?",
        ),
        (
            DynamicFallReward(reference="bxo"),
            "DynamicFallReward 'dynamic_fall': no body is named 'bxo'; did you mean 'box'?",
        ),
    ],
)
def test_unknown_names(reward: RewardFunc, text: str) -> None:
    with pytest.raises(BlockError) as caught:
        small_sim(rewards=[reward])
    assert str(caught.value) == f"agent '0', {text}"
