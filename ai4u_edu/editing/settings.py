"""What an agent and a scene have of their own, besides blocks and things: forms, and changes."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from pydantic import TypeAdapter, ValidationError

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import ParameterError
from ai4u_edu.base.parameters import Problem, explain
from ai4u_edu.blocks import Block
from ai4u_edu.editing import blocks
from ai4u_edu.editing.blocks import BlockPath, Plain
from ai4u_edu.editing.difference import OWN
from ai4u_edu.editing.errors import ChangeError
from ai4u_edu.editing.forms import Field, field_of
from ai4u_edu.editing.typed import check_typed, schema_of
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.world import WorldSettings

RHYTHM = ("skip_frame", "repeat_action")
"""What a person takes for the agent's own; its brain has them."""
WORDS = ("title", "goal")
"""What a scene says of itself."""
TURNS = ("spread_decisions",)
"""What it says of its agents together."""


def agent_form(agent: Plain) -> list[Field]:
    """The parameters of an agent and the rhythm of its brain, as they are now."""
    brain = blocks.block_at(agent, brain_of(agent))
    schema = BasicAgent.json_schema()
    return [
        *_fields(Block.types[str(brain["type"])].json_schema(), RHYTHM, brain),
        *_fields(schema, OWN, agent),
        *_later(_fields(schema, ("priority",), agent)),
    ]


def scene_form(scene: SceneDescription) -> list[Field]:
    """A scene's words, and what holds for all agents and for its world, as it is now."""
    schema = TypeAdapter(SceneDescription).json_schema()
    world = WorldSettings.model_json_schema()
    settings = scene.world.model_dump()
    return [
        *_fields(schema, WORDS, {name: getattr(scene, name) for name in WORDS}),
        *_later(_fields(schema, TURNS, {name: getattr(scene, name) for name in TURNS})),
        *_later(_fields(world, tuple(WorldSettings.model_fields), settings)),
    ]


def brain_of(agent: Plain) -> BlockPath:
    """The path of the brain that is on."""
    brains = agent["brains"]
    return "brains", next((i for i, each in enumerate(brains) if each.get("enabled", True)), 0)


def with_agent_settings(agent: Plain, values: Plain) -> Plain:
    """With other parameters of an agent, or of its brain's rhythm; None for one as by default."""
    check_typed(values, schema_of(BasicAgent))
    rhythm = {name: values[name] for name in RHYTHM if name in values}
    if rhythm:
        agent = blocks.changed(agent, brain_of(agent), rhythm)
    agent = dict(agent) | {name: value for name, value in values.items() if name not in rhythm}
    return {name: value for name, value in agent.items() if value is not None}


def with_scene_settings(scene: SceneDescription, values: Plain) -> SceneDescription:
    """With other words or turns of a scene, or settings of its world; None for one as by default.

    Raises:
        ChangeError: some are wrong, or nothing of the scene is called so.
    """
    check_typed(values, WorldSettings.model_json_schema())
    own = {name: values[name] for name in _OWN if name in values}
    settings = scene.world.model_dump(exclude_defaults=True)
    settings |= {name: value for name, value in values.items() if name not in own}
    problems: list[Problem] = []
    fields: dict[str, Any] = {}
    for name, value in own.items():
        default = SceneDescription.model_fields[name].default
        try:
            fields[name] = _OWN[name].validate_python(default if value is None else value)
        except ValidationError as error:
            problems += [Problem((name,), each.text) for each in explain(error.errors(), ())]
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


def _fields(schema: Mapping[str, Any], names: tuple[str, ...], values: Plain) -> list[Field]:
    about = schema["properties"]
    return [
        field_of(name, about[name], values.get(name, about[name].get("default"))) for name in names
    ]


def _later(fields: list[Field]) -> list[Field]:
    """With a word on when they apply."""
    return [replace(each, hint=f"{each.hint}; applies at the next reset") for each in fields]


_OWN: dict[str, TypeAdapter[Any]] = {
    name: TypeAdapter(SceneDescription.__annotations__[name]) for name in (*WORDS, *TURNS)
}
