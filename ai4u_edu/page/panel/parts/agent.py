"""The parts "agent", "curve" and "python": an agent's readings, action, rewards and code."""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from itertools import islice
from keyword import iskeyword
from typing import Literal

from msgspec import UNSET, Struct, UnsetType, field

from ai4u_edu.agent import BasicAgent, LedgerEntry
from ai4u_edu.base.colors import hex_colour
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import RemoteStatus
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.panel.block_words import NUMBER_NAMES
from ai4u_edu.page.panel.context import PanelContext
from ai4u_edu.page.panel.gallery import words_of
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.page.panel.parts.sensors import (
    ProgramSensor,
    SensorReading,
    program_sensor,
    sensor_reading,
)
from ai4u_edu.snapshot import AgentState, Need, Snapshot
from ai4u_edu.snapshot.agent_words import ending, script_problem, title
from ai4u_edu.snapshot.block_info import ActuatorInfo
from ai4u_edu.snapshot.theme import Rgb, body_colour, group_colours

MAX_PAID_DECISIONS = 6
"""Most decisions in the list of the latest rewards; those without a reward are left out."""
MAX_TICKS = 24
"""Most ticks of a decision that are listed one by one."""
MAX_VISIBLE_SPEED = 0.25
"""Largest time scale at which the current tick is sent; faster, nobody could follow."""
DEFAULT_ADDRESS = "http://127.0.0.1:8080"
"""Address in the code of a script if the page's own address is unknown."""


class ScriptState(Struct, frozen=True):
    """The state of the script that drives an agent."""

    state: Literal["waiting", "connected", "late", "lost"]
    reason: str
    """The reason why it is not driving; empty if it is."""
    warning: str
    """A sentence about what had no effect lately; empty if all had."""
    counts: dict[str, int]
    """Counts that are not 0, by name: decisions, missing, ignored, refused, clipped, warnings."""


class NeedLevel(Struct, frozen=True):
    """The present level of a need, such as energy."""

    name: str
    level: float
    low: float
    """Lowest possible level."""
    high: float
    """Highest possible level."""
    comfort: tuple[float, float]
    """Bounds of the comfort zone."""
    state: Literal["low", "high", ""]
    """Side on which the level is out of the comfort zone; empty if it is in there."""


class ActionNumber(Struct, frozen=True, kw_only=True):
    """One number of an action.

    For an action that fits no actuator, only ``actuator``, ``name`` and ``value`` are there.
    """

    actuator: str
    """Name of the actuator."""
    title: str | UnsetType = UNSET
    """Title of the actuator."""
    type_name: str | UnsetType = field(name="class", default=UNSET)
    """Name of the actuator's class."""
    name: str
    value: float
    low: float | UnsetType = UNSET
    high: float | UnsetType = UNSET
    is_choice: bool | UnsetType = UNSET
    """True if the number is one of several discrete choices."""
    has_effect: bool | UnsetType = UNSET
    """False if it does nothing with the actuator's parameters, as a jump of power 0."""


class RewardRow(Struct, frozen=True):
    """A reward term."""

    term: str
    decision: float
    """Amount in the last finished decision."""
    episode: float
    """Sum in the episode so far."""


class PaidTerm(Struct, frozen=True):
    """The amount that one reward term paid in one decision."""

    term: str
    amount: float


class PaidDecision(Struct, frozen=True):
    """The rewards of one decision."""

    decision: int
    """Number of the decision in its episode, from 1."""
    terms: list[PaidTerm]
    """The terms that are not 0."""
    total: float


class DecisionPhases(Struct, frozen=True):
    """The progress of an agent's decision: sense, decide, act for some ticks, reward."""

    ticks: int
    """Ticks of the decision that are listed one by one."""
    all_ticks: int
    """Ticks of the decision."""
    tick: int | None
    """Ticks that have passed; null while the world runs too fast to see them."""
    now: Literal["sense", "act", "reward", ""]
    """The present phase; empty while the world runs too fast to see it."""
    repeats: bool
    """True if the actuators act at every tick, False if only at the first."""
    seconds: float
    """Duration of the decision (s)."""


class AgentSummary(Struct, frozen=True):
    """One of several agents."""

    id: str
    title: str
    colour: str
    """Colour of its body as CSS has it."""
    episode: int
    """Episodes that it has begun."""
    decision: int
    """Decisions in its episode so far."""
    score: float
    """Reward in its episode so far."""
    state: str
    """The end of its episode in a few words; empty while it runs."""


