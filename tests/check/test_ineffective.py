"""Warnings about blocks that run and still have no effect, word for word."""

import pytest

from ai4u_edu import (
    EvalBoolValue,
    FallReward,
    FloatArrayCompositeSensor,
    GoneReward,
    GridMoveActuator,
    GridSensor,
    HomeostaticReward,
    HomeostaticVariable,
    LinearRayCastingSensor,
    LocalGridSensor,
    RayCastingSensor,
    RewardFunc,
    Sensor,
    TouchRewardFunc,
    check_actuator,
    check_reward,
    check_sensor,
)
from ai4u_edu.check import Outcome
from tests.check.reports import SHORT, outcome


@pytest.mark.parametrize(
    ("reward", "amounts"),
    [
        (TouchRewardFunc(target="box", cause_episode_to_end=True), "reward"),
        (
            FallReward(success_reward=0, cause_episode_to_end=True),
            "success_reward or fail_reward",
        ),
        (
            HomeostaticReward(
                variables=[HomeostaticVariable(name="e")], reward=0, cause_episode_to_end=True
            ),
            "reward",
        ),
    ],
)
def test_a_reward_of_nothing_that_is_to_end_the_episode(reward: RewardFunc, amounts: str) -> None:
    report = check_reward(reward, **SHORT)
    assert report.ok
    assert outcome(report, "ends") == (
        Outcome.WARNING,
        f"expected an amount other than 0 in {amounts}, got 0: the episode ends only where "
        "something is paid, so it never ends by it",
    )


def test_a_condition_alone_ends_nothing() -> None:
    condition = EvalBoolValue(property="on_ground", cause_episode_to_end=True)
    found, text = outcome(check_reward(condition, **SHORT), "ends")
    assert found is Outcome.WARNING
    assert "expected a condition inside an AndRewardFunc or OrRewardFunc" in text


def test_a_reward_that_can_end_the_episode_gets_no_warning() -> None:
    touch = TouchRewardFunc(target="box", reward=1, cause_episode_to_end=True)
    assert outcome(check_reward(touch, **SHORT), "ends") == (Outcome.PASSED, "")
    checks = {each.check for each in check_reward(TouchRewardFunc(target="box"), **SHORT).findings}
    assert "ends" not in checks


@pytest.mark.parametrize(
    ("sensor", "text"),
    [
        (
            LinearRayCastingSensor(group_code={"floor": 1, "tragt": 2}),
            "group_code: nothing that it could find carries the tag 'tragt'; "
            "did you mean 'target'?",
        ),
        (
            RayCastingSensor(group_code={"wall": 1, "goal": 2}),  # a ray meets no areas
            "group_code: nothing that it could find carries the tag 'goal'; known are 'agent', "
            "'floor', 'target', 'wall'",
        ),
        (
            FloatArrayCompositeSensor(
                sensors=[LinearRayCastingSensor(group_code={"wal": 1, "floor": 2})]
            ),
            "group_code: nothing that it could find carries the tag 'wal'; did you mean 'wall'?",
        ),
        (
            LocalGridSensor(channels=["void", "floor", "goal", "lamp"]),
            "channels: nothing that it could find carries the tag 'lamp'; known are 'agent', "
            "'floor', 'goal', 'target', 'void', 'wall'",
        ),
    ],
)
def test_a_group_that_nothing_carries(sensor: Sensor, text: str) -> None:
    report = check_sensor(sensor, decisions=2)
    assert outcome(report, "groups") == (Outcome.WARNING, text)


def test_groups_that_are_there_or_stand_there_by_default() -> None:
    for sensor in (LinearRayCastingSensor(group_code={"wall": 1}), GridSensor(), LocalGridSensor()):
        assert outcome(check_sensor(sensor, decisions=2), "groups") == (Outcome.PASSED, "")
    gone = outcome(check_reward(GoneReward(group="target"), **SHORT), "groups")
    assert gone == (Outcome.PASSED, "")
    grid = outcome(
        check_actuator(GridMoveActuator(rows=7, columns=7, blocked_by=["wall", "dor"]), **SHORT),
        "groups",
    )
    assert grid[0] is Outcome.WARNING
