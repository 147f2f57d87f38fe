"""Directions and codes of a flat fan of rays, for programs that are made of blocks."""

from dataclasses import dataclass

import numpy as np

from ai4u_edu.blocks import LinearRayCastingSensor
from ai4u_edu.blocks.sensors.ray_sensor import spread


@dataclass(frozen=True, slots=True)
class RayLayout:
    """The order of the numbers that a flat fan of rays reads."""

    angles_deg: tuple[float, ...]
    """Angle of each ray from the heading, positive to the left; the rightmost ray is first."""
    has_code: bool
    """True if a ray reads the code of what it hits; it comes before the distance."""
    has_distance: bool
    """True if a ray reads the distance to what it hits; 0 if it hits nothing."""
    codes: tuple[tuple[str, float], ...]
    """Name of each group, and its code in the reading."""
    reach: float
    """Largest distance in the reading: 1, or metres."""
    reach_m: float
    """Length of a ray, metres."""


def ray_layout_of(sensor: object) -> RayLayout | None:
    """Return the layout of a sensor's rays; None if it reads no flat fan."""
    if not isinstance(sensor, LinearRayCastingSensor):
        return None
    angles = np.degrees(spread(sensor.number_of_rays, sensor.field_of_view))
    largest = sensor.largest_code if sensor.normalized else 1.0
    return RayLayout(
        angles_deg=tuple((angles - sensor.horizontal_shift).round(2).tolist()),
        has_code=sensor.return_code,
        has_distance=sensor.return_distance,
        codes=tuple((name, code / largest) for name, code in sensor.group_code.items()),
        reach=sensor.farthest,
        reach_m=sensor.vision_max_distance,
    )