class AgentPart(PanelPart, frozen=True, kw_only=True):
    """An agent's readings, action and rewards."""

    name: Literal["agent"] = "agent"
    id: str
    title: str
    driver: str
    """Name of its driver, as in the command ``driver``; empty if it can't be changed."""
    brain: str
    """Title of its brain."""
    state: str
    """The end of its episode in a few words; empty while it runs."""
    problem: str
    """The problem with the script that should drive it; empty if there is none."""
    script: ScriptState | None
    """The script that drives it; null if none does."""
    clipped: int
    """Numbers of actions so far that were out of range and clipped."""
    sensors: list[SensorReading]
    needs: list[NeedLevel]
    action: list[ActionNumber]
    """The last action."""
    reward: float
    """Reward of the last finished decision."""
    rewards: list[RewardRow]
    paid: list[PaidDecision]
    """The latest decisions with a reward, the latest first."""
    phases: DecisionPhases
    others: list[AgentSummary]
    """All agents, if there are several."""


class CurvePart(PanelPart, frozen=True, kw_only=True):
    """The rewards of an agent's episode so far."""

    name: Literal["curve"] = "curve"
    agent: str
    """Id of the agent."""
    points: list[tuple[int, float, float]]
    """Number, reward and sum so far of each decision, oldest first."""


class ActionRange(Struct, frozen=True):
    """The range of one number of an action."""

    name: str
    """Its name; empty if it has none."""
    low: float
    high: float
    has_effect: bool
    """False if it does nothing with the actuator's parameters, as a jump of power 0."""


class ProgramActuator(Struct, frozen=True):
    """An actuator as a program names it."""

    name: str
    is_choice: bool
    """True if its number is one of several discrete choices."""
    components: list[ActionRange]


class PythonPart(PanelPart, frozen=True, kw_only=True):
    """The code that drives an agent from a notebook, and what a program can name."""

    name: Literal["python"] = "python"
    agent: str
    """Id of the agent."""
    lines: str
    """The code; empty if the agent has gone."""
    actuators: list[ProgramActuator]
    sensors: list[ProgramSensor]


def agent_part(
    context: PanelContext,
    snapshot: Snapshot,
    agent: AgentState,
    shown: Collection[str],
) -> AgentPart:
    """Return an agent's readings, action and rewards.

    Args:
        context: the running world.
        snapshot: the latest snapshot.
        agent: the agent's state in it.
        shown: keys of the sensors that are drawn on the page.
    """
    actuators = {actuator.name: actuator for actuator in agent.actuator_infos}
    return AgentPart(
        id=agent.id,
        title=title(agent.id, agent.body),
        driver=_driver_name(context, agent) if context.editor is not None else "",
        brain=agent.brain,
        state=ending(agent),
        problem=script_problem(agent),
        script=None if agent.remote is None else _script(agent.remote),
        clipped=agent.clipped,
        sensors=_readings(context, snapshot, agent, shown),
        needs=[_need(need) for need in agent.needs],
        action=[
            component
            for name, values in agent.action.items()
            for component in _action(name, values, actuators.get(name))
        ],
        reward=agent.reward,
        rewards=_rewards(agent.reward_terms, agent.episode_terms),
        paid=[
            PaidDecision(entry.step, _paid(entry.terms), entry.total)
            for entry in islice(_paid_entries(agent), MAX_PAID_DECISIONS)
        ],
        phases=_phases(agent, snapshot),
        others=context.cache.shared(snapshot, _overview) if len(snapshot.agents) > 1 else [],
    )


def _readings(
    context: PanelContext, snapshot: Snapshot, agent: AgentState, shown: Collection[str]
) -> list[SensorReading]:
    """Return the sensors' readings; titles that several sensors have end with the key."""
    colours = context.cache.shared(snapshot, _colours)
    titles = [words_of(sensor.block).title for sensor in agent.sensor_infos]
    counts = Counter(titles)
    return [
        sensor_reading(
            sensor,
            agent.percept[sensor.key],
            colours,
            agent.rays.get(sensor.key),
            title=title if counts[title] == 1 else _("{title}: {key}", title=title, key=sensor.key),
            is_drawable=agent.is_drawable(sensor),
            is_shown=sensor.key in shown,
        )
        for sensor, title in zip(agent.sensor_infos, titles, strict=True)
    ]


def _colours(snapshot: Snapshot) -> dict[str, Rgb]:
    return group_colours(snapshot.static_scene)


def _paid_entries(agent: AgentState) -> Iterator[LedgerEntry]:
    """Yield the decisions with a reward, the latest first."""
    return (entry for entry in reversed(agent.history) if any(entry.terms.values()))


def curve_part(agent: AgentState) -> CurvePart:
    """Return the rewards of an agent's episode so far."""
    points = [(each.step, round(each.total, 6), round(each.so_far, 6)) for each in agent.history]
    return CurvePart(agent=agent.id, points=points)


