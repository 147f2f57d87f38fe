"""Export of a running world as a scene description."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import text_of
from ai4u_edu.blocks import Block, Brain
from ai4u_edu.blocks.block import is_built_in
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.scenes.serialization import is_serializable, to_plain
from ai4u_edu.world import AreaDescription, BodyDescription, FloorDescription


def export_scene(sim: ControlRequestor, like: SceneDescription | None = None) -> SceneDescription:
    """Return a world and its agents as a scene description.

    Brains that can't be serialized, such as Python functions, are left out. So are brains of types
    that a student defined, if the agent has another one: a replay needs none of them.

    Args:
        sim: the world and its agents.
        like: a scene with the name, title and goal to use.

    Raises:
        RecordingError: a parameter of a block can't be serialized.
    """
    things = sim.world.described
    fields: dict[str, Any] = {
        "time_scale": sim.default_time_scale,
        "spread_decisions": sim.spread_decisions,
        "wait_for_key": sim.wait_for_key,
        "world": sim.world.settings,
        "floors": tuple(each for each in things if isinstance(each, FloorDescription)),
        "areas": tuple(each for each in things if isinstance(each, AreaDescription)),
        "bodies": tuple(each for each in things if isinstance(each, BodyDescription)),
        "generate": sim.world.field,
        "agents": tuple(_agent(agent) for agent in sim.agents),
    }
    if like is None:
        return SceneDescription(
            name="recorded", goal=sim.goal, success=sim.success or None, **fields
        )
    return like.model_copy(update=fields)


def without_brains(scene: SceneDescription) -> list[Any]:
    """Return the parts of a scene that determine a replay: everything but brains and texts."""
    agents = [{k: v for k, v in agent.items() if k != "brains"} for agent in scene.agents]
    things = [scene.floors, scene.areas, scene.bodies]
    return [scene.world, scene.spread_decisions, scene.generate, *things, agents]


def without_unknown_brains(scene: SceneDescription) -> SceneDescription:
    """Return a scene without brains of unknown types, so that it can be built.

    An agent with unknown brains only keeps them, so that building reports them.
    """
    agents = tuple(_with_known_brains(agent) for agent in scene.agents)
    return scene.model_copy(update={"agents": agents})


def _with_known_brains(agent: Mapping[str, Any]) -> Mapping[str, Any]:
    brains = agent.get("brains", ())
    known = [brain for brain in brains if _is_known(brain)]
    if not known or len(known) == len(brains):
        return agent
    if not any(brain.get("enabled", True) for brain in known):
        known[0] = {**known[0], "enabled": True}
    return {**agent, "brains": known}


def _is_known(block: Any) -> bool:
    """Return True if the types of a block and of the blocks in it are defined here."""
    if not isinstance(block, Mapping):
        return True
    parts = [block.get("controller")] if "controller" in block else []
    return block.get("type") in Block.types and all(map(_is_known, parts))


def _agent(agent: BasicAgent) -> dict[str, Any]:
    given = agent.given()
    brains = given.pop("brains", [])
    try:
        plain: dict[str, Any] = _plain_numbers(to_plain(given))
    except TypeError as error:
        raise RecordingError(
            _("agent {id!r}: {error}", id=agent.id, error=text_of(error))
        ) from None
    storable = [brain for brain in brains if _is_storable(brain)]
    built_in = [brain for brain in storable if all(is_built_in(type(b)) for b in _blocks(brain))]
    kept = [_plain_numbers(to_plain(brain)) for brain in built_in or storable]
    if kept:
        plain["brains"] = kept
        if sum(brain.get("enabled", True) for brain in kept) != 1:
            # the enabled brain was left out
            plain["brains"] = [brain | {"enabled": brain is kept[0]} for brain in kept]
    return plain


def _is_storable(brain: Brain) -> bool:
    try:
        _plain_numbers(to_plain(brain))
    except TypeError:
        return False
    return all(
        is_serializable(type(block)) and Block.types.get(type(block).__name__) is type(block)
        for block in _blocks(brain)
    )


def _blocks(block: Block) -> Iterator[Block]:
    yield block
    for value in block.values().values():
        if isinstance(value, Block):
            yield from _blocks(value)


def _plain_numbers(value: Any) -> Any:
    """Return plain data with Python's numbers in place of NumPy's."""
    if value is None or isinstance(value, bool | str):
        return value
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    for kind in (int, float):
        if isinstance(value, kind):
            return kind(value)
    if isinstance(value, Mapping):
        return {str(key): _plain_numbers(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain_numbers(each) for each in value]
    raise TypeError(_("expected a parameter that a file can hold, got {value}", value=repr(value)))
