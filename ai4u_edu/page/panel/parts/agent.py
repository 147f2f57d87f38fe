"""The parts "agent" and "curve": readings, action and rewards of an agent's last decision."""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from itertools import islice
from typing import Any

from ai4u_edu.agent.ledger import Entry
from ai4u_edu.agent.script_lines import script_lines
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import RemoteStatus
from ai4u_edu.page.panel.context import PanelContext
from ai4u_edu.page.panel.gallery import words_of
from ai4u_edu.page.panel.parts.colours import hex_colour
from ai4u_edu.page.panel.parts.sensor_slots import sensor_slots
from ai4u_edu.page.panel.parts.sensors import sensor_json
from ai4u_edu.snapshot import AgentState, Need, Snapshot
from ai4u_edu.snapshot.agent_words import ending, script_problem, title
from ai4u_edu.snapshot.block_info import ActuatorInfo
from ai4u_edu.snapshot.theme import body_colour, group_colours

MAX_PAID_DECISIONS = 6
"""Most decisions in the list of the latest rewards; those without a reward are left out."""
MAX_TICKS = 24
"""Most ticks of a decision that are told apart."""
MAX_VISIBLE_SPEED = 0.25
"""Largest time scale at which the current tick is told; faster, nobody could follow."""
DEFAULT_ADDRESS = "http://127.0.0.1:8080"
"""Address in the code of a script if the page's own address is unknown."""


def agent_part(
    context: PanelContext,
    snapshot: Snapshot,
    agent: AgentState,
    shown: Collection[str],
) -> dict[str, Any]:
    """Return an agent's readings, action and rewards.

    Args:
        context: the running world.
        snapshot: the latest snapshot.
        agent: the agent's state in it.
        shown: keys of the sensors that are drawn on the page.
    """
    colours = group_colours(snapshot.static_scene)
    editor = context.editor
    sensors = [
        sensor_json(sensor, agent.percept[sensor.key], colours, agent.rays.get(sensor.key))
        | {"is_drawable": agent.is_drawable(sensor), "is_shown": sensor.key in shown}
        for sensor in agent.sensor_infos
    ]
    _tell_apart(sensors)
    known = {control.name: control for control in agent.actuator_infos}
    return {
        "type": "part",
        "name": "agent",
        "id": agent.id,
        "title": title(agent.id, agent.body),
        "driver": _driver_name(context, agent) if editor is not None else "",
        "brain": agent.brain,
        "state": ending(agent),
        "problem": script_problem(agent),
        "script": None if agent.remote is None else _script(agent.remote),
        "clipped": agent.clipped,
        "sensors": sensors,
        "needs": [_need(each) for each in agent.needs],
        "action": [
            component
            for name, values in agent.action.items()
            for component in _action(name, values, known.get(name))
        ],
        "reward": agent.reward,
        "rewards": _rewards(agent.reward_terms, agent.episode_terms),
        "paid": [
            {"decision": entry.step, "terms": _paid(entry.terms), "total": entry.total}
            for entry in islice(_paid_entries(agent), MAX_PAID_DECISIONS)
        ],
        "phases": _phases(agent, snapshot),
        "others": _overview(snapshot) if len(snapshot.agents) > 1 else [],
    }


def _paid_entries(agent: AgentState) -> Iterator[Entry]:
    """Yield the decisions with a reward, the latest first."""
    return (entry for entry in reversed(agent.history) if any(entry.terms.values()))


def _tell_apart(sensors: list[dict[str, Any]]) -> None:
    """Add the perception key to titles that several sensors have."""
    counts = Counter(sensor["title"] for sensor in sensors)
    for sensor in sensors:
        if counts[sensor["title"]] > 1:
            sensor["title"] = f"{sensor['title']}: {sensor['key']}"


def curve_part(agent: AgentState) -> dict[str, Any]:
    """Return each decision's number, reward and sum so far, oldest first."""
    points = [[each.step, round(each.total, 6), round(each.so_far, 6)] for each in agent.history]
    return {"type": "part", "name": "curve", "agent": agent.id, "points": points}


def python_part(context: PanelContext, agent: AgentState, address: str) -> dict[str, Any]:
    """Return the code that drives an agent from a notebook, and what a program can name."""
    driven = next((each for each in context.runner.sim.agents if each.id == agent.id), None)
    return {
        "type": "part",
        "name": "python",
        "agent": agent.id,
        "lines": "" if driven is None else script_lines(address or DEFAULT_ADDRESS, driven),
        "actuators": [_actuator(each) for each in agent.actuator_infos if each.components],
        "sensors": [sensor_slots(each, agent.percept[each.key]) for each in agent.sensor_infos],
    }


