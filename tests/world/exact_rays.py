"""Reference implementation of rays, solid by solid: slow, simple, and independent of rays.py.

A ray is a half-line in space. A body is a convex outline, rounded or not, that reaches from one
height to another; a floor is a flat sheet. Every solid can be made ``margin`` metres bigger on all
sides: where that changes what a ray meets, the ray only just hits or just misses something.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

from ai4u_edu.world import (
    BodyView,
    BoxShape,
    CapsuleShape,
    CircleShape,
    FloorDescription,
    PolygonShape,
    RingShape,
    SegmentShape,
    World,
)

Vec = tuple[float, float]
Interval = tuple[float, float]
NOTHING = (math.inf, -math.inf)
MARGIN = 1e-6
GROUND = 99.0
"""The code of the endless ground of a world without floors."""


class Ray(NamedTuple):
    """Start of a ray and one metre along it: x, y, z."""

    start: tuple[float, float, float]
    step: tuple[float, float, float]


class Met(NamedTuple):
    """Codes and distance of a ray's hits, one or several at once; 0 and 0 without a hit."""

    codes: frozenset[float]
    distance: float


def meets(world: World, ray: Ray, reach: float, skip: str, mask: int) -> Met | None:
    """Return the hit of a ray, with codes of :func:`code_of`; None where rounding decides."""
    fits = [_first(world, ray, reach, skip, mask, margin) for margin in (0.0, MARGIN, -MARGIN)]
    exact = fits[0]
    for other in fits:
        if other.codes != exact.codes or abs(other.distance - exact.distance) > 1e3 * MARGIN:
            return None
    return exact


def code_of(tags: Sequence[str]) -> float:
    """The number in the first tag; 0 without tags."""
    if not tags:
        return 0.0
    return GROUND if tags[0] == "floor" else float(tags[0].removeprefix("n"))


def _first(world: World, ray: Ray, reach: float, skip: str, mask: int, margin: float) -> Met:
    hits = []
    for name, body in world.bodies.items():
        if name == skip or body.fallen or not body.description.collision_layer & mask:
            continue
        enter, leave = _through(body, ray, margin)
        if max(enter, 0.0) <= leave:
            hits.append((max(enter, 0.0), code_of(body.tags)))
    for floor in world.floors:
        at = _onto(floor, ray, margin)
        if at is not None:
            hits.append((at, code_of(floor.tags)))
    if not world.floors and ray.start[2] * ray.step[2] < 0.0:
        hits.append((-ray.start[2] / ray.step[2], GROUND))
    hits.sort()
    if not hits or hits[0][0] > reach + margin:
        return Met(frozenset({0.0}), 0.0)
    nearest = hits[0][0]
    return Met(frozenset(code for at, code in hits if at - nearest < MARGIN), nearest)


def _through(body: BodyView, ray: Ray, margin: float) -> Interval:
    """From where to where a ray is inside a body."""
    x, y, z = ray.start
    start, step = _into(body.position, body.heading, (x, y), ray.step)
    low, high = body.z - margin - z, body.z + body.height + margin - z
    upright = _slab(low, high, ray.step[2])
    flat = _outline(body, start, step, margin)
    return max(upright[0], flat[0]), min(upright[1], flat[1])


def _outline(body: BodyView, start: Vec, step: Vec, margin: float) -> Interval:
    match body.sampled.shape:
        case CircleShape(radius=radius):
            return _disc((0.0, 0.0), radius + margin, start, step)
        case BoxShape(size=(length, width)):
            a, b = length / 2 + margin, width / 2 + margin
            across = _slab(-a - start[0], a - start[0], step[0])
            along = _slab(-b - start[1], b - start[1], step[1])
            return max(across[0], along[0]), min(across[1], along[1])
        case PolygonShape(vertices=corners):
            return _polygon(corners, start, step, margin)
        case CapsuleShape(length=length, radius=radius):
            return _stick((-length / 2, 0.0), (length / 2, 0.0), radius + margin, start, step)
        case SegmentShape(a=a_end, b=b_end, thickness=thickness):
            return _stick(a_end, b_end, thickness / 2 + margin, start, step)


