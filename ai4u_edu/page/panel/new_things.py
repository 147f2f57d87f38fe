"""Things that a page can add to a world, their pictures, and what lies or has room where."""

import base64
import io
import math
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any, Literal, NamedTuple

from PIL import Image

from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.things import Thing
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.snapshot.raster import draw_thing
from ai4u_edu.world import BodyDescription
from ai4u_edu.world.region import Region

Place = tuple[float, float]


class Template(NamedTuple):
    """A thing that can be added."""

    title: str
    kind: Literal["bodies", "floors", "areas", "agents"]
    description: Mapping[str, Any]


TEMPLATES: Mapping[str, Template] = {
    "wall": Template(
        _("Wall"),
        "bodies",
        {
            "name": "wall",
            "shape": {"type": "box", "size": [2, 0.3]},
            "heading_deg": 90,
            "kind": "static",
            "tags": ["wall"],
        },
    ),
    "box": Template(
        _("Box"),
        "bodies",
        {
            "name": "box",
            "shape": {"type": "box", "size": [0.8, 0.8]},
            "colour": "sky blue",
            "tags": ["box"],
        },
    ),
    "ball": Template(
        _("Ball"),
        "bodies",
        {
            "name": "ball",
            "shape": {"type": "circle", "radius": 0.4},
            "colour": "purple",
            "tags": ["disc"],
        },
    ),
    "target": Template(
        _("Target"),
        "bodies",
        {
            "name": "target",
            "shape": {"type": "circle", "radius": 0.4},
            "kind": "static",
            "colour": "yellow",
            "tags": ["target"],
            "label": "target",
        },
    ),
    "lamp": Template(
        _("Lamp"),
        "bodies",
        {
            "name": "lamp",
            "shape": {"type": "circle", "radius": 0.3},
            "kind": "static",
            "colour": "yellow",
            "tags": ["lamp"],
        },
    ),
    "area": Template(
        _("Area"),
        "areas",
        {"name": "area", "shape": {"type": "circle", "radius": 1.0}, "tags": ["area"]},
    ),
    "floor": Template(
        _("Floor"), "floors", {"name": "floor", "shape": {"type": "box", "size": [4, 4]}}
    ),
    "agent": Template(_("Robot"), "agents", {"name": "robot"}),
}
"""Templates by the name that a page sends. A robot is a copy of the one that the page shows."""
RING_SPACING_M = 0.5
"""Distance (m) between the rings of positions that are tried."""
MAX_RINGS = 23
"""Number of those rings."""
CLEARANCE_M = 0.15
"""Free distance (m) between a new body and the others."""
ASIDE_STEP_M, MAX_ASIDE_M = 0.5, 4.0
"""Grid of the places around one that a person chose, and the distance to the last of them (m)."""
PICTURE_PX = 96
"""Side of a thing's picture."""
PICTURE_MARGIN = 1.06
"""Distance from the middle of a picture to its sides, as a share of the thing's reach."""


class ThingPicture(NamedTuple):
    """The picture of a thing from above."""

    url: str
    """The picture as a ``data:`` address."""
    side_m: float
    """Length of its sides in the world (m)."""


@lru_cache(maxsize=64)
def picture_of(thing: Thing, *, is_agent: bool) -> ThingPicture:
    """Return the picture of a thing; it is drawn once."""
    reach = PICTURE_MARGIN * thing.shape.reach
    drawn = draw_thing(thing, reach, is_agent=is_agent, longest=PICTURE_PX)
    out = io.BytesIO()
    Image.fromarray(drawn).save(out, "PNG", optimize=True)
    text = base64.b64encode(out.getvalue()).decode()
    return ThingPicture(f"data:image/png;base64,{text}", 2 * reach)


def free_position(
    snapshot: Snapshot, template: dict[str, Any], x: float, y: float
) -> tuple[float, float] | None:
    """Return the free position for a body nearest to (x, y); None if there is none around.

    A position is free if the body fits on a floor there, and touches no body now or at a reset.
    """
    reach = BodyDescription.model_validate(template).shape.reach + CLEARANCE_M
    placed = tuple(_placed_bodies(snapshot))
    for position in _positions_around(x, y):
        on_floor = all(
            snapshot.static_scene.floor_under(position[0] + dx * reach, position[1] + dy * reach)
            is not None
            for dx, dy in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))
        )
        if on_floor and all(
            _distance_to_box(position, *_half_extents(body), *pose) > reach
            for body, *pose in placed
        ):
            return position
    return None


