"""What a page can add to a world, and where there is room for it."""

import math
from collections.abc import Iterable, Iterator
from typing import Any

from ai4u_edu.snapshot import Snapshot
from ai4u_edu.viewer.scene.arena import floor_under
from ai4u_edu.world import BodyDescription

BODY_TEMPLATES: dict[str, dict[str, Any]] = {
    "Wall": {
        "name": "wall",
        "shape": {"type": "box", "size": [2, 0.3]},
        "heading_deg": 90,
        "kind": "static",
        "tags": ["wall"],
    },
    "Box": {
        "name": "box",
        "shape": {"type": "box", "size": [0.8, 0.8]},
        "colour": "sky blue",
        "tags": ["box"],
    },
    "Disc": {
        "name": "disc",
        "shape": {"type": "circle", "radius": 0.4},
        "colour": "purple",
        "tags": ["disc"],
    },
    "Target": {
        "name": "target",
        "shape": {"type": "circle", "radius": 0.4},
        "kind": "static",
        "colour": "yellow",
        "tags": ["target"],
        "label": "target",
    },
}
"""By the word on its button."""
SPACING, RINGS = 0.5, 24
"""Places are tried in circles that are so far (m) apart, and in so many of them."""
STEEP = 0.2
"""A camera looks down if it goes down by this share of what it goes ahead."""
CLEARANCE = 0.15
"""Metres that are left free between a new thing and what there is."""


def ground_at_center(position: Iterable[float], look_at: Iterable[float]) -> tuple[float, float]:
    """Where on the ground a camera has the middle of its picture.

    Where it hardly looks down, as out of an agent's eye, that is far off; then it is what the
    camera looks at.

    >>> ground_at_center((3, 4, 10), (3, 4, 5))
    (3.0, 4.0)
    >>> ground_at_center((0, 0, 10), (2, 0, 5))
    (4.0, 0.0)
    >>> ground_at_center((0, 0, 1), (2, 0, 0.99))
    (2.0, 0.0)
    """
    (x, y, z), (ahead, aside, level) = position, look_at
    dx, dy, down = ahead - x, aside - y, z - level
    share = z / down if down > STEEP * math.hypot(dx, dy) else 1.0
    return float(x + share * dx), float(y + share * dy)


def free_position(
    snapshot: Snapshot, thing: dict[str, Any], x: float, y: float
) -> tuple[float, float] | None:
    """The free place for a thing that is nearest to (x, y); None if there is none around."""
    reach = BodyDescription.model_validate(thing).shape.reach + CLEARANCE
    described = {body.name: body for body in snapshot.static_scene.bodies}
    now = [
        (described[state.name], state.x, state.y, state.heading)
        for state in snapshot.bodies
        if not state.fallen and state.name in described
    ]
    begin = [
        (body, *body.position, math.radians(body.heading_deg))
        for body in snapshot.static_scene.bodies
    ]
    for place in _around(x, y):
        on_floor = all(
            floor_under(snapshot.static_scene, place[0] + dx * reach, place[1] + dy * reach)
            is not None
            for dx, dy in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))
        )
        if on_floor and all(
            _gap(place, *_half(body), *pose) > reach for body, *pose in (*now, *begin)
        ):
            return place
    return None


def _half(body: BodyDescription) -> tuple[float, float]:
    """Half the sides of a rectangle around a body's centre, which has all of it in it."""
    outline = body.shape.outline()
    return max(abs(x) for x, _ in outline), max(abs(y) for _, y in outline)


def _gap(
    place: tuple[float, float], along: float, across: float, x: float, y: float, heading: float
) -> float:
    """How far a place is from a rectangle."""
    dx, dy, cos, sin = place[0] - x, place[1] - y, math.cos(heading), math.sin(heading)
    ahead, aside = cos * dx + sin * dy, cos * dy - sin * dx
    return math.hypot(max(abs(ahead) - along, 0.0), max(abs(aside) - across, 0.0))


def _around(x: float, y: float) -> Iterator[tuple[float, float]]:
    """Places around one, from the nearest to the farthest."""
    yield round(x, 1), round(y, 1)
    for ring in range(1, RINGS):
        for step in range(6 * ring):
            angle = step * math.pi / 3 / ring
            radius = SPACING * ring
            yield round(x + radius * math.cos(angle), 1), round(y + radius * math.sin(angle), 1)
