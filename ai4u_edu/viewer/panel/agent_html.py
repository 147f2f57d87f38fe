"""An agent as HTML for its tab; whatever a scene can name is escaped."""

from collections.abc import Collection, Mapping
from html import escape
from typing import NamedTuple

from ai4u_edu.snapshot import AgentState, Snapshot
from ai4u_edu.snapshot.theme import Rgb, body_colour
from ai4u_edu.viewer.panel.bars import number
from ai4u_edu.viewer.panel.decision import decision
from ai4u_edu.viewer.panel.needs import needs
from ai4u_edu.viewer.panel.readings import action, block, heading, reading
from ai4u_edu.viewer.panel.reward_table import Curves, curves, reward_table
from ai4u_edu.viewer.panel.senses import sense_html
from ai4u_edu.viewer.scene.labels import script_problem
from ai4u_edu.viewer.scene.sense_overlay import is_drawable

SIMPLE = {"DoneSensor", "TruncatedSensor", "IDSensor", "StepSensor"}
"""Sensors whose reading is one word or number that needs no explanation."""


class AgentHtml(NamedTuple):
    """The parts of an agent's tab, from top to bottom; each is sent only if it has changed."""

    everybody: str
    """All agents, if there are several."""
    state: str
    decision: str
    inside: str
    senses: dict[str, str]
    """By perception key."""
    also: str
    """What it knows of its own episode."""
    action: str
    ledger: str

    @classmethod
    def of(
        cls,
        agent: AgentState,
        snapshot: Snapshot,
        colours: Mapping[str, Rgb],
        lit: Collection[str] = (),
    ) -> "AgentHtml":
        """An agent as it is.

        Args:
            agent: which.
            snapshot: where it is in.
            colours: of the groups that it can see.
            lit: the keys of the sensors that are shown in the scene.
        """
        percept = agent.percept
        senses = {
            sense.key: sense_html(
                sense,
                percept[sense.key],
                colours,
                agent.rays.get(sense.key),
                lit=sense.key in lit,
                named=not is_drawable(sense, agent),
            )
            for sense in agent.sensor_infos
            if sense.block not in SIMPLE
        }
        return cls(
            everybody=overview(snapshot, agent.id) if len(snapshot.agents) > 1 else "",
            state=state(agent),
            decision=decision(agent, snapshot),
            inside=needs(agent.needs),
            senses=senses,
            also=_also(agent),
            action=action(agent.action, agent.actuator_infos),
            ledger=reward_table(agent),
        )


class AgentHtmlCache:
    """Writes each agent once for all pages that look at it, and not once for each page."""

    def __init__(self) -> None:
        self._snapshot: Snapshot | None = None
        self._written: dict[tuple[str, frozenset[str]], AgentHtml] = {}
        self._curves: dict[str, Curves] = {}

    def html(
        self,
        agent: AgentState,
        snapshot: Snapshot,
        colours: Mapping[str, Rgb],
        lit: Collection[str] = (),
    ) -> AgentHtml:
        """As :meth:`AgentHtml.of`."""
        if snapshot is not self._snapshot:
            self._snapshot, self._written, self._curves = snapshot, {}, {}
        key = agent.id, frozenset(lit)
        if key not in self._written:
            self._written[key] = AgentHtml.of(agent, snapshot, colours, lit)
        return self._written[key]

    def curves(self, agent: AgentState) -> Curves:
        """The agent's rewards, of the snapshot that was written last."""
        if agent.id not in self._curves:
            self._curves[agent.id] = curves(agent.history)
        return self._curves[agent.id]


def _also(agent: AgentState) -> str:
    """The simplest readings, in a line."""
    told = [
        f"<span><small>{escape(sense.key)}</small> {reading(agent.percept[sense.key])}</span>"
        for sense in agent.sensor_infos
        if sense.block in SIMPLE
    ]
    return block(*told) if told else ""


def title(agent_id: str, body: str) -> str:
    """What an agent is called.

    >>> title("0", "robot"), title("runner_1", "runner 1")
    ('Agent 0: robot', 'runner 1')
    """
    alike = agent_id.replace("_", " ") == body.replace("_", " ")
    return body if alike else f"Agent {agent_id}: {body}"


def state(agent: AgentState) -> str:
    """Who decides for an agent, and how far it is."""
    words = [heading(title(agent.id, agent.body)), f"<small>Brain</small> {escape(agent.brain)}"]
    end = ending(agent)
    if end:
        words.append(f"<br><b>{end}</b>")
    if script_problem(agent):
        words.append(f"<br><strong>{script_problem(agent)}</strong>")
    if agent.clipped:
        words.append(f"<br>{agent.clipped} numbers out of range, cut")
    return block(*words)


def ending(agent: AgentState) -> str:
    """How an agent's episode has ended, in a few words; empty while it goes on."""
    done = agent.terminated or agent.truncated
    if done and agent.succeeded:
        return "reached the goal"
    if agent.terminated:
        return "fell" if agent.fell else "episode over"
    if agent.truncated:
        return "cut off at the step limit"
    return "paused" if agent.paused else ""


def overview(snapshot: Snapshot, chosen: str) -> str:
    """A row for each of several agents: its step, its reward, and how it ended."""
    described = {body.name: body for body in snapshot.static_scene.bodies}
    alone = len({agent.episode for agent in snapshot.agents}) > 1
    head = ["", *(["episode"] if alone else []), "step", "reward", ""]
    rows = ["".join(f"<td><small>{each}</small></td>" for each in head)]
    for agent in snapshot.agents:
        colour = body_colour(described[agent.body], is_agent=True)
        name = escape(agent.body)
        cells = [
            *([str(agent.episode)] if alone else []),
            str(agent.steps),
            number(agent.episode_reward),
            f"<small>{ending(agent)}</small>",
        ]
        rows.append(
            f'<th><i style="background: rgb{colour}"></i>'
            f"{f'<b>{name}</b>' if agent.id == chosen else name}</th>"
            + "".join(f"<td>{cell}</td>" for cell in cells)
        )
    return block("<table>", *(f"<tr>{row}</tr>" for row in rows), "</table>")
