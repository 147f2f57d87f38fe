"""Where regions lie, and which floor is under a place. World frame, metres."""

import math

import numpy as np

from ai4u_edu.snapshot import StaticScene
from ai4u_edu.viewer.scene.geometry import Array, turn
from ai4u_edu.world import Region, RegionDescription, RingShape


def placed(region: RegionDescription) -> tuple[Array, Array | None]:
    """A region's outline and the hole in it, if it has one."""
    angle = math.radians(region.heading_deg)
    shape = region.shape
    outline = turn(np.array(shape.outline()), angle) + region.position
    if not isinstance(shape, RingShape):
        return outline, None
    return outline, turn(np.array(shape.hole()), angle) + region.position


def floor_under(
    static_scene: StaticScene, x: float, y: float, below: float = math.inf
) -> float | None:
    """The height of the highest floor at a place, not above ``below``; None over the void."""
    if not static_scene.floors:
        return 0.0
    tops = [
        floor.top
        for floor in static_scene.floors
        if floor.top <= below + 1e-6 and Region(floor).contains(x, y)
    ]
    return max(tops, default=None)


def lowest_floor(static_scene: StaticScene) -> float:
    """The height of the lowest floor; what is lower falls."""
    return min((floor.top for floor in static_scene.floors), default=0.0)


def size(static_scene: StaticScene) -> float:
    """The length of the arena's longer side."""
    (left, low), (right, high) = static_scene.bounds
    return max(right - left, high - low, 4.0)


def seen_bounds(static_scene: StaticScene) -> tuple[tuple[float, float], tuple[float, float]]:
    """What a camera shall show: all of the arena; where the ground is endless, some more."""
    (left, low), (right, high) = static_scene.bounds
    more = 0.0 if static_scene.floors else max(3.0, 0.2 * size(static_scene))
    return (left - more, low - more), (right + more, high + more)
