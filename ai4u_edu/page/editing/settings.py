"""Forms for, and changes of, the parameters of an agent and of a scene themselves."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from pydantic import TypeAdapter, ValidationError

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import ParameterError
from ai4u_edu.base.parameters import ParameterProblem, explain
from ai4u_edu.blocks import Block
from ai4u_edu.page.editing import blocks
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.forms import ParameterField, field_of
from ai4u_edu.page.editing.input_checks import check_typed, schema_of
from ai4u_edu.page.editing.plain import BlockPath, Plain
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.world import WorldSettings

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


def agent_form(agent: Plain) -> list[ParameterField]:
    """Return the form of an agent: its parameters, and those of its enabled brain's rhythm."""
    brain = blocks.block_at(agent, brain_of(agent))
    schema = BasicAgent.json_schema()
    return [
        *_fields(Block.types[str(brain["type"])].json_schema(), RHYTHM, brain),
        *_fields(schema, RUNTIME_PARAMETERS, agent),
        *_applying_later(_fields(schema, ("priority",), agent)),
    ]


def problems_in_agent_form(problems: Iterable[ParameterProblem]) -> Iterator[ParameterProblem]:
    """Move problems of a brain's parameters to the agent's form, which shows them as its own."""
    for path, text in problems:
        yield ParameterProblem(path[-1:] if path[:1] == ("brains",) else path, text)


def scene_form(scene: SceneDescription) -> list[ParameterField]:
    """Return the form of a scene: its texts, its agents' scheduling, its world's settings."""
    schema = TypeAdapter(SceneDescription).json_schema()
    world = WorldSettings.model_json_schema()
    settings = scene.world.model_dump()
    return [
        *_fields(schema, TEXTS, {name: getattr(scene, name) for name in TEXTS}),
        *_fields(schema, START, {name: getattr(scene, name) for name in START}),
        *_applying_later(
            _fields(schema, SCHEDULING, {name: getattr(scene, name) for name in SCHEDULING})
        ),
        *_applying_later(_fields(world, tuple(WorldSettings.model_fields), settings)),
    ]


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
    check_typed(values, WorldSettings.model_json_schema())
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


def _fields(
    schema: Mapping[str, Any], names: tuple[str, ...], values: Plain
) -> list[ParameterField]:
    about = schema["properties"]
    return [
        field_of(name, about[name], values.get(name, about[name].get("default"))) for name in names
    ]


def _applying_later(fields: list[ParameterField]) -> list[ParameterField]:
    """Say in the hints that the fields apply at the next reset."""
    later = "applies at the next reset"
    return [replace(each, hint="; ".join(filter(None, (each.hint, later)))) for each in fields]


_ADAPTERS: dict[str, TypeAdapter[Any]] = {
    name: TypeAdapter(SceneDescription.__annotations__[name])
    for name in (*TEXTS, *START, *SCHEDULING)
}
