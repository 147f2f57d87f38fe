"""Wanted states, worked out from the present one; nothing here touches the running world."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any, NamedTuple

from ai4u_edu.base.parameters import ParameterProblem, default_of
from ai4u_edu.blocks import Block
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext
from ai4u_edu.page.editing import blocks, settings, things
from ai4u_edu.page.editing.driver_options import with_driver
from ai4u_edu.page.editing.drivers import DriverRegistry
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.input_checks import check_name, check_plain
from ai4u_edu.page.editing.plain import BlockPath, Plain
from ai4u_edu.page.editing.state import EditState, reward_names
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.yaml.file import write_yaml
from ai4u_edu.world import Pose

Poses = Mapping[str, Pose]


class Proposal(NamedTuple):
    """A wanted state, and the notes to show with it."""

    state: EditState
    label: str
    """A few words for the undo button."""
    path: BlockPath = ()
    """The changed part of the scene; paths of problems are relative to it."""
    poses: Poses = MappingProxyType({})
    """Poses to which bodies are moved, by name."""
    restarts: bool = False
    """True if the world must be rebuilt at once, which begins another episode."""
    merge_key: str = ""
    """Changes with the same key that follow each other within a second are undone as one."""


Goal = tuple[float, float, float | None]
"""Place (m) and heading (degrees) of a thing; None for its present heading."""


class NewThing(NamedTuple):
    """A thing to add."""

    description: Mapping[str, Any]
    kind: things.ThingKind
    like: str = ""
    """Id of the agent whose blocks are copied, for the body of a new agent; else empty."""


def change_block(
    state: EditState,
    agent_id: str,
    path: BlockPath,
    label: Callable[[str], str],
    change: Callable[[Plain], Plain],
) -> Proposal:
    """Propose another agent, in which one block was changed.

    Args:
        state: the present state.
        agent_id: the agent that has the block.
        path: of the block in its agent.
        label: returns a few words for the undo button, of the block's type.
        change: changes the agent.
    """
    agent = state.agent(agent_id)
    words = label(str(blocks.block_at(agent, path)["type"]))
    return Proposal(state.with_agent(agent_id, change(agent)), words, _path(state, agent_id, path))


def add_block(
    state: EditState, agent_id: str, kind: str | BlockPath, block: Plain, index: int | None
) -> Proposal:
    """Propose another block of an agent; a brain that is added is also enabled."""
    parent = (kind,) if isinstance(kind, str) else kind
    agent, path = blocks.added(state.agent(agent_id), parent, block, index)
    if parent == ("brains",) and len(agent["brains"]) > 1 and block.get("enabled", True):
        agent = blocks.with_enabled(agent, path, True)
    state = state.with_agent(agent_id, agent)
    label = _("add {block}", block=str(block["type"]))
    return Proposal(state, label, _path(state, agent_id, path))


def change_agent(state: EditState, agent_id: str, values: Plain) -> Proposal:
    """Propose other parameters of an agent."""
    agent = settings.with_agent_settings(state.agent(agent_id), values)
    path = _path(state, agent_id, ())
    label = _("change agent {agent}", agent=agent_id)
    return Proposal(state.with_agent(agent_id, agent), label, path)


def scale_rewards(state: EditState, agent_id: str, factors: Mapping[str, float]) -> Proposal:
    """Propose other amounts of an agent's reward functions.

    Raises:
        ChangeError: a reward function has no such name, or no amounts.
    """
    agent = state.agent(agent_id)
    names = reward_names(agent)
    for name, factor in factors.items():
        if name not in names:
            raise ChangeError([ParameterProblem((), _("there is no reward {name!r}", name=name))])
        path: BlockPath = ("rewards", names.index(name))
        block = blocks.block_at(agent, path)
        amounts = _amounts(block)
        if not amounts:
            text = _("{name} has no amount here; change it in its own code", name=name)
            raise ChangeError([ParameterProblem((), text)])
        if factor == 0.0 and block.get("cause_episode_to_end"):
            text = _(
                "{name} also ends the episode, which it does not if it pays 0; choose a factor "
                "such as 0.01",
                name=name,
            )
            raise ChangeError([ParameterProblem((), text)])
        values = {each: float(f"{factor * amount:.12g}") for each, amount in amounts.items()}
        agent = blocks.changed(agent, path, values)
    path = _path(state, agent_id, ())
    return Proposal(state.with_agent(agent_id, agent), _("change the rewards"), path)


def set_driver(state: EditState, agent_id: str, name: str, drivers: DriverRegistry) -> Proposal:
    """Propose another driver of an agent."""
    check_name(name, _("the name of a driver"))
    driven = with_driver(state, agent_id, name, drivers)
    path = _path(driven, agent_id, ("brains",))
    label = _("{agent}: driven by {driver}", agent=agent_id, driver=name)
    return Proposal(driven, label, path)


def move_body(
    state: EditState,
    name: str,
    x: float,
    y: float,
    heading_deg: float | None,
    pose_of: Callable[[str], Pose],
) -> Proposal:
    """Propose another pose of a thing; without a heading it keeps its present one."""
    things.check_place(x, y, heading_deg)
    thing, path = things.thing_named(state, name), state.description.where_is(name)
    label = _("move {name}", name=name)
    if things.kind_of(thing) != "bodies":
        degrees = thing.heading_deg if heading_deg is None else heading_deg
        return Proposal(things.with_pose(state, name, x, y, degrees), label, path)
    degrees = math.degrees(pose_of(name)[2]) if heading_deg is None else heading_deg
    moved = things.with_pose(state, name, x, y, degrees)
    pose = (x, y, math.radians(degrees))
    return Proposal(moved, label, path, {name: pose})


def move_things(
    state: EditState, goals: Mapping[str, Goal], pose_of: Callable[[str], Pose]
) -> Proposal:
    """Propose other poses of several things, by name."""
    proposal = Proposal(state, "")
    poses: dict[str, Pose] = {}
    for name, goal in goals.items():
        proposal = move_body(proposal.state, name, *goal, pose_of)
        poses |= proposal.poses
    if len(goals) == 1:
        return proposal
    label = ngettext("move {n} thing", "move {n} things", len(goals))
    return Proposal(proposal.state, label, poses=poses)


def add_things(state: EditState, new_things: Sequence[NewThing]) -> Proposal:
    """Propose several things more; another episode begins if agents are among them."""
    proposal, restarts = Proposal(state, ""), False
    for new in new_things:
        if new.like:
            proposal = add_agent(proposal.state, new.description, new.like)
        else:
            proposal = add_thing(proposal.state, new.description, new.kind)
        restarts = restarts or proposal.restarts
    if len(new_things) == 1:
        return proposal
    label = ngettext("add {n} thing", "add {n} things", len(new_things))
    return Proposal(proposal.state, label, restarts=restarts)


def remove_things(state: EditState, names: Sequence[str]) -> Proposal:
    """Propose the scene without some things; the body of an agent goes with its agent."""
    proposal, restarts = Proposal(state, ""), False
    for name in names:
        agent = proposal.state.agent_with(name)
        if agent is None:
            proposal = remove_thing(proposal.state, name)
        else:
            proposal = remove_agent(proposal.state, agent)
        restarts = restarts or proposal.restarts
    if len(names) == 1:
        return proposal
    label = ngettext("remove {n} thing", "remove {n} things", len(names))
    return Proposal(proposal.state, label, restarts=restarts)


def add_thing(
    state: EditState, given: things.Thing | Mapping[str, Any], kind: things.ThingKind
) -> Proposal:
    """Propose another body, floor or area."""
    thing = things.checked_description(given, kind)
    path = (kind, len(getattr(state.description, kind)))
    return Proposal(things.with_thing(state, thing), _("add {name}", name=thing.name), path)


def remove_thing(state: EditState, name: str) -> Proposal:
    """Propose the scene without a body, a floor or an area."""
    return Proposal(things.without_thing(state, name), _("remove {name}", name=name))


def change_thing(state: EditState, name: str, values: Mapping[str, Any]) -> Proposal:
    """Propose other parameters of a body, a floor or an area."""
    path = state.description.where_is(name)
    label = _("change {name}", name=name)
    if set(values) == {"shape"}:
        label = _("resize {name}", name=name)
    return Proposal(things.with_changed_thing(state, name, values), label, path)


def resize_thing(
    state: EditState,
    name: str,
    shape: Mapping[str, Any],
    place: tuple[float, float] | None,
    pose_of: Callable[[str], Pose],
) -> Proposal:
    """Propose another shape of a thing, whose centre moves to a place unless that is None."""
    resized = change_thing(state, name, {"shape": shape})
    if place is None:
        return resized
    moved = move_body(resized.state, name, *place, None, pose_of)
    return moved._replace(label=resized.label)


def add_agent(state: EditState, body: Mapping[str, Any], like: str) -> Proposal:
    """Propose another agent with a new body and copies of another agent's blocks."""
    added = things.with_thing(state, things.checked_description(body))
    agent = _copy_of(state.agent(like), state, str(body["name"]))
    proposed = added.describing(agents=(*state.description.agents, agent))
    return Proposal(proposed, _("add {name}", name=str(body["name"])), restarts=True)


