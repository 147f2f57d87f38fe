"""Things that a page can add to a world, and copies of things that are there."""

from collections.abc import Mapping
from concurrent.futures import Future
from typing import Any, Literal, NamedTuple

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.editing import ChangeResult, SceneEditor
from ai4u_edu.editing.state import EditState
from ai4u_edu.editing.things import body_named, free_name, kind_of, thing_named
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.viewer.panel.add_menu import free_position
from ai4u_edu.world import BodyDescription

Kind = Literal["bodies", "floors", "areas", "agents"]
GRID_M = 0.5
"""New floors and areas lie on a grid of this size (m)."""
_TEMPLATES: dict[str, tuple[Kind, dict[str, Any]]] = {
    "wall": (
        "bodies",
        {"shape": {"type": "box", "size": [2, 0.3]}, "kind": "static", "tags": ["wall"]},
    ),
    "box": (
        "bodies",
        {"shape": {"type": "box", "size": [0.8, 0.8]}, "colour": "sky blue", "tags": ["box"]},
    ),
    "ball": (
        "bodies",
        {
            "shape": {"type": "circle", "radius": 0.4},
            "colour": "purple",
            "elasticity": 0.6,
            "tags": ["ball"],
        },
    ),
    "lamp": (
        "bodies",
        {
            "shape": {"type": "circle", "radius": 0.3},
            "colour": "yellow",
            "kind": "static",
            "tags": ["lamp"],
            "label": "lamp",
        },
    ),
    "floor": ("floors", {"shape": {"type": "box", "size": [4, 4]}}),
    "area": (
        "areas",
        {"shape": {"type": "box", "size": [2, 2]}, "colour": "green", "label": "area"},
    ),
}
WHATS = (*_TEMPLATES, "agent")
"""Words for what can be added."""


class NewThing(NamedTuple):
    """A thing to add; its place is still to be found."""

    kind: Kind
    template: Mapping[str, Any]
    """Its description, without a place."""
    like: str = ""
    """Id of the agent whose blocks a new agent gets."""

    @property
    def name(self) -> str:
        """Its name."""
        return str(self.template["name"])


def describe(what: str, state: EditState, like: str) -> NewThing:
    """Return a new thing with a name that is free.

    Args:
        what: one of :data:`WHATS`.
        state: has the scene.
        like: id of the agent that a new agent is a copy of.

    Raises:
        NameNotFoundError: it can't be added.
    """
    if what == "agent":
        return copy_of(str(state.agent(like)["body"]), state)
    if what not in _TEMPLATES:
        raise NameNotFoundError(f"{what!r} can't be added; {suggest(what, WHATS)}")
    kind, template = _TEMPLATES[what]
    return NewThing(kind, {"name": free_name(state, what), **template})


def copy_of(name: str, state: EditState) -> NewThing:
    """Return a copy of a thing, or of the agent whose body it is, with a name that is free.

    Raises:
        NameNotFoundError: there is no such thing.
    """
    thing = thing_named(state, name)
    template = thing.model_dump(mode="json", exclude_unset=True, exclude={"random", "position"})
    template["name"] = free_name(state, name)
    agents = [each for each in state.description.agents if each.get("body") == name]
    if agents:
        body_named(state, name)
        return NewThing("agents", template, str(agents[0].get("id", "0")))
    return NewThing(kind_of(thing), template)


def place_for(new: NewThing, snapshot: Snapshot, x: float, y: float) -> tuple[float, float] | None:
    """Return the place for a new thing nearest to (x, y) (m); None if there is no room.

    Bodies need room among the others; floors and areas lie under everything.
    """
    if new.kind in {"bodies", "agents"}:
        body = BodyDescription.model_validate(new.template)
        return free_position(snapshot, body.model_dump(mode="json"), x, y)
    return round(x / GRID_M) * GRID_M, round(y / GRID_M) * GRID_M


def add(editor: SceneEditor, new: NewThing, x: float, y: float) -> "Future[ChangeResult]":
    """Add a thing at a place (m)."""
    template = {**new.template, "position": (x, y)}
    if new.kind == "agents":
        return editor.add_agent(template, new.like)
    if new.kind == "bodies":
        return editor.add_body(template)
    return editor.add_region(template, new.kind)


def remove(editor: SceneEditor, name: str) -> "Future[ChangeResult]":
    """Remove a thing, or the agent whose body it is."""
    for agent in editor.state.description.agents:
        if agent.get("body") == name:
            return editor.remove_agent(str(agent.get("id", "0")))
    return editor.remove_body(name)
