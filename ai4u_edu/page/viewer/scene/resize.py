"""Shapes of another size, for a person who pulls at a corner."""

import math
from typing import TypeVar

from ai4u_edu.world import BoxShape, CapsuleShape, CircleShape
from ai4u_edu.world.shapes import Shape

ShapeT = TypeVar("ShapeT", bound=Shape)

MIN_SIZE_M = 0.1
"""Smallest length (m) that a person can pull a shape to."""
FREE_STEP_M = 0.01
"""Lengths are multiples of it if they don't snap to a grid."""


def corner_of(shape: Shape) -> tuple[float, float]:
    """Return the place of the resize knob in the shape's own frame.

    >>> corner_of(BoxShape(size=(2, 1)))
    (1.0, 0.5)
    """
    if isinstance(shape, CircleShape):
        return shape.radius * math.sqrt(0.5), shape.radius * math.sqrt(0.5)
    outline = outline_of(shape)
    return max(x for x, _ in outline), max(y for _, y in outline)


def resized(shape: ShapeT, x: float, y: float, snap_m: float = 0.0) -> ShapeT:
    """Return a shape of the size at which its corner lies at a place.

    Args:
        shape: the shape before.
        x: place of the pointer in the shape's own frame (m).
        y: likewise.
        snap_m: lengths are multiples of it; 0 for free ones.

    >>> resized(BoxShape(size=(2, 1)), 1.6, 0.52, 0.5).size
    (3.0, 1.0)
    >>> resized(CircleShape(radius=1), 0.3, 0.4).radius
    0.5
    """
    if isinstance(shape, BoxShape):
        return shape.model_copy(
            update={"size": (_length(2 * abs(x), snap_m), _length(2 * abs(y), snap_m))}
        )
    if isinstance(shape, CircleShape):
        return shape.model_copy(update={"radius": _length(2 * math.hypot(x, y), snap_m) / 2})
    if isinstance(shape, CapsuleShape):
        radius = _length(2 * abs(y), snap_m) / 2
        length = _length(2 * max(abs(x) - radius, 0.0), snap_m)
        return shape.model_copy(update={"radius": radius, "length": length})
    reach = math.hypot(*corner_of(shape))
    return shape.scaled(max(math.hypot(x, y), MIN_SIZE_M) / max(reach, MIN_SIZE_M))


def outline_of(shape: Shape) -> list[tuple[float, float]]:
    """Return a shape's outline; every kind of shape has one."""
    outline: list[tuple[float, float]] = shape.outline()  # type: ignore[attr-defined]
    return outline


def _length(wanted: float, snap_m: float) -> float:
    step = snap_m or FREE_STEP_M
    return max(round(round(wanted / step) * step, 6), step, MIN_SIZE_M)