def python_part(context: PanelContext, agent: AgentState, address: str) -> PythonPart:
    """Return the code that drives an agent from a notebook, and what a program can name."""
    driven = next((each for each in context.runner.sim.agents if each.id == agent.id), None)
    return PythonPart(
        agent=agent.id,
        lines="" if driven is None else script_lines(address or DEFAULT_ADDRESS, driven),
        actuators=[_actuator(info) for info in agent.actuator_infos if info.components],
        sensors=[program_sensor(info, agent.percept[info.key]) for info in agent.sensor_infos],
    )


def script_lines(address: str, agent: BasicAgent) -> str:
    """Return the code of a script that drives an agent.

    Names are inserted by ``repr``, so a hostile name can't inject code.

    Args:
        address: the world's address, as of its page.
        agent: the agent.
    """
    example = {
        name: [1] + [0] * (len(actuator.limits()[0]) - 1)
        for name, actuator in agent.bound_blocks.actuators.items()
        if actuator.is_output
    }
    if all(name.isidentifier() and not iskeyword(name) for name in example):
        numbers = ", ".join(f"{name}={values}" for name, values in example.items())
    else:
        numbers = repr(example)
    return (
        "from ai4u_edu.remote import connect\n\n"
        f"robot = connect({address!r}, agent={agent.id!r})\n"
        "robot.reset()\n"
        "for percept in robot:\n"
        f"    robot.act({numbers})\n"
        "robot.close()\n"
    )


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


def _script(remote: RemoteStatus) -> ScriptState:
    names = ("decisions", "missing", "ignored", "refused", "clipped", "warnings")
    counts = {name: count for name in names if (count := getattr(remote, name))}
    return ScriptState(remote.state, remote.reason, remote.warning, counts)


def _need(need: Need) -> NeedLevel:
    low, high = need.comfort
    return NeedLevel(
        name=need.name,
        level=round(need.level, 3),
        low=need.range[0],
        high=need.range[1],
        comfort=(low, high),
        state="low" if need.level < low else "high" if need.level > high else "",
    )


def _action(
    name: str, values: tuple[float, ...], actuator: ActuatorInfo | None
) -> list[ActionNumber]:
    if actuator is None or len(actuator.components) != len(values):
        return [ActionNumber(actuator=name, name="", value=value) for value in values]
    return [
        ActionNumber(
            actuator=name,
            title=words_of(actuator.block).title,
            type_name=actuator.block,
            name=NUMBER_NAMES.get(component.name, component.name)
            or (name if len(values) == 1 else str(index)),
            value=round(value, 4),
            low=component.low,
            high=component.high,
            is_choice=actuator.is_choice,
            has_effect=component.name not in actuator.without_effect,
        )
        for index, (component, value) in enumerate(zip(actuator.components, values, strict=True))
    ]


def _actuator(actuator: ActuatorInfo) -> ProgramActuator:
    components = [
        ActionRange(name, low, high, has_effect=name not in actuator.without_effect)
        for name, low, high in actuator.components
    ]
    return ProgramActuator(actuator.name, actuator.is_choice, components)


def _rewards(now: Mapping[str, float], so_far: Mapping[str, float]) -> list[RewardRow]:
    return [
        RewardRow(name, now.get(name, 0.0), so_far.get(name, 0.0))
        for name in dict.fromkeys([*so_far, *now])
    ]


def _paid(terms: Mapping[str, float]) -> list[PaidTerm]:
    return [PaidTerm(name, amount) for name, amount in terms.items() if amount]


def _phases(agent: AgentState, snapshot: Snapshot) -> DecisionPhases:
    tick, ticks, repeats = agent.phase
    is_visible = snapshot.paused or snapshot.time_scale <= MAX_VISIBLE_SPEED
    is_over = tick >= ticks or not tick
    return DecisionPhases(
        ticks=min(ticks, MAX_TICKS),
        all_ticks=ticks,
        tick=tick if is_visible else None,
        now="" if not is_visible else "act" if not is_over else "reward" if tick else "sense",
        repeats=repeats,
        seconds=ticks / snapshot.static_scene.settings.ticks_per_second,
    )


def _overview(snapshot: Snapshot) -> list[AgentSummary]:
    bodies = {body.name: body for body in snapshot.static_scene.bodies}
    return [
        AgentSummary(
            id=agent.id,
            title=title(agent.id, agent.body),
            colour=hex_colour(body_colour(bodies[agent.body], is_agent=True)),
            episode=agent.episode,
            decision=agent.steps,
            score=agent.episode_reward,
            state=ending(agent),
        )
        for agent in snapshot.agents
    ]
