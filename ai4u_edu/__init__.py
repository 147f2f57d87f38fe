"""AI4U Edu: a top-down sandbox to learn how agents sense, decide and act.

Names are loaded when they are first asked for, so that a script that only drives a remote agent
loads no physics and no viewer.
"""

from ai4u_edu.version import __version__

_HOMES = {
    "agent": ("EVENTS", "BasicAgent", "Event"),
    "blocks": (
        "Action",
        "ActionSensor",
        "Actuator",
        "BearingSensor",
        "Block",
        "Brain",
        "Command",
        "Controller",
        "DoneSensor",
        "FallReward",
        "FloatArrayCompositeSensor",
        "IDSensor",
        "Keyboard",
        "LinearRayCastingSensor",
        "LocalBrain",
        "MinDistReward",
        "OrientationSensor",
        "Percept",
        "PositionSensor",
        "RBMoveActuator",
        "RayCastingSensor",
        "RespawnActuator",
        "RewardFunc",
        "RewardSensor",
        "ScriptController",
        "Sensor",
        "StepSensor",
        "TouchRewardFunc",
        "VelocitySensor",
        "WASDRBMoveController",
    ),
    "cycle": ("ControlRequestor",),
    "errors": ("AI4UError",),
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
        "World",
        "WorldView",
    ),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = ["__version__", *_HOME_OF]


def __getattr__(name: str) -> object:
    from importlib import import_module

    if name not in _HOME_OF:
        raise AttributeError(f"module 'ai4u_edu' has no attribute {name!r}")
    value = getattr(import_module(f"ai4u_edu.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__():  # type: ignore[no-untyped-def]  # an old Python must get as far as our message
    return sorted(__all__)
