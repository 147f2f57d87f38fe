"""An agent as HTML for the panel; whatever a scene can name is escaped."""

from collections.abc import Mapping
from html import escape
from typing import NamedTuple

from ai4u_edu.look import Rgb, body_colour
from ai4u_edu.snapshot import AgentState, Snapshot
from ai4u_edu.viewer.needs import needs
from ai4u_edu.viewer.readings import action, block, heading, number, readings, rewards


class AgentHtml(NamedTuple):
    """The parts of an agent's panel, from top to bottom; each is sent only if it has changed."""

    state: str
    inside: str
    senses: str
    action: str
    reward: str

    @classmethod
    def of(cls, agent: AgentState, colours: Mapping[str, Rgb]) -> "AgentHtml":
        """An agent as it is; with the colours of the groups that it can see."""
        return cls(
            state(agent),
            needs(agent.needs),
            readings(agent.percept, agent.legends, colours),
            action(agent.action),
            rewards(agent.reward_terms, agent.episode_terms),
        )


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
    described = {body.name: body for body in snapshot.stage.bodies}
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
