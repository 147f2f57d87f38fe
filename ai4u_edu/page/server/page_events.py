"""The messages from the input socket to a page."""

from collections.abc import Mapping
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.page.server.api import finite
from ai4u_edu.page.server.bindings import has_stick
from ai4u_edu.page.server.control_lock import ControlLock
from ai4u_edu.page.server.human_override import HumanOverride
from ai4u_edu.page.server.key_labels import key_labels, usable_keys
from ai4u_edu.recording.snapshot import Snapshot
from ai4u_edu.recording.snapshot.outcome import outcome

Event = dict[str, Any]


def hello_event(agent: BasicAgent, number: int, override: HumanOverride) -> Event:
    """Return the page's number, its agent, and the keys that drive the agent.

    Args:
        agent: the page's agent.
        number: the page's number.
        override: the agent's.
    """
    brain = override.brain
    return {
        "type": "hello",
        "you": number,
        "agent": agent.id,
        "name": agent.body_name,
        "brain": agent.brain.title(),
        "keys": usable_keys(agent, brain),
        "captions": key_labels(agent, brain),
        "stick": has_stick(brain),
        "others": override.current_driver,
        "instead": override.next_driver,
    }


def lock_event(lock: ControlLock, seats: Mapping[int, int]) -> Event:
    """Return the number of the page that drives, and of all pages at this agent.

    Args:
        lock: of the agent.
        seats: numbers of the seats of a class by the numbers of their pages.
    """
    event: Event = {"type": "seat", "driver": lock.driver, "pages": lock.page_count}
    seat = 0 if lock.driver is None else seats.get(lock.driver, 0)
    return {**event, "seat": seat} if seat else event


def state_event(picture: Snapshot, agent_id: str, title: str = "") -> Event | None:
    """Return the state of the world and the agent; None if the world has no such agent."""
    agent = next((agent for agent in picture.agents if agent.id == agent_id), None)
    if agent is None:
        return None
    body = next(body for body in picture.bodies if body.name == agent.body)
    end = outcome(agent, picture.agents, picture.static_scene.success)
    return {
        "type": "state",
        "paused": picture.paused,
        "waiting": picture.waiting,
        "past": picture.past,
        "error": picture.error,
        "episode": picture.episode,
        "agent_episode": agent.episode,
        "seed_locked": picture.is_seed_locked,
        "terminated": agent.terminated,
        "truncated": agent.truncated,
        "fallen": body.fallen,
        "title": title,
        "goal": picture.static_scene.goal,
        "outcome": end,
        # not before the end, since this event is sent whenever it changes
        "seconds": round(picture.episode_time, 1) if end else None,
        "reward": finite(agent.episode_reward),
        "terms": {name: finite(value) for name, value in agent.episode_terms.items()},
        "held": sorted(agent.held_keys),
    }


def error_event(text: str) -> Event:
    """Return an error in words: of the page's message, or of the world."""
    return {"type": "error", "text": text}
