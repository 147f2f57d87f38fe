"""The rectangle around all places that the things of a world may be given."""

import math
from collections.abc import Iterable
from itertools import product

from ai4u_edu.world.descriptions import BodyDescription, RegionDescription

Rectangle = tuple[tuple[float, float], tuple[float, float]]
Corner = tuple[float, float]

EMPTY_WORLD: Rectangle = (-5.0, -5.0), (5.0, 5.0)


def bounds_of(things: Iterable[BodyDescription | RegionDescription]) -> Rectangle:
    """Return the rectangle ((x0, y0), (x1, y1)), metres, around all things in any episode."""
    corners = [corner for thing in things for corner in _corners(thing)]
    if not corners:
        return EMPTY_WORLD
    xs, ys = zip(*corners, strict=True)
    return (min(xs), min(ys)), (max(xs), max(ys))


def _corners(thing: BodyDescription | RegionDescription) -> list[Corner]:
    return [(x + dx, y + dy) for x, y in _places(thing) for dx, dy in _outline(thing)]


def _places(thing: BodyDescription | RegionDescription) -> Iterable[Corner]:
    x, y = thing.position
    vary = thing.random
    if vary is None:
        return [(x, y)]
    return vary.places or product(vary.x or (x,), vary.y or (y,))


def _outline(thing: BodyDescription | RegionDescription) -> list[Corner]:
    """Return corners around a thing's place, of its smallest and largest scale and any heading."""
    vary = thing.random
    scales = (vary and vary.scale) or (1.0,)
    if vary is not None and vary.heading_deg is not None:
        reach = thing.shape.reach * max(scales)
        return [(-reach, -reach), (reach, reach)]
    angle = math.radians(thing.heading_deg)
    cos, sin = math.cos(angle), math.sin(angle)
    points = [point for scale in scales for point in thing.shape.scaled(scale).outline()]
    return [(cos * x - sin * y, sin * x + cos * y) for x, y in points]
