"""An agent as HTML for its tab. Names from the scene are escaped."""

from collections.abc import Collection, Mapping
from html import escape
from typing import NamedTuple

from ai4u_edu.snapshot import AgentState, Snapshot
from ai4u_edu.snapshot.agent_words import ending, script_problem, title
from ai4u_edu.snapshot.numbers import number
from ai4u_edu.snapshot.theme import Rgb, body_colour
from ai4u_edu.viewer.panel.decision import decision
from ai4u_edu.viewer.panel.html_parts import heading, section
from ai4u_edu.viewer.panel.needs import needs
from ai4u_edu.viewer.panel.readings import action, reading
from ai4u_edu.viewer.panel.reward_table import Curves, curves, reward_table
from ai4u_edu.viewer.panel.sensor_html import sensor_html
from ai4u_edu.viewer.scene.sense_overlay import is_drawable

ONE_VALUE_SENSORS = {"DoneSensor", "TruncatedSensor", "IDSensor", "StepSensor"}
"""Sensors whose reading is one self-explanatory word or number; they share a line."""


class AgentHtml(NamedTuple):
    """The parts of an agent's tab, from top to bottom; each is sent only if it has changed."""

    overview: str
    """All agents, if there are several."""
    state: str
    decision: str
    needs: str
    sensors: dict[str, str]
    """Each sensor's reading, by perception key."""
    one_value_sensors: str
    action: str
    rewards: str

    @classmethod
    def of(
        cls,
        agent: AgentState,
        snapshot: Snapshot,
        colours: Mapping[str, Rgb],
        shown: Collection[str] = (),
    ) -> "AgentHtml":
        """Render an agent.

        Args:
            agent: the agent's state.
            snapshot: the snapshot that contains it.
            colours: colours by group.
            shown: keys of the sensors that are drawn in the scene.
        """
        percept = agent.percept
        sensors = {
            sensor.key: sensor_html(
                sensor,
                percept[sensor.key],
                colours,
                agent.rays.get(sensor.key),
                lit=sensor.key in shown,
                named=not is_drawable(sensor, agent),
            )
            for sensor in agent.sensor_infos
            if sensor.block not in ONE_VALUE_SENSORS
        }
        return cls(
            overview=overview(snapshot, agent.id) if len(snapshot.agents) > 1 else "",
            state=state(agent),
            decision=decision(agent, snapshot),
            needs=needs(agent.needs),
            sensors=sensors,
            one_value_sensors=_one_value_sensors(agent),
            action=action(agent.action, agent.actuator_infos),
            rewards=reward_table(agent),
        )


class AgentHtmlCache:
    """A cache of the current snapshot's HTML: pages that show the same agent share it."""

    def __init__(self) -> None:
        self._snapshot: Snapshot | None = None
        self._html: dict[tuple[str, frozenset[str]], AgentHtml] = {}
        self._curves: dict[str, Curves] = {}

    def html(
        self,
        agent: AgentState,
        snapshot: Snapshot,
        colours: Mapping[str, Rgb],
        shown: Collection[str] = (),
    ) -> AgentHtml:
        """Return :meth:`AgentHtml.of` for these arguments."""
        if snapshot is not self._snapshot:
            self._snapshot, self._html, self._curves = snapshot, {}, {}
        key = agent.id, frozenset(shown)
        if key not in self._html:
            self._html[key] = AgentHtml.of(agent, snapshot, colours, shown)
        return self._html[key]

    def curves(self, agent: AgentState) -> Curves:
        """Return the curves of the agent's rewards, in the snapshot that was rendered last."""
        if agent.id not in self._curves:
            self._curves[agent.id] = curves(agent.history)
        return self._curves[agent.id]


def _one_value_sensors(agent: AgentState) -> str:
    """Return a line with the readings of :data:`ONE_VALUE_SENSORS`."""
    readings = [
        f"<span><small>{escape(sensor.key)}</small> {reading(agent.percept[sensor.key])}</span>"
        for sensor in agent.sensor_infos
        if sensor.block in ONE_VALUE_SENSORS
    ]
    return section(*readings) if readings else ""


def state(agent: AgentState) -> str:
    """Return an agent's name, its brain, and the state of its episode."""
    words = [heading(title(agent.id, agent.body)), f"<small>Brain</small> {escape(agent.brain)}"]
    end = ending(agent)
    if end:
        words.append(f"<br><b>{end}</b>")
    if script_problem(agent):
        words.append(f"<br><strong>{script_problem(agent)}</strong>")
    if agent.clipped:
        words.append(f"<br>{agent.clipped} numbers out of range, cut")
    return section(*words)


def overview(snapshot: Snapshot, chosen: str) -> str:
    """Return a table with each agent's step, reward and the end of its episode."""
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
    return section("<table>", *(f"<tr>{row}</tr>" for row in rows), "</table>")
