"""The sensors: one idea a file."""

from ai4u_edu.blocks.sensors.bearing import BearingSensor
from ai4u_edu.blocks.sensors.composite import FloatArrayCompositeSensor
from ai4u_edu.blocks.sensors.linear_ray_casting import LinearRayCastingSensor
from ai4u_edu.blocks.sensors.orientation import OrientationSensor
from ai4u_edu.blocks.sensors.position import PositionSensor
from ai4u_edu.blocks.sensors.ray_casting import RayCastingSensor
from ai4u_edu.blocks.sensors.ray_sensor import RayPicture, RaySensor
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.blocks.sensors.status import (
    ActionSensor,
    DoneSensor,
    IDSensor,
    RewardSensor,
    StepSensor,
)
from ai4u_edu.blocks.sensors.velocity import VelocitySensor

__all__ = [
    "ActionSensor",
    "BearingSensor",
    "DoneSensor",
    "FloatArrayCompositeSensor",
    "IDSensor",
    "LinearRayCastingSensor",
    "OrientationSensor",
    "PositionSensor",
    "RayCastingSensor",
    "RayPicture",
    "RaySensor",
    "RewardSensor",
    "Sensor",
    "StepSensor",
    "VelocitySensor",
]
