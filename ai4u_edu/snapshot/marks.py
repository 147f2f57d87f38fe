"""The look of bodies from above, for all pictures: a robot's parts, a target's rings.

The page draws the same parts as solids. Lengths of the face and of the rings are in radii of the
body, those of :class:`RobotParts` in metres, all in the body's frame: +x ahead, +y to the left.
"""

import math
from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ai4u_edu.snapshot.theme import Rgb
from ai4u_edu.snapshot.types import AgentState, BodyState, StaticScene
from ai4u_edu.world import (
    BodyDescription,
    BoxShape,
    CapsuleShape,
    CircleShape,
    FloorDescription,
    PolygonShape,
    Region,
    RingShape,
    SegmentShape,
)

Disc = tuple[float, float, float]
"""A disc's centre, ahead (+x) and to the left (+y), and its radius."""
Corners = npt.NDArray[np.float64]
_BodyShape = CircleShape | BoxShape | PolygonShape | CapsuleShape | SegmentShape

NOSE = ((0.88, 0.0), (0.56, 0.19), (0.56, -0.19))
"""Corners of the nose, which points ahead. It ends before the rim: as light as a floor, it would
look like a notch there."""
EYES: tuple[Disc, ...] = ((0.38, 0.29, 0.24), (0.38, -0.29, 0.24))
"""Whites of the eyes."""
PUPIL = 0.13
"""Radius of a pupil."""
PUPIL_SHIFT = 0.1
"""Distance by which a pupil is off its eye's middle, towards what the robot looks at."""
RING = 0.72, 0.5
"""Outer and inner radius of a target's ring, which tells targets apart without colour."""
RING_CENTRE = 0.22
"""Radius of the disc in the middle of the ring."""
LIGHT: Rgb = (240, 243, 246)
DARK: Rgb = (24, 28, 34)
CHASSIS: Rgb = (62, 70, 82)
"""Colour of a robot's base and tyres."""
TREAD: Rgb = (172, 180, 189)
"""Colour of the bars on a robot's tyres."""

TREAD_BARS = 6
"""Bars around a tyre."""
TREAD_BAR_RAD = 0.36
"""Angle that a bar takes up."""
SHELL_TOP = 0.9
"""Size of the shell's part that is lit fully from above, as a share of the shell's: its edge is
rounded, and appears darker."""
MAX_FLOOR_CORNER_M = 0.2
"""Largest distance (m) from a floor's corner at which its rounding begins."""
_ROUND_CORNERS = 48
"""Corners of a round shell."""
_WHEEL_WIDTH = 0.24
"""Width of a wheel, in radii of the body."""
_LOOK_STEP_RAD = math.radians(10)
"""Directions of the pupils are multiples of this, so that few of them have to be sent."""


class Wheel(NamedTuple):
    """A wheel, whose axis is along y; it stands on the ground."""

    x: float
    y: float
    radius: float
    width: float


class RobotParts(NamedTuple):
    """The parts of a robot that fill its outline."""

    outline: Corners
    """Outline of the base: that of the body, so a robot touches what it seems to touch."""
    shell: Corners
    """Outline of the coloured shell on the base; between the wheels if there are any."""
    wheels: tuple[Wheel, ...]


def robot_parts(body: BodyDescription) -> RobotParts:
    """Return the parts of an agent's body: two wheels if it is round, four if it is longer.

    A body whose outline has no room for wheels has none.
    """
    return _parts(body.shape, body.height)


@lru_cache(maxsize=256)
def _parts(shape: _BodyShape, height: float) -> RobotParts:
    if isinstance(shape, CircleShape):
        angles = np.arange(_ROUND_CORNERS) * (2 * math.pi / _ROUND_CORNERS)
        outline = shape.radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    else:
        outline = np.array(shape.outline(), np.float64)
    long, wide = np.abs(outline).max(axis=0).tolist()
    radius, is_round = half_width(outline), isinstance(shape, CircleShape)
    width = _WHEEL_WIDTH * radius
    size = min(0.42 * radius, 0.48 * height)
    x, y = (0.0, 0.9 * wide) if is_round else (0.56 * long, 0.97 * wide)
    wheels = [
        Wheel(along, side * (y - width / 2), size, width)
        for along in ((0.0,) if is_round else (x, -x))
        for side in (1, -1)
    ]
    if not all(_holds(outline, wheel) for wheel in wheels):
        wheels = []
    shell = 0.93 * (outline if is_round else rounded(outline, 0.3 * radius))
    if wheels:
        limit = wheels[0].y - 0.3 * width
        shell[:, 1] = np.clip(shell[:, 1], -limit, limit)
    return RobotParts(outline, shell, tuple(wheels))


def _holds(outline: Corners, wheel: Wheel) -> bool:
    """Return True if a wheel seen from above lies in a convex outline."""
    corners = np.array(
        [
            (wheel.x + a * wheel.radius, wheel.y + b * wheel.width / 2)
            for a in (-1, 1)
            for b in (-1, 1)
        ]
    )
    normals = edge_normals(outline)
    depths = (normals * outline).sum(axis=1)
    return bool((corners @ normals.T <= depths + 1e-9).all())


def tread_bars(wheel: Wheel) -> Iterator[Corners]:
    """Yield the bars of a wheel that stands still, seen from above."""
    for number in range(TREAD_BARS):
        angle = number * 2 * math.pi / TREAD_BARS
        if math.cos(angle) > 0.1:
            ends = [wheel.radius * math.sin(angle + by * TREAD_BAR_RAD / 2) for by in (-1, 1)]
            low, high = (wheel.x + min(ends), wheel.x + max(ends))
            left, right = wheel.y + wheel.width / 2, wheel.y - wheel.width / 2
            yield np.array([(high, left), (low, left), (low, right), (high, right)])


