"""The part "world": everything in the scene, a form for one thing, and the scene's settings."""

from typing import Any

from ai4u_edu.blocks import RespawnActuator
from ai4u_edu.editing import EditState, SceneEditor
from ai4u_edu.editing.settings import scene_form
from ai4u_edu.editing.thing_form import thing_form
from ai4u_edu.editing.things import Thing, kind_of
from ai4u_edu.panel.new_things import TEMPLATES
from ai4u_edu.panel.page_view import PageView
from ai4u_edu.panel.parts.blocks import changes_json
from ai4u_edu.panel.parts.fields import field_json
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.world import BodyDescription

LAMP_TAG = "lamp"
"""Tag of bodies that are lamps for light sensors."""


def world_part(editor: SceneEditor, view: PageView) -> dict[str, Any]:
    """Return the things of the scene, and the form of the selected one."""
    state, recovery = editor.state, editor.recovery
    described = state.description
    agents = {str(agent.get("body")): str(agent.get("id", "0")) for agent in described.agents}
    unsaved, autosave = recovery.unsaved, recovery.autosave
    return {
        "type": "part",
        "name": "world",
        "title": editor.title,
        "bodies": [
            _thing(thing, agents) | {"is_random": _is_random(thing, described)}
            for thing in reversed(described.things)
        ],
        "form": _form(state, view.show.body, agents),
        "settings": [field_json(each) for each in scene_form(described)],
        "templates": [
            {"name": name, "title": each.title, "icon": each.icon}
            for name, each in TEMPLATES.items()
        ],
        "unsaved": None if unsaved is None else {"name": unsaved.name, "when": unsaved.when},
        "problem": "" if autosave is None else autosave.problem,
        "can_save": editor.scene_store is not None,
        "is_autosaved": autosave is not None and not autosave.problem,
        "is_dragging": editor.is_dragging,
        "is_move_mode": view.is_move_mode,
        "snap": view.snap_m,
        **changes_json(editor),
    }


def _thing(thing: Thing, agents: dict[str, str]) -> dict[str, Any]:
    x, y = thing.position
    return {
        "name": thing.name,
        "kind": _kind(thing, agents),
        "agent": agents.get(thing.name),
        "shape": thing.shape.type,
        "x": x,
        "y": y,
        "heading": thing.heading_deg,
        "movable": isinstance(thing, BodyDescription) and thing.kind == "dynamic",
        "colour": thing.colour,
        "label": thing.label,
    }


def _is_random(thing: Thing, described: SceneDescription) -> bool:
    """Return True if each episode draws a place for a thing, or chooses one."""
    if not isinstance(thing, BodyDescription):
        return False
    return thing.random is not None or any(
        actuator.get("type") == RespawnActuator.__name__
        for agent in described.agents
        if agent.get("body") == thing.name
        for actuator in agent.get("actuators", ())
    )


def _kind(thing: Thing, agents: dict[str, str]) -> str:
    """Return agent, lamp, body, floor or area."""
    if isinstance(thing, BodyDescription):
        is_lamp = LAMP_TAG in thing.tags
        return "agent" if thing.name in agents else "lamp" if is_lamp else "body"
    return kind_of(thing).removesuffix("s")


def _form(state: EditState, name: str | None, agents: dict[str, str]) -> dict[str, Any] | None:
    """Return the form of the selected thing; None if there is no such thing any more."""
    thing = next((each for each in state.description.things if each.name == name), None)
    if thing is None:
        return None
    return {
        "name": thing.name,
        "kind": _kind(thing, agents),
        "fields": [field_json(each) for each in thing_form(thing)],
    }
