"""Things that a page can add to a world: their pictures, and the search for a free position."""

import base64
import io
import math
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Any, Literal, NamedTuple

from PIL import Image

from ai4u_edu.page.editing.things import Thing
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.snapshot.raster import draw_thing
from ai4u_edu.world import BodyDescription


class Template(NamedTuple):
    """A thing that can be added."""

    title: str
    kind: Literal["bodies", "floors", "areas", "agents"]
    description: Mapping[str, Any]


TEMPLATES: Mapping[str, Template] = {
    "wall": Template(
        "Wall",
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
        "Box",
        "bodies",
        {
            "name": "box",
            "shape": {"type": "box", "size": [0.8, 0.8]},
            "colour": "sky blue",
            "tags": ["box"],
        },
    ),
    "ball": Template(
        "Ball",
        "bodies",
        {
            "name": "ball",
            "shape": {"type": "circle", "radius": 0.4},
            "colour": "purple",
            "tags": ["disc"],
        },
    ),
    "target": Template(
        "Target",
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
        "Lamp",
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
        "Area",
        "areas",
        {"name": "area", "shape": {"type": "circle", "radius": 1.0}, "tags": ["area"]},
    ),
    "floor": Template(
        "Floor", "floors", {"name": "floor", "shape": {"type": "box", "size": [4, 4]}}
    ),
    "agent": Template("Robot", "agents", {"name": "robot"}),
}
"""Templates by the name that a page sends. A robot is a copy of the one that the page shows."""
RING_SPACING_M = 0.5
"""Distance (m) between the rings of positions that are tried."""
MAX_RINGS = 23
"""Number of those rings."""
CLEARANCE_M = 0.15
"""Free distance (m) between a new body and the others."""
MAX_ASIDE_RINGS = 4
"""Number of rings around a place that a person chose."""
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


def free_position_beside(
    snapshot: Snapshot, template: dict[str, Any], x: float, y: float
) -> tuple[float, float] | None:
    """Return the place that a person chose for a body, or the nearest free one within 2 m.

    Its centre has to be on a floor, and it may overlap no body, unless neither can move.
    """
    body = BodyDescription.model_validate(template)
    placed = [
        _Box.around(other, *pose)
        for other, *pose in _placed_bodies(snapshot)
        if "static" not in (body.kind, other.kind) or body.kind != other.kind
    ]
    heading = math.radians(body.heading_deg)
    for at in ((x, y), *_positions_around(x, y, MAX_ASIDE_RINGS)):
        box = _Box.around(body, *at, heading)
        if snapshot.static_scene.floor_under(*at) is not None and not any(
            box.overlaps(other) for other in placed
        ):
            return at
    return None


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

    def overlaps(self, other: "_Box") -> bool:
        """Return True unless a line along one of the sides separates the two."""
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


def _positions_around(x: float, y: float, rings: int = MAX_RINGS) -> Iterator[tuple[float, float]]:
    """Yield positions around (x, y), nearest first."""
    yield round(x, 1), round(y, 1)
    for ring in range(1, rings + 1):
        for step in range(6 * ring):
            angle = step * math.pi / 3 / ring
            radius = RING_SPACING_M * ring
            yield round(x + radius * math.cos(angle), 1), round(y + radius * math.sin(angle), 1)
