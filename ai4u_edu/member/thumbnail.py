"""Drawing and poses of a world for the teacher's wall."""

import math
from collections.abc import Iterable, Sequence

from ai4u_edu.base.colors import hex_colour
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.snapshot.marks import (
    CHASSIS,
    DARK,
    EYES,
    LIGHT,
    NOSE,
    RING,
    RING_CENTRE,
    TREAD,
    floor_outline,
    half_width,
    pupils,
    robot_parts,
    tread_bars,
)
from ai4u_edu.snapshot.theme import FLOOR, Rgb, area_fill, body_colour, floor_colour
from ai4u_edu.wire.class_link import BodyDrawing, Drawing, DrawnShape, Poses
from ai4u_edu.wire.validation import MAX_ENTRIES
from ai4u_edu.world import BodyDescription, CircleShape, RegionDescription, RingShape

NUMBERS_PER_POSE = 4
MAX_BODIES = MAX_ENTRIES // NUMBERS_PER_POSE
MAX_CORNERS = MAX_ENTRIES // 2
DIGITS = 3
"""Digits after the point: millimetres and milliradians."""

Point = tuple[float, float]
Pose = tuple[float, float, float]
"""x, y (m) and heading (rad)."""
ORIGIN: Pose = (0.0, 0.0, 0.0)


class Thumbnail:
    """Finds out what has to be sent of a world's latest snapshots.

    One thread calls it. A world that rests costs one comparison of its bodies.
    """

    def __init__(self) -> None:
        self._static_scene: StaticScene | None = None
        self._drawing: Drawing | None = None
        self._bodies: object = None
        self._poses: Poses | None = None

    def changes(self, snapshot: Snapshot) -> list[Drawing | Poses]:
        """Return the messages about all that has changed since the last call."""
        found: list[Drawing | Poses] = []
        if snapshot.static_scene is not self._static_scene:
            self._static_scene = snapshot.static_scene
            before = self._drawing
            drawing = drawing_of(snapshot.static_scene, before.number if before else 1)
            if drawing != before:
                if before is not None:
                    drawing = drawing_of(snapshot.static_scene, before.number + 1)
                self._drawing, self._poses, self._bodies = drawing, None, None
                found.append(drawing)
        if self._drawing is not None and snapshot.bodies != self._bodies:
            self._bodies = snapshot.bodies
            poses = poses_of(snapshot, self._drawing)
            if poses != self._poses:
                self._poses = poses
                found.append(poses)
        return found


def drawing_of(static_scene: StaticScene, number: int) -> Drawing:
    """Return everything that a thumbnail shows, apart from poses.

    A world of more bodies, floors or areas than a message may have is drawn without the rest;
    agents are always drawn.

    Args:
        static_scene: the world.
        number: of the drawing, from 1.
    """
    (left, low), (right, high) = static_scene.bounds
    ground: list[DrawnShape] = []
    if not static_scene.floors:
        corners = [(left, low), (right, low), (right, high), (left, high)]
        ground.append(_polygon(corners, FLOOR))
    floors = sorted(static_scene.floors, key=lambda floor: floor.top)
    for floor in floors:
        shape, colour = floor.shape, floor_colour(floor)
        if isinstance(shape, CircleShape | RingShape):
            ground.append(_region(floor, colour))
        else:
            ground.append(_polygon(floor_outline(static_scene, floor).tolist(), colour))
    ground += [_region(area, area_fill(area)) for area in static_scene.areas]
    bounds = _rounded(left), _rounded(low), _rounded(right), _rounded(high)
    bodies = tuple(
        _body(body, body.name in static_scene.agent_of) for body in _drawn_bodies(static_scene)
    )
    return Drawing(number, bounds, tuple(ground[:MAX_ENTRIES]), bodies)