def shown_sensors(agent: AgentState, choices: Mapping[tuple[str, str], bool]) -> frozenset[str]:
    """Return the keys of an agent's sensors that are drawn on a page.

    Args:
        agent: the agent's state.
        choices: the page's, by agent and key.
    """
    return frozenset(
        sensor.key
        for sensor in agent.sensor_infos
        if agent.is_drawable(sensor)
        and choices.get((agent.id, sensor.key), agent.has_marks(sensor))
    )


def _driver_name(context: PanelContext, agent: AgentState) -> str:
    try:
        return context.required_editor().driver_of(agent.id)
    except AI4UError:
        return ""  # the editor has another scene already


def _script(remote: RemoteStatus) -> dict[str, Any]:
    """Return the state of the script that drives an agent, with the counts that are not 0."""
    names = ("decisions", "missing", "ignored", "refused", "clipped", "warnings")
    return {
        "state": remote.state,
        "reason": remote.reason,
        "warning": remote.warning,
        "counts": {name: count for name in names if (count := getattr(remote, name))},
    }


def _need(need: Need) -> dict[str, Any]:
    low, high = need.comfort
    return {
        "name": need.name,
        "level": round(need.level, 3),
        "low": need.range[0],
        "high": need.range[1],
        "comfort": [low, high],
        "state": "low" if need.level < low else "high" if need.level > high else "",
    }


def _action(
    name: str, values: tuple[float, ...], control: ActuatorInfo | None
) -> list[dict[str, Any]]:
    if control is None or len(control.components) != len(values):
        return [{"actuator": name, "name": "", "value": value} for value in values]
    actuator = {"actuator": name, "title": words_of(control.block).title, "class": control.block}
    return [
        {
            **actuator,
            "name": each.name or (name if len(values) == 1 else str(index)),
            "value": round(value, 4),
            "low": each.low,
            "high": each.high,
            "is_choice": control.is_choice,
            "has_effect": each.name not in control.without_effect,
        }
        for index, (each, value) in enumerate(zip(control.components, values, strict=True))
    ]


def _actuator(control: ActuatorInfo) -> dict[str, Any]:
    components = [
        {
            "name": each.name,
            "low": each.low,
            "high": each.high,
            "has_effect": each.name not in control.without_effect,
        }
        for each in control.components
    ]
    return {"name": control.name, "is_choice": control.is_choice, "components": components}


def _rewards(now: Mapping[str, float], so_far: Mapping[str, float]) -> list[dict[str, Any]]:
    """Return each term's amount in the last finished decision and in the episode."""
    return [
        {"term": name, "decision": now.get(name, 0.0), "episode": so_far.get(name, 0.0)}
        for name in dict.fromkeys([*so_far, *now])
    ]


def _paid(terms: Mapping[str, float]) -> list[dict[str, Any]]:
    return [{"term": name, "amount": amount} for name, amount in terms.items() if amount]


def _phases(agent: AgentState, snapshot: Snapshot) -> dict[str, Any]:
    """Return where the agent is in its decision: sense, decide, act for some ticks, reward."""
    tick, ticks, repeats = agent.phase
    is_visible = snapshot.paused or snapshot.time_scale <= MAX_VISIBLE_SPEED
    is_over = tick >= ticks or not tick
    now = ("reward" if tick else "sense") if is_over else "act"
    return {
        "ticks": min(ticks, MAX_TICKS),
        "all_ticks": ticks,
        "tick": tick if is_visible else None,
        "now": now if is_visible else "",
        "repeats": repeats,
        "seconds": ticks / snapshot.static_scene.settings.ticks_per_second,
    }


def _overview(snapshot: Snapshot) -> list[dict[str, Any]]:
    """Return each agent's decisions, reward and the end of its episode."""
    bodies = {body.name: body for body in snapshot.static_scene.bodies}
    return [
        {
            "id": agent.id,
            "title": title(agent.id, agent.body),
            "colour": hex_colour(body_colour(bodies[agent.body], is_agent=True)),
            "episode": agent.episode,
            "decision": agent.steps,
            "score": agent.episode_reward,
            "state": ending(agent),
        }
        for agent in snapshot.agents
    ]
