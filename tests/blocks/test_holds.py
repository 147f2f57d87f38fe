"""The ``holds`` of each reward function, for And and Or, whatever it pays."""

from typing import Any

import pytest

from ai4u_edu import (
    AndRewardFunc,
    BodyInAreaRewardFunc,
    BoxShape,
    CheckpointsReward,
    CircleShape,
    CollisionWithRewardFunc,
    ControlRequestor,
    DistanceToTargetRewardFunc,
    DynamicFallReward,
    EvalBoolValue,
    FallReward,
    GoneReward,
    HomeostaticReward,
    HomeostaticVariable,
    MinDistReward,
    OrRewardFunc,
    ParkedRewardFunc,
    ProgressReward,
    RestlessnessRewardFunc,
    RewardFunc,
    TargetFallReward,
    TouchRewardFunc,
    World,
)
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.block import is_built_in
from tests.builders import small_sim

FORWARD = {"move": [1, 0, 0, 0]}
STILL = {"move": [0, 0, 0, 0]}


def world(box: tuple[float, float] = (2.0, 0.0), **fields: Any) -> World:
    """A robot at the origin, a box ahead, an area "goal" around the origin."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", BoxShape(size=(1, 1)), position=box, tags=("target",), **fields)
    world.add_area("goal", BoxShape(size=(2, 2)))
    return world


def held(child: RewardFunc, actions: list[Any], place: World, **fields: Any) -> list[bool]:
    """Return True for each decision after which a child held: And pays 1 then."""
    answers = iter(actions)
    sim = small_sim(
        rewards=[AndRewardFunc(name="and", children=[child])],
        controller=lambda percept: next(answers),
        world=place,
        skip_frame=14,
        **fields,
    )
    found = []
    for _ in actions:
        sim.step()
        found.append(sim.agents[0].reward_terms["and"] == 1.0)
    return found


@pytest.mark.parametrize("reward", [0.0, 1.0, -5.0])
@pytest.mark.parametrize("only_one_time", [True, False])
def test_touch_holds_as_long_as_they_touch(reward: float, only_one_time: bool) -> None:
    child = TouchRewardFunc(target="box", reward=reward, only_one_time=only_one_time, cool_down=100)
    place = world((1.4, 0.0), kind="static")
    assert held(child, [STILL, FORWARD, FORWARD, FORWARD], place) == [False, True, True, True]


@pytest.mark.parametrize("max_reward", [0.0, 5.0])
def test_a_distance_holds_within_its_minimum(max_reward: float) -> None:
    child = DistanceToTargetRewardFunc(target="box", max_reward=max_reward, min_distance=1.8)
    place = world((3.0, 0.0), kind="static")
    moves = [STILL, FORWARD, FORWARD, FORWARD]
    assert held(child, moves, place) == [False, False, False, True]


def test_the_nearest_so_far_and_progress() -> None:
    moves = [STILL, FORWARD, STILL, FORWARD]
    for child in (
        MinDistReward(target="box", success_reward=0, step_reward=-1),
        ProgressReward(target="box", reward=0),
    ):
        assert held(child, moves, world((4.0, 0.0))) == [False, True, False, True]


def test_standing_still() -> None:
    child = RestlessnessRewardFunc(reward=0)
    assert held(child, [STILL, STILL, FORWARD, STILL], world()) == [False, True, False, True]


def test_contact_in_any_tick() -> None:
    child = CollisionWithRewardFunc(group="target", reward=0)
    place = world((1.4, 0.0), kind="static")
    assert held(child, [STILL, FORWARD, FORWARD], place) == [False, True, True]


def test_falls_hold_below_however_often_they_were_paid() -> None:
    for child in (
        FallReward(threshold=1, success_reward=0, fail_reward=3),
        DynamicFallReward(reference="box", threshold=-1, success_reward=0),
        TargetFallReward(target="box", threshold=1, success_reward=0),
    ):
        assert held(child, [STILL, STILL, STILL], world()) == [True, True, True]
    assert held(FallReward(threshold=-1, fail_reward=3), [STILL], world()) == [False]


def test_what_lies_in_an_area_and_what_is_parked_there() -> None:
    lies = BodyInAreaRewardFunc(thing="robot", area="goal", reward=0)
    assert held(lies, [STILL, STILL, FORWARD, FORWARD, FORWARD], world((9, 0))) == [
        True,
        True,
        True,
        True,
        False,
    ]
    parked = ParkedRewardFunc(area="goal", reward=0)
    assert held(parked, [STILL, STILL, FORWARD], world((9, 0))) == [True, True, False]


def test_a_way_holds_when_it_is_completed() -> None:
    child = CheckpointsReward(targets=["goal", "box"], reward=5)
    place = world((1.4, 0.0), kind="static")
    assert held(child, [STILL, FORWARD, FORWARD], place) == [False, True, False]


def test_what_went_out_of_the_world() -> None:
    child = GoneReward(group="target", reward=0)
    place = world()
    answers = iter([STILL, STILL, STILL])
    sim = small_sim(
        rewards=[OrRewardFunc(name="or", children=[child])],
        controller=lambda percept: next(answers),
        world=place,
    )
    found = []
    for turn in range(3):
        if turn == 1:
            place["box"].leave()
        sim.step()
        found.append(sim.agents[0].reward == 1.0)
    assert found == [False, True, False]


def test_balance() -> None:
    energy = HomeostaticVariable(name="energy", comfort_min=0.8, drift_per_second=-0.5)
    child = HomeostaticReward(variables=[energy], reward=0)
    assert held(child, [STILL, STILL, STILL], world()) == [True, False, False]


class Paying(RewardFunc):
    """Pays given amounts and does not override holds."""

    amounts: list[float]

    def on_reset(self, agent: Any, view: Any) -> None:
        self.left = list(self.amounts)

    def on_update(self, body: Any, view: Any) -> float:
        return self.left.pop(0)


class OftenTouched(TouchRewardFunc):
    """Overrides the payment of its base, and does not override holds."""

    def on_update(self, body: Any, view: Any) -> float:
        return 7.0


def test_a_class_of_ones_own_holds_where_it_pays() -> None:
    assert held(Paying(amounts=[0, 1, -1]), [STILL] * 3, world()) == [False, True, True]
    assert held(OftenTouched(target="box"), [STILL], world()) == [True]


def test_every_built_in_reward_function_says_when_it_holds() -> None:
    kinds = [
        cls
        for cls in Block.types.values()
        if issubclass(cls, RewardFunc) and cls is not RewardFunc and is_built_in(cls)
    ]
    assert len(kinds) > 15
    silent = [cls.__name__ for cls in kinds if cls.holds is RewardFunc.holds]
    assert silent == []


def ending(reward: RewardFunc, **fields: Any) -> ControlRequestor:
    return small_sim(rewards=[reward], controller=lambda percept: FORWARD, **fields)


@pytest.mark.parametrize("kind", [AndRewardFunc, OrRewardFunc])
def test_and_and_or_end_the_episode_even_if_they_pay_nothing(kind: Any) -> None:
    for value in (True, False):
        condition = EvalBoolValue(property="on_ground", value=value)
        sim = ending(kind(children=[condition], reward=0, cause_episode_to_end=True))
        sim.step()
        assert sim.agents[0].terminated is value


def test_what_children_pay_ends_nothing() -> None:
    sim = ending(
        AndRewardFunc(
            children=[Paying(amounts=[3.0]), EvalBoolValue(property="fallen")],
            update_children=True,
            cause_episode_to_end=True,
        )
    )
    sim.step()
    assert (sim.agents[0].reward, sim.agents[0].terminated) == (3.0, False)


def test_a_touch_that_pays_nothing_ends_nothing_as_in_ai4u() -> None:
    for reward in (0.0, 1.0):
        sim = ending(
            TouchRewardFunc(target="box", reward=reward, cause_episode_to_end=True),
            world=world((1.4, 0.0), kind="static"),
            skip_frame=29,
        )
        sim.step()
        assert sim.agents[0].terminated is bool(reward)
