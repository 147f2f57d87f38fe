"""Every component of AI4U is here, under its name."""

import pytest

import ai4u_edu
from ai4u_edu.blocks.block import is_built_in

SENSORS = (
    "ActionSensor DoneSensor IDSensor StepSensor RewardSensor TruncatedSensor "
    "FloatArrayCompositeSensor OrientationSensor BearingSensor PositionSensor RayCastingSensor "
    "LinearRayCastingSensor TouchSensor GroupTouchSensor GroundStatusSensor AreaOrientationSensor "
    "AgentArraySensor LocalGridSensor VelocitySensor HeadingSensor HomeostaticSensor "
    "LineSensor GridSensor CellSensor PresenceSensor LightSensor ColourSensor HearSensor "
    "EventSensor"
)
ACTUATORS = (
    "RBMoveActuator CBMoveActuator DifferentialDriveActuator DiscreteActuator ContinuousActuator "
    "RespawnActuator GrabActuator CarActuator CollectActuator GridMoveActuator "
    "ForceMoveActuator PenActuator SpeakActuator"
)
REWARDS = (
    "TouchRewardFunc CollisionWithRewardFunc MinDistReward DistanceToTargetRewardFunc FallReward "
    "DynamicFallReward RestlessnessRewardFunc EvalBoolValue EvalIntValue EvalFloatValue "
    "AndRewardFunc OrRewardFunc HomeostaticReward CheckpointsReward BodyInAreaRewardFunc "
    "ParkedRewardFunc GoneReward TargetFallReward ProgressReward FigureReward "
    "EventRewardFunc"
)
CONTROLLERS = (
    "WASDRBMoveController ArrowController DiscreteArrowController ReplayController "
    "ScriptController WASDController FleeController KeeperController PushOutController "
    "StrikerController TrainController AntController CallController"
)
OTHERS = "BasicAgent ControlRequestor Brain LocalBrain Controller HomeostaticVariable"

EVENTS = (
    "before_the_reset end_of_episode begin_of_episode end_of_step begin_of_step "
    "begin_of_update_state end_of_update_state begin_of_apply_action end_of_apply_action "
    "agent_start"
)


@pytest.mark.parametrize(
    ("names", "base"),
    [
        (SENSORS, "Sensor"),
        (ACTUATORS, "Actuator"),
        (REWARDS, "RewardFunc"),
        (CONTROLLERS, "Controller"),
        (OTHERS, ""),
    ],
)
def test_every_component_is_in_the_package(names: str, base: str) -> None:
    for name in names.split():
        cls = getattr(ai4u_edu, name)
        assert cls.__name__ == name
        assert not base or issubclass(cls, getattr(ai4u_edu, base)), name


def test_every_kind_of_block_is_in_the_list() -> None:
    listed = f"{SENSORS} {ACTUATORS} {REWARDS}".split()
    bases = (ai4u_edu.Sensor, ai4u_edu.Actuator, ai4u_edu.RewardFunc)
    for name, cls in ai4u_edu.Block.types.items():
        if is_built_in(cls) and issubclass(cls, bases):
            assert name in listed or cls in bases or cls.__dict__.get("abstract"), name


@pytest.mark.parametrize("name", f"{SENSORS} {ACTUATORS} {REWARDS}".split())
def test_every_component_says_where_it_comes_from(name: str) -> None:
    doc = str(getattr(ai4u_edu, name).__doc__)
    assert "Source: " in doc
    assert len(doc.split()) > 8


def test_every_event_has_its_name() -> None:
    assert sorted(EVENTS.split()) == sorted(ai4u_edu.EVENTS)


@pytest.mark.parametrize(
    ("name", "field", "default"),
    [
        ("RBMoveActuator", "action_name", "move"),
        ("CBMoveActuator", "dead_zone", 0.001),
        ("AgentArraySensor", "perception_key", "__initial_input__"),
        ("AreaOrientationSensor", "perception_key", "areasensor"),
        ("AreaOrientationSensor", "max_detection_reported", 20),
        ("AreaOrientationSensor", "min_distance", 1.0),
        ("AreaOrientationSensor", "target_group", "EMITTER"),
        ("AreaOrientationSensor", "max_code_value", 100),
        ("StepSensor", "max_size", 300),
        ("CollisionWithRewardFunc", "reward", -0.1),
        ("DistanceToTargetRewardFunc", "max_reward", 1.0),
        ("DistanceToTargetRewardFunc", "square_inverse", True),
        ("DynamicFallReward", "threshold", 10.0),
        ("DynamicFallReward", "success_reward", -1.0),
        ("FallReward", "max_rewards", 1),
        ("MinDistReward", "step_reward", -0.001),
        ("RestlessnessRewardFunc", "min_dist", 0.001),
        ("RestlessnessRewardFunc", "reward", -0.001),
        ("RestlessnessRewardFunc", "ignored_axis", -1),
        ("AndRewardFunc", "reward", 1.0),
        ("OrRewardFunc", "update_children", False),
        ("EvalBoolValue", "reward", 1.0),
        ("ContinuousActuator", "size", 5),
        ("RespawnActuator", "early", True),
        ("RespawnActuator", "is_output", False),
        ("ArrowController", "speed", 0.5),
        ("ArrowController", "turn_amount", 1.0),
        ("BasicAgent", "done_at_negative_reward", False),
    ],
)
def test_ai4us_own_numbers(name: str, field: str, default: object) -> None:
    cls = getattr(ai4u_edu, name)
    assert cls.parameters()[field].get_default(call_default_factory=True) == default