def free_offset(
    snapshot: Snapshot, bodies: Sequence[BodyDescription], dx: float, dy: float
) -> tuple[float, float] | None:
    """Return an offset (m) by which new bodies have room together: the nearest to (dx, dy).

    The centre of each has to be on a floor then, and it may overlap no body that is there, unless
    neither can move. None if there is none near.
    """
    placed = list(_placed_bodies(snapshot))
    boxes = [
        (
            _Box.around(body, *body.position, math.radians(body.heading_deg)),
            [
                _Box.around(other, *pose)
                for other, *pose in placed
                if "static" not in (body.kind, other.kind) or body.kind != other.kind
            ],
        )
        for body in bodies
    ]
    for aside_x, aside_y in _ASIDE:
        offset = dx + aside_x, dy + aside_y
        if all(_has_room(snapshot, box.moved(*offset), others) for box, others in boxes):
            return offset
    return None


def _has_room(snapshot: Snapshot, box: "_Box", others: Sequence["_Box"]) -> bool:
    is_on_floor = snapshot.static_scene.floor_under(box.x, box.y) is not None
    return is_on_floor and not any(box.overlaps(other) for other in others)


def _placed_bodies(
    snapshot: Snapshot,
) -> Iterator[tuple[BodyDescription, float, float, float]]:
    """Yield each body with its pose now, if it has not fallen, and at a reset."""
    described = {body.name: body for body in snapshot.static_scene.bodies}
    for state in snapshot.bodies:
        if not state.fallen and state.name in described:
            yield described[state.name], state.x, state.y, state.heading
    for body in described.values():
        yield body, *body.position, math.radians(body.heading_deg)


class _Box(NamedTuple):
    """A rectangle around a body: centre, half sides, and heading."""

    x: float
    y: float
    along: float
    across: float
    heading: float

    @classmethod
    def around(cls, body: BodyDescription, x: float, y: float, heading: float) -> "_Box":
        return cls(x, y, *_half_extents(body), heading)

    def moved(self, dx: float, dy: float) -> "_Box":
        return self._replace(x=self.x + dx, y=self.y + dy)

    def overlaps(self, other: "_Box") -> bool:
        """Return True unless a line along one of the sides separates the two."""
        reach = self.along + self.across + other.along + other.across
        if abs(self.x - other.x) >= reach or abs(self.y - other.y) >= reach:
            return False
        return not any(
            self._is_apart(other, heading + turn)
            for heading in (self.heading, other.heading)
            for turn in (0.0, math.pi / 2)
        )

    def _is_apart(self, other: "_Box", direction: float) -> bool:
        cos, sin = math.cos(direction), math.sin(direction)
        distance = abs(cos * (other.x - self.x) + sin * (other.y - self.y))
        return distance >= self._reach(direction) + other._reach(direction) - 1e-9

    def _reach(self, direction: float) -> float:
        turn = direction - self.heading
        return self.along * abs(math.cos(turn)) + self.across * abs(math.sin(turn))


def _half_extents(body: BodyDescription) -> tuple[float, float]:
    """Return half the sides of a rectangle, centred on a body's origin, that contains the body."""
    outline = body.shape.outline()
    return max(abs(x) for x, _ in outline), max(abs(y) for _, y in outline)


def _distance_to_box(
    position: tuple[float, float], along: float, across: float, x: float, y: float, heading: float
) -> float:
    """Return a position's distance from a rectangle, given by its half sides and pose."""
    dx, dy, cos, sin = position[0] - x, position[1] - y, math.cos(heading), math.sin(heading)
    ahead, aside = cos * dx + sin * dy, cos * dy - sin * dx
    return math.hypot(max(abs(ahead) - along, 0.0), max(abs(aside) - across, 0.0))


