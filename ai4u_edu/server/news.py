"""What a page is told: who it is, who drives, how its agent is."""

from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.server.api import finite
from ai4u_edu.server.bindings import keys_of
from ai4u_edu.server.seat import Seat
from ai4u_edu.snapshot import Snapshot

Frame = dict[str, Any]


def hello(agent: BasicAgent, number: int) -> Frame:
    """Which page it is, which agent it is about, and what that one listens to."""
    return {
        "type": "hello",
        "you": number,
        "agent": agent.id,
        "brain": agent.brain.title(),
        "keys": keys_of(agent),
    }


def seating(seat: Seat) -> Frame:
    """Who drives."""
    return {"type": "seat", "driver": seat.driver, "pages": seat.pages}


def state(picture: Snapshot, agent_id: str) -> Frame:
    """How the world and the agent are, as far as the page speaks of it."""
    agent = next(agent for agent in picture.agents if agent.id == agent_id)
    body = next(body for body in picture.bodies if body.name == agent.body)
    return {
        "type": "state",
        "paused": picture.paused,
        "error": picture.error,
        "episode": picture.episode,
        "terminated": agent.terminated,
        "truncated": agent.truncated,
        "fallen": body.fallen,
        "reward": finite(agent.episode_reward),
        "terms": {name: finite(value) for name, value in agent.episode_terms.items()},
        "held": sorted(agent.held_keys),
    }


def error(text: str) -> Frame:
    """What it, or the world, could not do."""
    return {"type": "error", "text": text}
