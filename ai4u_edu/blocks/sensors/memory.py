"""A limit on the memory of a sensor's readings, which stacking and delay multiply."""

import math
from typing import TYPE_CHECKING

from ai4u_edu.base.errors import BlockError

if TYPE_CHECKING:
    from ai4u_edu.blocks.sensors.sensor import Sensor

MAX_KEPT_NUMBERS = 2**23
"""Maximum count of numbers that a sensor may keep, over all readings for stack and delay."""


def check_memory(sensor: "Sensor", shape: tuple[int, ...]) -> None:
    """Raise a BlockError if a sensor's readings would need too much memory.

    Args:
        sensor: the sensor.
        shape: shape of one reading.
    """
    size, kept = math.prod(shape), sensor.stacked_observations + sensor.delay
    if size * kept > MAX_KEPT_NUMBERS:
        raise BlockError(
            f"{type(sensor).__name__} {sensor.perception_key!r}: expected at most "
            f"{MAX_KEPT_NUMBERS} numbers in the readings that it keeps, got {kept} of {size}; "
            "choose a lower resolution, or less of stacked_observations and delay"
        )