def remove_agent(state: EditState, agent_id: str) -> Proposal:
    """Propose the scene without an agent and its body."""
    name = str(state.agent(agent_id)["body"])
    label = _("remove {name}", name=name)
    return Proposal(_without_agent(state, agent_id), label, restarts=True)


def change_scene(state: EditState, values: Mapping[str, Any]) -> Proposal:
    """Propose other top-level entries of the scene file."""
    check_plain(values)
    plain = {**state.scene.plain(), **values}
    scene = Scene.loads(write_yaml(plain), folder=state.folder)
    return Proposal(replace(state, description=scene.description), _("change the scene"))


def change_settings(state: EditState, values: Plain) -> Proposal:
    """Propose another title or goal of the scene, or other settings of its world."""
    description = settings.with_scene_settings(state.description, values)
    return Proposal(replace(state, description=description), _("change the scene"))


def change_field(state: EditState, values: Plain) -> Proposal:
    """Propose another generated field, which is there at once, in a new episode."""
    description = settings.with_field(state.description, values)
    return Proposal(replace(state, description=description), _("change the field"), restarts=True)


def _amounts(reward: Plain) -> dict[str, float]:
    """Return what a reward function pays, by the names of its parameters."""
    cls = Block.types[str(reward["type"])]
    values = {
        name: reward.get(name, default_of(field))
        for name, field in cls.parameters().items()
        if name == "reward" or name.endswith("_reward")
    }
    return {name: value for name, value in values.items() if isinstance(value, int | float)}


def _path(state: EditState, agent_id: str, path: BlockPath) -> BlockPath:
    return ("agents", state.agent_index(agent_id), *path)


def _copy_of(agent: Plain, state: EditState, body: str) -> Plain:
    """Return a copy of an agent with an unused id, for another body."""
    taken = {str(other.get("id", "0")) for other in state.description.agents}
    agent_id = next(str(n) for n in range(len(taken) + 1) if str(n) not in taken)
    copy: dict[str, Any] = {**agent, "id": agent_id, "body": body}
    if "actuators" in copy:  # a copied RespawnActuator would put it where the other agent begins
        copy["actuators"] = [
            actuator for actuator in copy["actuators"] if actuator["type"] != "RespawnActuator"
        ]
    return copy


def _without_agent(state: EditState, agent_id: str) -> EditState:
    """Remove an agent and its body.

    Raises:
        ChangeError: it is the last one.
    """
    index = state.agent_index(agent_id)
    agents = state.description.agents
    others = (*agents[:index], *agents[index + 1 :])
    if not others:
        raise ChangeError([ParameterProblem((), _("it is the only agent; a scene needs one"))])
    without = state.driven(agent_id, "").describing(agents=others)
    return things.without_thing(without, str(agents[index]["body"]))
