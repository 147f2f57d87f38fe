"""Sizes, floors and regions of the arena. World frame, metres."""

import math

import numpy as np

from ai4u_edu.page.viewer.scene.geometry import Array, circle, rotate
from ai4u_edu.snapshot import StaticScene
from ai4u_edu.world import CircleShape, RegionDescription, RingShape

CIRCLE_CORNERS = 160
"""Corners of a round region: on a screen 2000 pixels high, the drawn edge is off by 0.2 pixels."""


def region_outlines(region: RegionDescription) -> tuple[Array, Array | None]:
    """Return a region's outline, and the outline of its hole if it has one."""
    angle = math.radians(region.heading_deg)
    shape = region.shape
    if isinstance(shape, CircleShape):  # its outline has few corners, which show on a large floor
        return circle(shape.radius, *region.position, corners=CIRCLE_CORNERS), None
    outline = rotate(np.array(shape.outline()), angle) + region.position
    if not isinstance(shape, RingShape):
        return outline, None
    return outline, rotate(np.array(shape.hole()), angle) + region.position


def arena_size(static_scene: StaticScene) -> float:
    """Return the length of the arena's longer side, at least 4 m."""
    (left, low), (right, high) = static_scene.bounds
    return max(right - left, high - low, 4.0)


def camera_bounds(static_scene: StaticScene) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the bounds for the camera: the whole arena, with a margin if the ground is endless."""
    (left, low), (right, high) = static_scene.bounds
    margin = 0.0 if static_scene.floors else max(3.0, 0.2 * arena_size(static_scene))
    return (left - margin, low - margin), (right + margin, high + margin)
