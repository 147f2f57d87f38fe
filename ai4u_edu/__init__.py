"""AI4U Edu: a top-down sandbox to learn how agents sense, decide and act.

Names are loaded when they are first asked for, so that a script that only drives a remote agent
loads no physics and no viewer.
"""

from ai4u_edu.base.version import __version__

_HOMES = {
    "agent": ("EVENTS", "BasicAgent", "ControlRequestor", "Event"),
    "blocks": (
        "AStarController",
        "Action",
        "ActionSensor",
        "Actuator",
        "AgentArraySensor",
        "AndRewardFunc",
        "AreaOrientationSensor",
        "ArrowController",
        "BearingSensor",
        "Block",
        "BodyInAreaRewardFunc",
        "Brain",
        "BreadthFirstController",
        "CBMoveActuator",
        "CarActuator",
        "CellSensor",
        "CheckpointsReward",
        "CollectActuator",
        "CollisionWithRewardFunc",
        "Command",
        "ContinuousActuator",
        "Controller",
        "DifferentialDriveActuator",
        "DiscreteActuator",
        "DiscreteArrowController",
        "DistanceToTargetRewardFunc",
        "DoneSensor",
        "DynamicFallReward",
        "EvalBoolValue",
        "EvalFloatValue",
        "EvalIntValue",
        "FallReward",
        "FleeController",
        "FloatArrayCompositeSensor",
        "ForceMoveActuator",
        "GoneReward",
        "GrabActuator",
        "GridMoveActuator",
        "GridSensor",
        "GroundStatusSensor",
        "GroupTouchSensor",
        "HeadingSensor",
        "HomeostaticReward",
        "HomeostaticSensor",
        "HomeostaticVariable",
        "IDSensor",
        "KeeperController",
        "Keyboard",
        "LineSensor",
        "LightSensor",
        "LinearRayCastingSensor",
        "LocalBrain",
        "LocalGridSensor",
        "MinDistReward",
        "NeuralNetController",
        "OrRewardFunc",
        "OrientationSensor",
        "ParkedRewardFunc",
        "Percept",
        "PositionSensor",
        "PresenceSensor",
        "ProgressReward",
        "PushOutController",
        "RBMoveActuator",
        "RayCastingSensor",
        "RemoteBrain",
        "ReplayController",
        "RespawnActuator",
        "RestlessnessRewardFunc",
        "RewardFunc",
        "RewardSensor",
        "ScriptController",
        "Sensor",
        "StepSensor",
        "StrikerController",
        "TargetFallReward",
        "TouchRewardFunc",
        "TouchSensor",
        "TrainController",
        "Trainer",
        "TruncatedSensor",
        "VelocitySensor",
        "WASDController",
        "WASDRBMoveController",
        "a_star",
        "breadth_first",
        "trained_brain",
    ),
    "check": (
        "Finding",
        "Report",
        "check_actuator",
        "check_brain",
        "check_controller",
        "check_reward",
        "check_scene",
        "check_sensor",
    ),
    "base.errors": ("AI4UError",),
    "recording": ("Episode", "Recorder", "Replay"),
    "scenes": ("Scene",),
    "world": (
        "AreaDescription",
        "Body",
        "BodyDescription",
        "BodyView",
        "BoxShape",
        "CapsuleShape",
        "CircleShape",
        "FloorDescription",
        "PolygonShape",
        "RingShape",
        "SegmentShape",
        "Variation",
        "World",
        "WorldView",
    ),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = ["__version__", *_HOME_OF]

try:
    from ai4u_edu.registration import register_envs
except ImportError:  # without Gymnasium: the first start has yet to install it
    pass
else:
    register_envs()


def __getattr__(name: str) -> object:
    from importlib import import_module

    if name not in _HOME_OF:
        raise AttributeError(f"module 'ai4u_edu' has no attribute {name!r}")
    value = getattr(import_module(f"ai4u_edu.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__():  # type: ignore[no-untyped-def]  # an old Python must get as far as our message
    return sorted(__all__)
