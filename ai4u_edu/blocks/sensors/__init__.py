"""The sensors: one idea a file."""

from ai4u_edu.blocks.sensors.agent_array import AgentArraySensor
from ai4u_edu.blocks.sensors.area_orientation import AreaOrientationSensor
from ai4u_edu.blocks.sensors.bearing import BearingSensor
from ai4u_edu.blocks.sensors.cell import CellSensor
from ai4u_edu.blocks.sensors.colour import ColourSensor
from ai4u_edu.blocks.sensors.composite import FloatArrayCompositeSensor
from ai4u_edu.blocks.sensors.grid import GridSensor
from ai4u_edu.blocks.sensors.ground_status import GroundStatusSensor
from ai4u_edu.blocks.sensors.group_touch import GroupTouchSensor
from ai4u_edu.blocks.sensors.heading import HeadingSensor
from ai4u_edu.blocks.sensors.hear import HearSensor
from ai4u_edu.blocks.sensors.homeostatic import HomeostaticSensor
from ai4u_edu.blocks.sensors.light import LightSensor
from ai4u_edu.blocks.sensors.line import LineSensor
from ai4u_edu.blocks.sensors.linear_ray_casting import LinearRayCastingSensor
from ai4u_edu.blocks.sensors.local_grid import LocalGridSensor
from ai4u_edu.blocks.sensors.orientation import OrientationSensor
from ai4u_edu.blocks.sensors.position import PositionSensor
from ai4u_edu.blocks.sensors.presence import PresenceSensor
from ai4u_edu.blocks.sensors.ray_casting import RayCastingSensor
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.blocks.sensors.status import (
    ActionSensor,
    DoneSensor,
    IDSensor,
    RewardSensor,
    StepSensor,
    TruncatedSensor,
)
from ai4u_edu.blocks.sensors.touch import EventSensor, TouchSensor
from ai4u_edu.blocks.sensors.velocity import VelocitySensor

__all__ = [
    "ActionSensor",
    "AgentArraySensor",
    "AreaOrientationSensor",
    "BearingSensor",
    "CellSensor",
    "ColourSensor",
    "DoneSensor",
    "EventSensor",
    "FloatArrayCompositeSensor",
    "GridSensor",
    "GroundStatusSensor",
    "GroupTouchSensor",
    "HeadingSensor",
    "HearSensor",
    "HomeostaticSensor",
    "IDSensor",
    "LightSensor",
    "LineSensor",
    "LinearRayCastingSensor",
    "LocalGridSensor",
    "OrientationSensor",
    "PositionSensor",
    "PresenceSensor",
    "RayCastingSensor",
    "RewardSensor",
    "Sensor",
    "StepSensor",
    "TouchSensor",
    "TruncatedSensor",
    "VelocitySensor",
]