def pupils(direction: float = 0.0) -> tuple[Disc, ...]:
    """Return the pupils of eyes that look in a direction (rad); 0 is ahead."""
    dx, dy = PUPIL_SHIFT * math.cos(direction), PUPIL_SHIFT * math.sin(direction)
    return tuple((x + dx, y + dy, PUPIL) for x, y, _ in EYES)


def look_direction(
    static_scene: StaticScene, agent: AgentState, states: dict[str, BodyState]
) -> float:
    """Return the direction in which an agent's eyes look, in its body's frame (rad); 0 is ahead.

    They look at the next stage towards its goal, else at the nearest target, else at the nearest
    thing that its sensors are about.
    """
    own = states[agent.body]
    for places in (
        _next_stages(static_scene, agent, states),
        _targets(static_scene, agent, states),
        _sensed(static_scene, agent, states),
    ):
        if places:
            x, y = min(places, key=lambda place: math.hypot(place[0] - own.x, place[1] - own.y))
            if math.hypot(x - own.x, y - own.y) < 1e-6:
                return 0.0
            angle = math.remainder(math.atan2(y - own.y, x - own.x) - own.heading, math.tau)
            return round(angle / _LOOK_STEP_RAD) * _LOOK_STEP_RAD
    return 0.0


_Places = list[tuple[float, float]]


def _next_stages(
    static_scene: StaticScene, agent: AgentState, states: dict[str, BodyState]
) -> _Places:
    names = {name for stages in agent.stages for name in stages.next}
    return _places(static_scene, names, states) if names else []


def _targets(static_scene: StaticScene, agent: AgentState, states: dict[str, BodyState]) -> _Places:
    names = {body.name for body in static_scene.bodies if "target" in body.tags}
    names |= {area.name for area in static_scene.areas if "target" in area.tags}
    names.discard(agent.body)
    return _places(static_scene, names, states) if names else []


def _sensed(static_scene: StaticScene, agent: AgentState, states: dict[str, BodyState]) -> _Places:
    names = {name for sensor in agent.sensor_infos for name in sensor.targets}
    return _places(static_scene, names - {agent.body}, states)


def _places(static_scene: StaticScene, names: set[str], states: dict[str, BodyState]) -> _Places:
    """Return where the bodies and areas with these names are; bodies out of the world are not."""
    bodies = [states[name] for name in names if name in states and not states[name].fallen]
    areas = [area.position for area in static_scene.areas if area.name in names]
    return [*((body.x, body.y) for body in bodies), *areas]


def floor_outline(static_scene: StaticScene, floor: FloorDescription) -> Corners:
    """Return a floor's outline in the world's frame, with rounded corners."""
    return round_floor(static_scene, floor, Region(floor).outline())


def round_floor(
    static_scene: StaticScene, floor: FloorDescription, outline: npt.ArrayLike
) -> Corners:
    """Round the corners of an outline that a floor has, or of one as far from it all around.

    A corner beside another floor, or in an area, stays as it is, for no gap to be seen there.
    """
    if isinstance(floor.shape, CircleShape | RingShape):
        return np.asarray(outline, np.float64)
    corners = np.array(Region(floor).outline())
    reach = min(MAX_FLOOR_CORNER_M, 0.12 * half_width(corners))
    others = [Region(each) for each in static_scene.floors if each is not floor]
    others += [Region(area) for area in static_scene.areas]
    around = reach * np.array([(0, 0), (1, 0), (0, 1), (-1, 0), (0, -1)]) / 4
    is_free = [
        not any(other.contains_each(*(corner + around).T).any() for other in others)
        for corner in corners
    ]
    return rounded(outline, reach, is_free)


def rounded(outline: npt.ArrayLike, radius: float, is_round: npt.ArrayLike = True) -> Corners:
    """Return a convex outline (n, 2) with corners cut into small arcs.

    Args:
        outline: counter-clockwise.
        radius: distance from a corner at which its arc begins; less beside a short edge.
        is_round: for each corner, True if it gets an arc.

    >>> len(rounded([(1, 1), (-1, 1), (-1, -1), (1, -1)], 0.1))
    20
    """
    corners = np.asarray(outline, np.float64)
    before, after = np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0)
    shares = np.linspace(0.0, 1.0, 5)[:, None]
    parts = []
    rounds = np.broadcast_to(np.asarray(is_round, bool), (len(corners),))
    for corner, back, ahead, cut in zip(corners, before, after, rounds, strict=True):
        if not cut:
            parts.append(corner[None])
            continue
        to_back, to_ahead = back - corner, ahead - corner
        lengths = float(np.linalg.norm(to_back)), float(np.linalg.norm(to_ahead))
        reach = min(radius, 0.45 * min(lengths))
        start, end = corner + reach * to_back / lengths[0], corner + reach * to_ahead / lengths[1]
        # a curve of the second degree, whose ends touch the edges
        parts.append(
            (1 - shares) ** 2 * start + 2 * shares * (1 - shares) * corner + shares**2 * end
        )
    return np.concatenate(parts)


def half_width(outline: npt.ArrayLike) -> float:
    """Return half the smallest width of a convex outline: half a wall's thickness.

    >>> half_width([(2, 1), (-2, 1), (-2, -1), (2, -1)])
    1.0
    """
    corners = np.asarray(outline, np.float64)
    depths = edge_normals(corners) @ corners.T
    return float(np.ptp(depths, axis=1).min() / 2)


def edge_normals(corners: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return the outward unit normal of each edge of a counter-clockwise outline (n, 2)."""
    edges = np.roll(corners, -1, axis=0) - corners
    normals = np.stack([edges[:, 1], -edges[:, 0]], axis=1)
    unit: npt.NDArray[np.float64] = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    return unit