def poses_of(snapshot: Snapshot, drawing: Drawing) -> Poses:
    """Return the poses of a drawing's bodies; a body that is not there is not visible."""
    states = {state.name: state for state in snapshot.bodies}
    values: list[float] = []
    for body in drawing.bodies:
        state = states.get(body.name)
        if state is None or state.fallen:
            values += [0.0] * NUMBERS_PER_POSE
        else:
            heading = math.remainder(state.heading, math.tau)
            values += [_rounded(state.x), _rounded(state.y), _rounded(heading), 1.0]
    return Poses(drawing.number, tuple(values))


def _drawn_bodies(static_scene: StaticScene) -> list[BodyDescription]:
    bodies, agents = static_scene.bodies, static_scene.agent_of
    if len(bodies) <= MAX_BODIES:
        return list(bodies)
    chosen = sorted(bodies, key=lambda body: body.name not in agents)[:MAX_BODIES]
    names = {body.name for body in chosen}
    return [body for body in bodies if body.name in names]


def _region(region: RegionDescription, colour: Rgb) -> DrawnShape:
    shape, (x, y) = region.shape, region.position
    if isinstance(shape, CircleShape):
        return _disc((x, y, shape.radius), colour)
    corners = shape.outline()
    if isinstance(shape, RingShape):  # one polygon, with a slit
        hole = shape.hole()
        corners = [*corners, corners[0], hole[0], *reversed(hole)]
    return _polygon(corners, colour, (x, y, math.radians(region.heading_deg)))


def _body(body: BodyDescription, is_agent: bool) -> BodyDrawing:
    colour = body_colour(body, is_agent)
    if is_agent:
        return BodyDrawing(body.name, is_agent, tuple(_robot(body, colour)))
    shape = body.shape
    if isinstance(shape, CircleShape):
        shapes = [_disc((0.0, 0.0, shape.radius), colour)]
    else:
        shapes = [_polygon(shape.outline(), colour)]
    if "target" in body.tags:
        radius, (outer, inner) = half_width(shape.outline()), RING
        for size, mark in ((outer, LIGHT), (inner, colour), (RING_CENTRE, LIGHT)):
            shapes.append(_disc((0.0, 0.0, size * radius), mark))
    return BodyDrawing(body.name, is_agent, tuple(shapes))


def _robot(body: BodyDescription, colour: Rgb) -> Iterable[DrawnShape]:
    """Yield a robot's parts, from below; its eyes look ahead, as only its pose is sent later."""
    parts, radius = robot_parts(body), half_width(body.shape.outline())
    if isinstance(body.shape, CircleShape):
        yield _disc((0.0, 0.0, body.shape.radius), CHASSIS)
    else:
        yield _polygon(body.shape.outline(), CHASSIS)
    for wheel in parts.wheels:
        for bar in tread_bars(wheel):
            yield _polygon(bar.tolist(), TREAD)
    yield _polygon(parts.shell.tolist(), colour)
    yield _polygon([(x * radius, y * radius) for x, y in NOSE], LIGHT)
    for discs, mark in ((EYES, LIGHT), (pupils(), DARK)):
        for x, y, size in discs:
            yield _disc((x * radius, y * radius, size * radius), mark)


def _disc(disc: tuple[float, float, float], colour: Rgb) -> DrawnShape:
    """Return a disc from its centre and its radius."""
    x, y, radius = disc
    return DrawnShape(hex_colour(colour), _rounded(radius), (_rounded(x), _rounded(y)))


def _polygon(corners: Sequence[Point], colour: Rgb, pose: Pose = ORIGIN) -> DrawnShape:
    x, y, heading = pose
    cos, sin = math.cos(heading), math.sin(heading)
    numbers: list[float] = []
    for a, b in corners[:MAX_CORNERS]:
        numbers += [_rounded(x + a * cos - b * sin), _rounded(y + a * sin + b * cos)]
    return DrawnShape(hex_colour(colour), 0.0, tuple(numbers))


def _rounded(value: float) -> float:
    return round(value, DIGITS) + 0.0  # no minus zero
