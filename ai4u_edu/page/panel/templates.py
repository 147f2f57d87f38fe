"""Things that a page can add to a world."""

from collections.abc import Mapping
from typing import Any, Literal, NamedTuple

from ai4u_edu.page.viewer.scene.new_things import BODY_TEMPLATES


class Template(NamedTuple):
    """A thing that can be added."""

    title: str
    icon: str
    """Name of its icon in ``web/shared/icons.js``."""
    kind: Literal["bodies", "floors", "areas", "agents"]
    description: Mapping[str, Any]


TEMPLATES: Mapping[str, Template] = {
    "wall": Template("Wall", "wall", "bodies", BODY_TEMPLATES["Wall"]),
    "box": Template("Box", "box", "bodies", BODY_TEMPLATES["Box"]),
    "ball": Template("Ball", "ball", "bodies", {**BODY_TEMPLATES["Disc"], "name": "ball"}),
    "target": Template("Target", "target", "bodies", BODY_TEMPLATES["Target"]),
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
