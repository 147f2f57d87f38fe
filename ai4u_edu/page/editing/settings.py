"""Forms for, and changes of, the parameters of an agent, of a scene itself and of its field."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from pydantic import TypeAdapter, ValidationError

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import ParameterError, shown
from ai4u_edu.base.parameters import ParameterProblem, explain
from ai4u_edu.blocks import Block
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing import blocks
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.forms import NONE_LABEL, ParameterField, field_of
from ai4u_edu.page.editing.input_checks import check_typed, schema_of
from ai4u_edu.page.editing.plain import BlockPath, Plain
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.world import AreaDescription, CircleShape, WorldSettings
from ai4u_edu.world.fields import FieldBase, LineField, MazeField, RescueField

RUNTIME_PARAMETERS = (
    "max_steps_per_episode",
    "done_at_negative_reward",
    "done_at_positive_reward",
    "reward_scale",
)
"""Parameters of an agent, besides its blocks, that can change at run time."""
RHYTHM = ("skip_frame", "repeat_action")
"""Parameters that are shown with the agent, and belong to its brain."""
TEXTS = ("title", "goal")
"""Texts of a scene."""
START = ("wait_for_key",)
"""Parameters of a scene about how its episodes start."""
SCHEDULING = ("spread_decisions",)
"""Parameters of a scene about all its agents."""

FIELDS: dict[str, type[FieldBase]] = {
    "maze": MazeField,
    "line": LineField,
    "rescue": RescueField,
}
"""Kinds of generated fields, by the name that a scene file has for them."""
FIELD_TITLES = _("maze"), _("line"), _("rescue")
"""Their names as a page shows them."""
FIELD_WORDS = {
    "width": _("Cells from left to right"),
    "height": _("Cells from bottom to top"),
    "length": _("Cells through which the line goes"),
    "loops": _("Walls that are missing: more of them, more ways"),
    "curves": _("How often the line turns"),
    "crossings": _("Places where lines cross"),
    "gaps": _("Places where a piece of the line is missing"),
    "obstacles": _("Blocks on the line, to drive around"),
    "difficulty": _("How long and hard the way is"),
    "room_size": _("Cells along each side of the room"),
    "cell": _("Side of a cell"),
    "position": _("Middle of the field: x and y in metres"),
    "start": _("What begins where the field begins"),
    "goal": _("What has to be reached"),
    "marks": _("Areas that lie on the line, in this order"),
    "line_width": _("Width of the line"),
    "wall": _("Thickness of the walls"),
    "wall_height": _("Height of the walls and blocks"),
}
"""Plain sentences on the parameters of a generated field, in the order of the form."""


def agent_form(agent: Plain) -> list[ParameterField]:
    """Return the form of an agent: its parameters, and those of its enabled brain's rhythm."""
    brain = blocks.block_at(agent, brain_of(agent))
    schema = schema_of(BasicAgent)
    return [
        *_fields(schema_of(Block.types[str(brain["type"])]), RHYTHM, brain),
        *_fields(schema, RUNTIME_PARAMETERS, agent),
        *_applying_later(_fields(schema, ("priority",), agent)),
    ]


def problems_in_agent_form(problems: Iterable[ParameterProblem]) -> Iterator[ParameterProblem]:
    """Move problems of a brain's parameters to the agent's form, which shows them as its own."""
    for path, text in problems:
        yield ParameterProblem(path[-1:] if path[:1] == ("brains",) else path, text)


def scene_form(scene: SceneDescription) -> list[ParameterField]:
    """Return the form of a scene: its texts, its agents' scheduling, its world's settings."""
    schema, world = schema_of(SceneDescription), schema_of(WorldSettings)
    settings = scene.world.model_dump()
    return [
        *_fields(schema, TEXTS, {name: getattr(scene, name) for name in TEXTS}),
        *_fields(schema, START, {name: getattr(scene, name) for name in START}),
        *_applying_later(
            _fields(schema, SCHEDULING, {name: getattr(scene, name) for name in SCHEDULING})
        ),
        *_applying_later(_fields(world, tuple(WorldSettings.model_fields), settings)),
    ]


def field_form(scene: SceneDescription) -> list[ParameterField]:
    """Return the form of a scene's generated field: its kind, and the parameters of that kind."""
    field = scene.generate
    kind = ParameterField(
        "type",
        _("kind"),
        "choice",
        None if field is None else field.type,
        _(
            "A new field at each start: a maze, a line, or a rescue line with marks, obstacles "
            "and a room. Without one the world is as you built it"
        ),
        (NONE_LABEL, *FIELD_TITLES),
    )
    if field is None:
        return [kind]
    values = field.model_dump(mode="json")
    about = schema_of(FIELDS[field.type])["properties"]
    bodies = [body.name for body in scene.bodies]
    names = {"start": bodies, "goal": [*bodies, *(area.name for area in scene.areas)]}
    fields = [
        field_of(name, about[name], values[name], known=names.get(name))
        for name in FIELD_WORDS
        if name in values
    ]
    return [kind, *(replace(each, hint=_with_ends(each)) for each in fields)]