def _positions_around(x: float, y: float) -> Iterator[tuple[float, float]]:
    """Yield positions around (x, y), nearest first."""
    yield round(x, 1), round(y, 1)
    for ring in range(1, MAX_RINGS + 1):
        for step in range(6 * ring):
            angle = step * math.pi / 3 / ring
            radius = RING_SPACING_M * ring
            yield round(x + radius * math.cos(angle), 1), round(y + radius * math.sin(angle), 1)


_STEPS = range(-round(MAX_ASIDE_M / ASIDE_STEP_M), round(MAX_ASIDE_M / ASIDE_STEP_M) + 1)
_ASIDE = sorted(
    ((ASIDE_STEP_M * right, ASIDE_STEP_M * up) for right in _STEPS for up in _STEPS),
    key=lambda offset: math.hypot(*offset),
)
"""Offsets from a place that a person chose, the nearest first."""


def things_within(snapshot: Snapshot, corners: Sequence[Place]) -> list[str]:
    """Return the names of the bodies and areas whose middle is within a convex frame (m).

    Floors lie under everything, so a frame leaves them out.
    """
    places = {state.name: (state.x, state.y) for state in snapshot.bodies if not state.fallen}
    places |= {area.name: area.position for area in snapshot.static_scene.areas}
    return [name for name, place in places.items() if _is_within(place, corners)]


def thing_at(snapshot: Snapshot, x: float, y: float) -> str | None:
    """Return the name of the uppermost thing at a place (m); None over the void."""
    static_scene = snapshot.static_scene
    described = {body.name: body for body in static_scene.bodies}
    found: list[tuple[float, str]] = []
    for state in snapshot.bodies:
        body = described.get(state.name)
        if body is None or state.fallen:
            continue
        if _covers(body, x - state.x, y - state.y, state.heading):
            found.append((state.z + body.height, state.name))
    if found:
        return max(found)[1]
    regions = (*reversed(static_scene.areas), *sorted(static_scene.floors, key=lambda f: -f.top))
    return next((region.name for region in regions if Region(region).contains(x, y)), None)


def aligned_places(
    places: Mapping[str, Place], how: Literal["row", "column", "spread"]
) -> dict[str, Place]:
    """Return places in a row or a column through the middle, or at equal distances on a line.

    >>> aligned_places({"a": (0, 1), "b": (2, 3)}, "row")
    {'a': (0, 2.0), 'b': (2, 2.0)}
    >>> aligned_places({"a": (0, 0), "b": (1, 0), "c": (4, 2)}, "spread")
    {'a': (0.0, 0.0), 'b': (2.0, 1.0), 'c': (4.0, 2.0)}
    """
    xs, ys = [x for x, _ in places.values()], [y for _, y in places.values()]
    if how == "row":
        return {name: (x, sum(ys) / len(ys)) for name, (x, _) in places.items()}
    if how == "column":
        return {name: (sum(xs) / len(xs), y) for name, (_, y) in places.items()}
    axis = 0 if max(xs) - min(xs) >= max(ys) - min(ys) else 1
    order = sorted(places, key=lambda name: places[name][axis])
    (x0, y0), (x1, y1) = places[order[0]], places[order[-1]]
    steps = max(len(order) - 1, 1)
    spread = {
        name: (x0 + number / steps * (x1 - x0), y0 + number / steps * (y1 - y0))
        for number, name in enumerate(order)
    }
    return {name: spread[name] for name in places}


def _is_within(place: Place, corners: Sequence[Place]) -> bool:
    """Return True for a place on the same side of all edges of a convex polygon."""
    (x, y), sides = place, []
    for (x0, y0), (x1, y1) in zip(corners, (*corners[1:], corners[0]), strict=True):
        sides.append((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0))
    return all(side >= 0 for side in sides) or all(side <= 0 for side in sides)


def _covers(body: BodyDescription, dx: float, dy: float, heading: float) -> bool:
    cos, sin = math.cos(heading), math.sin(heading)
    outline = body.shape.outline()
    return _is_within((cos * dx + sin * dy, cos * dy - sin * dx), outline)
