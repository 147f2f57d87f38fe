"""Everything an agent is built from."""

from ai4u_edu.blocks.actuators import Actuator, RBMoveActuator, RespawnActuator
from ai4u_edu.blocks.block import Block
from ai4u_edu.blocks.brains import Action, Answer, Brain, Command, LocalBrain
from ai4u_edu.blocks.brains.controllers import (
    Controller,
    Keyboard,
    ScriptController,
    WASDRBMoveController,
)
from ai4u_edu.blocks.percept import Layout, Percept
from ai4u_edu.blocks.rewards import FallReward, MinDistReward, RewardFunc, TouchRewardFunc
from ai4u_edu.blocks.sensors import (
    ActionSensor,
    BearingSensor,
    DoneSensor,
    FloatArrayCompositeSensor,
    IDSensor,
    LinearRayCastingSensor,
    OrientationSensor,
    PositionSensor,
    RayCastingSensor,
    RayPicture,
    RaySensor,
    RewardSensor,
    Sensor,
    StepSensor,
    VelocitySensor,
)

__all__ = [
    "Action",
    "ActionSensor",
    "Actuator",
    "Answer",
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
    "Layout",
    "LinearRayCastingSensor",
    "LocalBrain",
    "MinDistReward",
    "OrientationSensor",
    "Percept",
    "PositionSensor",
    "RBMoveActuator",
    "RayCastingSensor",
    "RayPicture",
    "RaySensor",
    "RespawnActuator",
    "RewardFunc",
    "RewardSensor",
    "ScriptController",
    "Sensor",
    "StepSensor",
    "TouchRewardFunc",
    "VelocitySensor",
    "WASDRBMoveController",
]
