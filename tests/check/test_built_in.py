"""Every block of the package, and every scene of its library, passes its check."""

from typing import Any

import pytest

from ai4u_edu import (
    Actuator,
    Block,
    Brain,
    Controller,
    Report,
    RewardFunc,
    Scene,
    Sensor,
    check_actuator,
    check_brain,
    check_controller,
    check_reward,
    check_scene,
    check_sensor,
)
from ai4u_edu.check import Outcome
from tests.check.samples import ACTUATORS, SAMPLES, SCENES, built_in_kinds, tell

BY_KIND = {type(block): block for block in SAMPLES}

ALWAYS_THE_SAME = {
    "IDSensor": "changes",  # an id is an id
    "EvalBoolValue": "changes",  # conditions pay nothing on their own
    "EvalFloatValue": "changes",
    "EvalIntValue": "changes",
    "GoneReward": "changes",  # nothing goes there
    "ParkedRewardFunc": "changes",  # who drives at random does not park
    "RemoteBrain": "changes",  # it waits for a script
    "ScriptController": "changes",  # the sample drives in circles
}


def checked(block: Block) -> Report:
    name = type(block).__name__
    scene = SCENES.get(name)
    match block:
        case Sensor():
            return check_sensor(block, script=tell, scene=scene)
        case Actuator():
            return check_actuator(block)
        case RewardFunc():
            return check_reward(block)
        case Controller():
            return check_controller(block, actuators=ACTUATORS.get(name, ()), scene=scene)
        case Brain():
            return check_brain(block)
        case _:
            raise TypeError(block)


@pytest.mark.parametrize("kind", built_in_kinds(), ids=lambda kind: kind.__name__)
def test_every_built_in_block_passes(kind: Any) -> None:
    assert kind in BY_KIND, f"put a {kind.__name__} into tests/check/samples.py"
    report = checked(BY_KIND[kind])
    assert report.ok, str(report)
    warnings = {each.check for each in report.findings if each.outcome is Outcome.WARNING}
    expected = ALWAYS_THE_SAME.get(kind.__name__)
    assert warnings == ({expected} if expected else set()), str(report)


@pytest.mark.parametrize("name", Scene.names())
def test_every_scene_of_the_library_passes(name: str) -> None:
    report = check_scene(name, decisions=40)
    assert report.ok, str(report)
