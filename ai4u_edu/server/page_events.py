"""What a page is told: who it is, who drives, how its agent is."""

from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.server.api import finite
from ai4u_edu.server.bindings import takes_a_stick
from ai4u_edu.server.control_lock import Seat
from ai4u_edu.server.human_override import Hands
from ai4u_edu.server.key_labels import captions, useful_keys
from ai4u_edu.snapshot import AgentState, Snapshot

Frame = dict[str, Any]


def hello(agent: BasicAgent, number: int, hands: Hands) -> Frame:
    """Which page it is, which agent it is about, and what that one listens to, or would."""
    brain = hands.brain
    return {
        "type": "hello",
        "you": number,
        "agent": agent.id,
        "name": agent.body_name,
        "brain": agent.brain.title(),
        "keys": useful_keys(agent, brain),
        "captions": captions(agent, brain),
        "stick": takes_a_stick(brain),
        "others": hands.others,
        "instead": hands.instead,
    }


def seating(seat: Seat) -> Frame:
    """Who drives."""
    return {"type": "seat", "driver": seat.driver, "pages": seat.pages}


def state(picture: Snapshot, agent_id: str, title: str = "") -> Frame | None:
    """How the world and the agent are, as far as the page speaks of it; None in another world."""
    agent = next((agent for agent in picture.agents if agent.id == agent_id), None)
    if agent is None:
        return None
    body = next(body for body in picture.bodies if body.name == agent.body)
    return {
        "type": "state",
        "paused": picture.paused,
        "past": picture.past,
        "error": picture.error,
        "episode": picture.episode,
        "terminated": agent.terminated,
        "truncated": agent.truncated,
        "fallen": body.fallen,
        "title": title,
        "goal": picture.static_scene.goal,
        "outcome": outcome(picture, agent),
        "reward": finite(agent.episode_reward),
        "terms": {name: finite(value) for name, value in agent.episode_terms.items()},
        "held": sorted(agent.held_keys),
    }


def outcome(picture: Snapshot, agent: AgentState) -> str:
    """How an agent's episode has ended, in a word that the page knows; empty while it goes on."""
    if not (agent.terminated or agent.truncated):
        return ""
    others = [other for other in picture.agents if other.id != agent.id]
    if agent.succeeded:
        return "won" if others else "goal"
    if agent.truncated:
        return "time"
    if others:
        beaten = agent.reward < 0 or any(other.succeeded for other in others)
        return "lost" if beaten else "over"
    if agent.fell:
        return "fell"
    # a scene that names no success has one all the same
    return "goal" if agent.episode_reward > 0 and not picture.static_scene.success else "over"


def error(text: str) -> Frame:
    """What it, or the world, could not do."""
    return {"type": "error", "text": text}
