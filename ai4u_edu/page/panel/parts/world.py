"""The part "world": everything in the scene, a form for one thing, and the scene's settings."""

from typing import Literal

from msgspec import Struct

from ai4u_edu.blocks import RespawnActuator
from ai4u_edu.page.editing import EditState, SceneEditor
from ai4u_edu.page.editing.settings import field_form, scene_form
from ai4u_edu.page.editing.thing_form import thing_form
from ai4u_edu.page.editing.things import Thing, kind_of
from ai4u_edu.page.panel.page_view import PageView
from ai4u_edu.page.panel.parts.blocks import UndoLabel, undo_labels
from ai4u_edu.page.panel.parts.fields import FormField, form_field
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.scenes.yaml.file import MAX_SCENE_BYTES
from ai4u_edu.world import AreaDescription, BodyDescription
from ai4u_edu.world.pictures import MAX_PICTURE_BYTES

FIRST_OF_FIELD = (
    "type",
    "width",
    "height",
    "length",
    "loops",
    "curves",
    "crossings",
    "gaps",
    "obstacles",
    "difficulty",
)
"""Parameters of a generated field that matter most."""
LAMP_TAG = "lamp"
"""Tag of bodies that are lamps for light sensors."""


class SceneThing(Struct, frozen=True):
    """A body, floor or area of the scene."""

    name: str
    kind: str
    """``agent``, ``lamp``, ``body``, ``floor``, ``area`` or ``picture``."""
    agent: str | None
    """Id of the agent whose body it is; null if it is nobody's."""
    shape: str
    """Type of its shape, such as ``box``."""
    x: float
    """Position (m) in the scene's file."""
    y: float
    heading: float
    """Heading (degrees) in the scene's file, from the x axis counterclockwise."""
    movable: bool
    """True for a body that physics moves."""
    colour: str | None
    """Name of its colour; null for the colour of its kind."""
    label: str | None
    """Text on it."""
    is_random: bool
    """True if each episode draws a place for it, or chooses one."""


class ThingForm(Struct, frozen=True):
    """The form of one thing."""

    name: str
    kind: str
    """Kind of the thing, as in its row."""
    fields: list[FormField]


class UnsavedScene(Struct, frozen=True):
    """A scene that somebody changed and did not save."""

    name: str
    when: str
    """Time of the last change, in words."""


class WorldPart(PanelPart, frozen=True, kw_only=True):
    """The things of the scene, and the form of the selected one."""

    name: Literal["world"] = "world"
    title: str
    """Title of the scene."""
    bodies: list[SceneThing]
    """Bodies, floors and areas, the latest first."""
    form: ThingForm | None
    """Form of the selected thing; null if there is none."""
    settings: list[FormField]
    """Form of the scene itself."""
    field: list[FormField]
    """Form of the field that is generated at each start."""
    unsaved: UnsavedScene | None
    """A scene that can be restored; null if there is none."""
    problem: str
    """The reason why the scene is not kept while it is changed; empty if it is."""
    can_save: bool
    """True if scenes can be saved here; else they are downloaded."""
    is_autosaved: bool
    """True if the scene is kept while it is changed."""
    is_dragging: bool
    """True while somebody drags a thing."""
    is_move_mode: bool
    """True if this page moves things with the mouse."""
    snap: float
    """Grid (m) to which moved things snap; 0 for none."""
    undo: UndoLabel
    """The change that undo takes back."""
    redo: UndoLabel
    """The change that redo makes again."""
    waits_for_reset: bool
    """True if a change takes effect in the next episode."""
    max_scene_bytes: int = MAX_SCENE_BYTES
    """Size of a scene file at most."""
    max_picture_bytes: int = MAX_PICTURE_BYTES
    """Size of a picture for the ground at most."""


def world_part(editor: SceneEditor, view: PageView) -> WorldPart:
    """Return the things of the scene, and the form of the selected one."""
    state, recovery = editor.state, editor.recovery
    described = state.description
    agents = {str(agent.get("body")): str(agent.get("id", "0")) for agent in described.agents}
    unsaved, autosave = recovery.unsaved, recovery.autosave
    undo, redo = undo_labels(editor)
    return WorldPart(
        title=editor.title,
        bodies=[_thing(thing, agents, described) for thing in reversed(described.things)],
        form=_form(state, view.show.body, agents),
        settings=[form_field(setting) for setting in scene_form(described)],
        field=[form_field(each, FIRST_OF_FIELD, "generate") for each in field_form(described)],
        unsaved=None if unsaved is None else UnsavedScene(unsaved.name, unsaved.when),
        problem="" if autosave is None else autosave.problem,
        can_save=editor.scene_store is not None,
        is_autosaved=autosave is not None and not autosave.problem,
        is_dragging=editor.is_dragging,
        is_move_mode=view.is_move_mode,
        snap=view.snap_m,
        undo=undo,
        redo=redo,
        waits_for_reset=editor.waits_for_reset,
    )


def _thing(thing: Thing, agents: dict[str, str], described: SceneDescription) -> SceneThing:
    x, y = thing.position
    return SceneThing(
        name=thing.name,
        kind=_kind(thing, agents),
        agent=agents.get(thing.name),
        shape=thing.shape.type,
        x=x,
        y=y,
        heading=thing.heading_deg,
        movable=isinstance(thing, BodyDescription) and thing.kind == "dynamic",
        colour=thing.colour,
        label=thing.label,
        is_random=_is_random(thing, described),
    )


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
    """Return agent, lamp, body, floor, area or picture."""
    if isinstance(thing, BodyDescription):
        is_lamp = LAMP_TAG in thing.tags
        return "agent" if thing.name in agents else "lamp" if is_lamp else "body"
    if isinstance(thing, AreaDescription) and thing.picture is not None:
        return "picture"
    return kind_of(thing).removesuffix("s")


def _form(state: EditState, name: str | None, agents: dict[str, str]) -> ThingForm | None:
    """Return the form of the selected thing; None if there is no such thing any more."""
    thing = next((thing for thing in state.description.things if thing.name == name), None)
    if thing is None:
        return None
    fields = [form_field(parameter) for parameter in thing_form(thing)]
    return ThingForm(thing.name, _kind(thing, agents), fields)
