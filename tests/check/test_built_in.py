"""Every block of the package, and every scene of its library, passes its check."""

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
from tests.check.samples import built_in_kinds, sample_of
from tests.check.samples.sample import Sample

pytestmark = pytest.mark.slow


def checked(sample: Sample) -> Report:
    scene, script, extra = sample.scene, sample.script, sample.actuators
    match sample.block:
        case Sensor() as sensor:
            return check_sensor(sensor, script=script, scene=scene)
        case Actuator() as actuator:
            return check_actuator(actuator, script=script, scene=scene)
        case RewardFunc() as reward:
            return check_reward(reward, script=script, scene=scene)
        case Controller() as controller:
            return check_controller(controller, actuators=extra, script=script, scene=scene)
        case Brain() as brain:
            return check_brain(brain, actuators=extra, script=script, scene=scene)
        case block:
            raise TypeError(block)


@pytest.mark.parametrize("kind", built_in_kinds(), ids=lambda kind: kind.__name__)
def test_every_built_in_block_passes(kind: type[Block]) -> None:
    sample = sample_of(kind)
    report = checked(sample)
    assert report.ok, str(report)
    warnings = {each.check for each in report.findings if each.outcome is Outcome.WARNING}
    assert warnings == ({"changes"} if sample.always_same else set()), str(report)


@pytest.mark.parametrize("name", Scene.names())
def test_every_scene_of_the_library_passes(name: str) -> None:
    report = check_scene(name, decisions=40)
    assert report.ok, str(report)