def _slab(low: float, high: float, speed: float) -> Interval:
    """Return the interval in which a point that starts at 0 is between two walls."""
    if speed == 0.0:
        return (-math.inf, math.inf) if low <= 0.0 <= high else NOTHING
    return min(low / speed, high / speed), max(low / speed, high / speed)


def _disc(centre: Vec, radius: float, start: Vec, step: Vec) -> Interval:
    dx, dy = start[0] - centre[0], start[1] - centre[1]
    a = step[0] ** 2 + step[1] ** 2
    if a == 0.0:
        return (-math.inf, math.inf) if math.hypot(dx, dy) <= radius else NOTHING
    middle = -(dx * step[0] + dy * step[1]) / a
    off = math.hypot(dx + middle * step[0], dy + middle * step[1])
    if off > radius:
        return NOTHING
    half = math.sqrt((radius - off) * (radius + off) / a)
    return middle - half, middle + half


def _polygon(corners: tuple[Vec, ...], start: Vec, step: Vec, margin: float) -> Interval:
    enter, leave = -math.inf, math.inf
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
        length = math.hypot(bx - ax, by - ay)
        nx, ny = (by - ay) / length, (ax - bx) / length
        room = nx * (ax - start[0]) + ny * (ay - start[1]) + margin
        side = _slab(-math.inf, room, nx * step[0] + ny * step[1])
        enter, leave = max(enter, side[0]), min(leave, side[1])
    return enter, leave


def _stick(a: Vec, b: Vec, radius: float, start: Vec, step: Vec) -> Interval:
    """A convex union: a line is in it from the first entry to the last exit of its parts."""
    length = math.dist(a, b)
    nx, ny = (b[1] - a[1]) / length * radius, (a[0] - b[0]) / length * radius
    band = (
        (a[0] + nx, a[1] + ny),
        (b[0] + nx, b[1] + ny),
        (b[0] - nx, b[1] - ny),
        (a[0] - nx, a[1] - ny),
    )
    parts = (
        _polygon(band, start, step, 0.0),
        _disc(a, radius, start, step),
        _disc(b, radius, start, step),
    )
    inside = [part for part in parts if part[0] <= part[1]] or [NOTHING]
    return min(part[0] for part in inside), max(part[1] for part in inside)


def _onto(floor: FloorDescription, ray: Ray, margin: float) -> float | None:
    """Return the distance along a ray to a floor."""
    x, y, z = ray.start
    if ray.step[2] == 0.0:
        return None
    at = (floor.top - z) / ray.step[2]
    place = (x + at * ray.step[0], y + at * ray.step[1])
    (px, py), _ = _into(floor.position, math.radians(floor.heading_deg), place, ray.step)
    return at if at > 0.0 and _covers(floor, px, py, margin) else None


def _covers(floor: FloorDescription, x: float, y: float, margin: float) -> bool:
    still = (0.0, 0.0)
    match floor.shape:
        case CircleShape(radius=radius):
            return math.hypot(x, y) <= radius + margin
        case RingShape(inner=inner, outer=outer):
            return inner - margin <= math.hypot(x, y) <= outer + margin
        case BoxShape(size=(length, width)):
            return abs(x) <= length / 2 + margin and abs(y) <= width / 2 + margin
        case CapsuleShape(length=length, radius=radius):
            ends = (-length / 2, 0.0), (length / 2, 0.0)
            enter, leave = _stick(*ends, radius + margin, (x, y), still)
            return enter <= leave
        case PolygonShape(vertices=corners):
            enter, leave = _polygon(corners, (x, y), still, margin)
            return enter <= leave


def _into(
    origin: Vec, heading: float, place: Vec, step: tuple[float, float, float]
) -> tuple[Vec, Vec]:
    """A place and a direction in the frame of something that stands turned somewhere."""
    cos, sin = math.cos(heading), math.sin(heading)
    dx, dy = place[0] - origin[0], place[1] - origin[1]
    return (
        (cos * dx + sin * dy, cos * dy - sin * dx),
        (cos * step[0] + sin * step[1], cos * step[1] - sin * step[0]),
    )
