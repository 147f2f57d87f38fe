"""The keys that a brain listens to, and a brain for an agent whose own listens to none."""

import re
from collections.abc import Iterable
from typing import TypeGuard

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    Actuator,
    ArrowController,
    Brain,
    CarActuator,
    CBMoveActuator,
    Controller,
    DifferentialDriveActuator,
    DiscreteActuator,
    DiscreteArrowController,
    ForceMoveActuator,
    GridMoveActuator,
    LocalBrain,
    RBMoveActuator,
    RemoteBrain,
    WASDController,
    WASDRBMoveController,
)

_CODE = re.compile(
    r"Key[A-Z]|Digit\d|Arrow(Up|Down|Left|Right)|F\d+|Space|Enter|Tab|Escape|Backspace"
    r"|(Shift|Control|Alt|Meta)(Left|Right)|Numpad\w+"
)


WASD = {
    "up": ["KeyW", "ArrowUp"],
    "left": ["KeyA", "ArrowLeft"],
    "down": ["KeyS", "ArrowDown"],
    "right": ["KeyD", "ArrowRight"],
}
"""Default keys of a controller with discrete choices."""


def keys_of(agent: BasicAgent, brain: Brain | None = None) -> dict[str, list[str]]:
    """Return the key codes of each action; empty if the brain listens to no keys.

    A controller declares its keys as parameters that are lists of codes, as WASDRBMoveController
    does. One parameter may hold several such lists.

    Args:
        agent: the agent to drive.
        brain: the brain to ask; left out, the one that drives the agent now.
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


def active_brain(brain: Brain) -> Brain:
    """Return the brain that decides: a person may override a script on another machine."""
    override = brain.override if isinstance(brain, RemoteBrain) else None
    return override or brain


def has_stick(brain: Brain) -> bool:
    """Return True if a brain listens to a stick as well as to keys."""
    controller = getattr(brain, "controller", None)
    return isinstance(controller, WASDRBMoveController | ArrowController)


def keyboard_brain(agent: BasicAgent) -> Brain | None:
    """Return a brain with which a person could drive an agent that something else drives now.

    It is another brain of the agent that listens to keys, or a new one for an actuator of its body,
    with the skip_frame of the present brain. None if keys can't move the agent.
    """
    now = agent.brain
    for brain in agent.brains:
        if brain is not now and keys_of(agent, brain):
            return brain
    for name, actuator in agent.bound_blocks.actuators.items():
        controller = _controller_for(name, actuator)
        if controller is not None:
            return LocalBrain(
                controller=controller, skip_frame=now.skip_frame, repeat_action=now.repeat_action
            )
    return None


def _controller_for(name: str, actuator: Actuator) -> Controller | None:
    match actuator:
        case RBMoveActuator():
            return WASDRBMoveController(actuator_name=name)
        case CBMoveActuator() | DifferentialDriveActuator():
            return WASDController(actuator_name=name)
        case CarActuator() | ForceMoveActuator():
            return WASDController(actuator_name=name, components=["forward", "turn"])
        case DiscreteActuator() | GridMoveActuator():
            return DiscreteArrowController(actuator_name=name, **WASD)
        case _:
            return None


def choose_agent(sim: ControlRequestor, agent_id: str | None) -> BasicAgent:
    """Return the agent that a page asks for; without a wish, the first that listens to keys.

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
