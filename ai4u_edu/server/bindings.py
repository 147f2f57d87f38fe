"""Which keys an agent listens to."""

import re
from collections.abc import Iterable
from typing import TypeGuard

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import Controller
from ai4u_edu.cycle import ControlRequestor

_CODE = re.compile(
    r"Key[A-Z]|Digit\d|Arrow(Up|Down|Left|Right)|F\d+|Space|Enter|Tab|Escape|Backspace"
    r"|(Shift|Control|Alt|Meta)(Left|Right)|Numpad\w+"
)


def keys_of(agent: BasicAgent) -> dict[str, list[str]]:
    """The keys of each thing that an agent can be told to do; empty if it listens to none.

    A controller that is driven by keys declares them as parameters, as WASDRBMoveController does:
    lists of codes. Several such lists may stand in one parameter.
    """
    controller = getattr(agent.brain, "controller", None)
    if not isinstance(controller, Controller):
        return {}
    found: dict[str, list[str]] = {}
    for parameter, value in controller.values().items():
        for name, keys in _lists(parameter, value):
            if _are_keys(keys):
                found.setdefault(name, []).extend(keys)
    return found


def choose(sim: ControlRequestor, agent_id: str | None) -> BasicAgent:
    """The agent that a page is about: the one it asks for, else the first that listens to keys.

    Raises:
        NameNotFoundError: there is no such agent.
    """
    if agent_id is not None:
        return sim.agent(agent_id)
    return next((agent for agent in sim.agents if keys_of(agent)), sim.agents[0])


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