def with_field(scene: SceneDescription, values: Plain) -> SceneDescription:
    """Change a scene's generated field; None resets a parameter to its default.

    Another kind keeps the size and the place. A field needs something to reach: if the scene has
    nothing of the name, an area is added.

    Args:
        scene: the scene.
        values: by parameter; ``type`` is the kind, None for no field.

    Raises:
        ChangeError: some values are wrong, or together impossible.
    """
    before = {} if scene.generate is None else scene.generate.model_dump(exclude_unset=True)
    name = values.get("type", before.get("type"))
    if name is None:
        return scene.model_copy(update={"generate": None})
    if not isinstance(name, str) or name not in FIELDS:
        text = _("expected one of {names}, got {name}", names=", ".join(FIELDS), name=shown(name))
        raise ChangeError([ParameterProblem(("type",), text)])
    cls = FIELDS[name]
    is_other = name != before.get("type")
    if is_other:
        kept = ("width", "height", "position", "start", "goal")
        before = {key: before[key] for key in kept if key in before}
        before.setdefault("start", str(scene.agents[0]["body"]))
    chosen = {key: value for key, value in {**before, **values}.items() if value is not None}
    try:
        field: Any = cls(**chosen)
    except ParameterError as error:
        details = error.details
        if not isinstance(details, ValidationError):
            raise
        raise ChangeError(list(explain(details.errors(), cls))) from None
    if is_other:
        field = _with_room(field, scene)
    changes: dict[str, Any] = {"generate": field}
    if field.goal not in {thing.name for thing in scene.things}:
        goal = AreaDescription(
            name=field.goal, shape=CircleShape(radius=0.5), colour="orange", label=field.goal
        )
        changes["areas"] = (*scene.areas, goal)
    return scene.model_copy(update=changes)


def _with_room(field: Any, scene: SceneDescription) -> Any:
    """Return a field of which each cell has room for everything that can move."""
    room, reach = (
        field.room(),
        max((body.shape.reach for body in scene.bodies if body.kind != "static"), default=0.0),
    )
    if room is None or reach <= room:
        return field
    return field.model_copy(update={"cell": math.ceil(10 * (field.cell + 2 * (reach - room))) / 10})


def brain_of(agent: Plain) -> BlockPath:
    """Return the path of the enabled brain."""
    brains = agent["brains"]
    return "brains", next((i for i, each in enumerate(brains) if each.get("enabled", True)), 0)


def with_agent_settings(agent: Plain, values: Plain) -> Plain:
    """Change parameters of an agent, or of its brain's rhythm; None resets one to its default."""
    check_typed(values, schema_of(BasicAgent))
    rhythm = {name: values[name] for name in RHYTHM if name in values}
    if rhythm:
        agent = blocks.changed(agent, brain_of(agent), rhythm)
    agent = dict(agent) | {name: value for name, value in values.items() if name not in rhythm}
    return {name: value for name, value in agent.items() if value is not None}


def with_scene_settings(scene: SceneDescription, values: Plain) -> SceneDescription:
    """Change texts or scheduling of a scene, or settings of its world; None resets to the default.

    Raises:
        ChangeError: some values are wrong, or no parameter has such a name.
    """
    check_typed(values, schema_of(WorldSettings))
    own = {name: values[name] for name in _ADAPTERS if name in values}
    settings = scene.world.model_dump(exclude_defaults=True)
    settings |= {name: value for name, value in values.items() if name not in own}
    problems: list[ParameterProblem] = []
    fields: dict[str, Any] = {}
    for name, value in own.items():
        default = SceneDescription.model_fields[name].default
        try:
            fields[name] = _ADAPTERS[name].validate_python(default if value is None else value)
        except ValidationError as error:
            problems += [
                ParameterProblem((name,), each.text) for each in explain(error.errors(), ())
            ]
    try:
        fields["world"] = WorldSettings(
            **{name: value for name, value in settings.items() if value is not None}
        )
    except ParameterError as error:
        details = error.details
        if not isinstance(details, ValidationError):
            raise
        problems += explain(details.errors(), WorldSettings)
    if problems:
        raise ChangeError(problems)
    return scene.model_copy(update=fields)


def _with_ends(field: ParameterField) -> str:
    """Return what a number is, with its range; of a length without, whose limits nobody meets."""
    words = FIELD_WORDS[field.name]
    if field.low is None or field.high is None or field.unit == "m":
        return words
    low, high = f"{field.low:g}", f"{field.high:g}"
    return _("{what}, {low} to {high}", what=words, low=low, high=high)


def _fields(
    schema: Mapping[str, Any], names: tuple[str, ...], values: Plain
) -> list[ParameterField]:
    about = schema["properties"]
    return [
        field_of(name, about[name], values.get(name, about[name].get("default"))) for name in names
    ]


def _applying_later(fields: list[ParameterField]) -> list[ParameterField]:
    """Say with the hints that the fields apply at the next reset."""
    return [replace(each, note=_("It applies at the next reset.")) for each in fields]


_ADAPTERS: dict[str, TypeAdapter[Any]] = {
    name: TypeAdapter(SceneDescription.__annotations__[name])
    for name in (*TEXTS, *START, *SCHEDULING)
}
