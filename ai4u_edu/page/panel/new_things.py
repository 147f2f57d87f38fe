"""Things that a page can add to a world, and the search for a free position."""

import math
from collections.abc import Iterator, Mapping
from typing import Any, Literal, NamedTuple

from ai4u_edu.snapshot import Snapshot
from ai4u_edu.world import BodyDescription


class Template(NamedTuple):
    """A thing that can be added."""

    title: str
    icon: str
    """Name of its icon in ``web/shared/icons.js``."""
    kind: Literal["bodies", "floors", "areas", "agents"]
    description: Mapping[str, Any]


TEMPLATES: Mapping[str, Template] = {
    "wall": Template(
        "Wall",
        "wall",
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
        "box",
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
        "ball",
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
        "target",
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
        "lamp",
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
        "area",
        "areas",
        {"name": "area", "shape": {"type": "circle", "radius": 1.0}, "tags": ["area"]},
    ),
    "floor": Template(
        "Floor", "floor", "floors", {"name": "floor", "shape": {"type": "box", "size": [4, 4]}}
    ),
    "agent": Template("Agent", "agent", "agents", {"name": "robot"}),
}
"""Templates by the name that a page sends. An agent is a copy of the one that the page shows."""
RING_SPACING_M = 0.5
"""Distance (m) between the rings of positions that are tried."""
MAX_RINGS = 23
"""Number of those rings."""
CLEARANCE_M = 0.15
"""Free distance (m) between a new body and the others."""


def free_position(
    snapshot: Snapshot, template: dict[str, Any], x: float, y: float
) -> tuple[float, float] | None:
    """Return the free position for a body nearest to (x, y); None if there is none around.

    A position is free if the body fits on a floor there, and touches no body now or at a reset.
    """
    reach = BodyDescription.model_validate(template).shape.reach + CLEARANCE_M
    described = {body.name: body for body in snapshot.static_scene.bodies}
    now = [
        (described[state.name], state.x, state.y, state.heading)
        for state in snapshot.bodies
        if not state.fallen and state.name in described
    ]
    at_reset = [
        (body, *body.position, math.radians(body.heading_deg))
        for body in snapshot.static_scene.bodies
    ]
    for position in _positions_around(x, y):
        on_floor = all(
            snapshot.static_scene.floor_under(position[0] + dx * reach, position[1] + dy * reach)
            is not None
            for dx, dy in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))
        )
        if on_floor and all(
            _distance_to_box(position, *_half_extents(body), *pose) > reach
            for body, *pose in (*now, *at_reset)
        ):
            return position
    return None


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
