"""The keys that an agent's controller listens to."""

import re
from collections.abc import Iterable
from typing import TypeGuard

from ai4u_edu.agent.agent import BasicAgent
from ai4u_edu.blocks import Brain, Controller, RemoteBrain

RESTART = "restart"
"""Action that begins an episode in place of driving."""

_CODE = re.compile(
    r"Key[A-Z]|Digit\d|Arrow(Up|Down|Left|Right)|F\d+|Space|Enter|Tab|Escape|Backspace"
    r"|(Shift|Control|Alt|Meta)(Left|Right)|Numpad\w+"
)


def keys_of(agent: BasicAgent, brain: Brain | None = None) -> dict[str, list[str]]:
    """Return the key codes of each action; empty if the brain listens to no keys.

    A controller declares its keys as parameters that are lists of codes, as WASDRBMoveController
    does. One parameter may hold several such lists.

    Args:
        agent: the agent to drive.
        brain: the brain to ask; default: the one that drives the agent now.
    """
    controller = getattr(brain or active_brain(agent.brain), "controller", None)
    if not isinstance(controller, Controller):
        return {}
    found: dict[str, list[str]] = {}
    for parameter, value in controller.values().items():
        for name, keys in _lists(parameter, value):
            if _are_keys(keys):
                found.setdefault(name, []).extend(keys)
    return found


def has_driving_keys(agent: BasicAgent) -> bool:
    """Return True if a person drives the agent; a key that only restarts does not count."""
    return any(action != RESTART for action in keys_of(agent))


def active_brain(brain: Brain) -> Brain:
    """Return the brain that decides: a person may override a script on another machine."""
    override = brain.override if isinstance(brain, RemoteBrain) else None
    return override or brain


def _lists(name: str, value: object) -> Iterable[tuple[str, object]]:
    if isinstance(value, dict):
        return value.items()
    if isinstance(value, list) and value and all(isinstance(each, list) for each in value):
        return [(f"{name} {number}", each) for number, each in enumerate(value, start=1)]
    return [(name, value)]


def _are_keys(value: object) -> TypeGuard[list[str]]:
    if not isinstance(value, list) or not value:
        return False
    return all(isinstance(code, str) and _CODE.fullmatch(code) for code in value)
