"""Decomposition of a shape into discs and convex polygons."""

import math
from typing import NamedTuple

from ai4u_edu.world import (
    BoxShape,
    CapsuleShape,
    CircleShape,
    PolygonShape,
    RingShape,
    SegmentShape,
)

Shape = CircleShape | BoxShape | PolygonShape | CapsuleShape | SegmentShape | RingShape
Point = tuple[float, float]
Disc = tuple[float, float, float]
"""(x, y, radius)."""
Edge = tuple[float, float, float]
"""(a, b, c): inside is a x + b y <= c; (a, b) has length 1."""


class Footprint(NamedTuple):
    """Parts that together cover one shape, in its own frame, metres."""

    discs: tuple[Disc, ...] = ()
    polygons: tuple[tuple[Edge, ...], ...] = ()
    hole: Disc | None = None
    """Cut out of the first disc."""


def footprint(shape: Shape, thinnest: float = 0.0) -> Footprint:
    """Decompose a shape.

    Args:
        shape: the shape of a body, a floor or an area.
        thinnest: minimum thickness, metres; thinner shapes are widened to it, so that no wall falls
            between two sample points.
    """
    least = thinnest / 2
    match shape:
        case CircleShape():
            return Footprint(((0.0, 0.0, max(shape.radius, least)),))
        case RingShape():
            return Footprint(((0.0, 0.0, shape.outer),), hole=(0.0, 0.0, shape.inner))
        case BoxShape():
            a, b = (max(side / 2, least) for side in shape.size)
            return Footprint(polygons=(edges([(a, b), (-a, b), (-a, -b), (a, -b)]),))
        case PolygonShape():
            corners = shape.outline()
            x, y = (sum(each) / len(corners) for each in zip(*corners, strict=True))
            return Footprint(((x, y, least),) if least else (), (edges(corners),))
        case CapsuleShape():
            half = shape.length / 2
            return _stick((-half, 0.0), (half, 0.0), max(shape.radius, least))
        case SegmentShape():
            return _stick(shape.a, shape.b, max(shape.thickness / 2, least))


def edges(corners: list[Point]) -> tuple[Edge, ...]:
    """Return the edges of a convex polygon from its corners, counter-clockwise.

    >>> edges([(1, 0), (0, 1), (0, 0)])[1:]
    ((-1.0, 0.0, 0.0), (0.0, -1.0, 0.0))
    """
    found = []
    for (x, y), (to_x, to_y) in zip(corners, [*corners[1:], corners[0]], strict=True):
        length = math.hypot(to_x - x, to_y - y)
        a, b = (to_y - y) / length, (x - to_x) / length
        found.append((a + 0.0, b + 0.0, a * x + b * y + 0.0))  # no -0.0
    return tuple(found)


def _stick(a: Point, b: Point, radius: float) -> Footprint:
    (ax, ay), (bx, by) = a, b
    length = math.hypot(bx - ax, by - ay)
    across_x, across_y = (ay - by) / length * radius, (bx - ax) / length * radius
    strip = [
        (ax - across_x, ay - across_y),
        (bx - across_x, by - across_y),
        (bx + across_x, by + across_y),
        (ax + across_x, ay + across_y),
    ]
    return Footprint(((ax, ay, radius), (bx, by, radius)), (edges(strip),))
