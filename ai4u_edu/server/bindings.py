"""Which keys a brain listens to, and which brain would."""

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
"""The keys with which one chooses where nobody said others."""


def keys_of(agent: BasicAgent, brain: Brain | None = None) -> dict[str, list[str]]:
    """The keys of each thing that an agent can be told to do; empty if it listens to none.

    A controller that is driven by keys declares them as parameters, as WASDRBMoveController does:
    lists of codes. Several such lists may stand in one parameter.

    Args:
        agent: which.
        brain: that it would have; left out, the one that it has.

    """
    controller = getattr(brain or acting(agent.brain), "controller", None)
    if not isinstance(controller, Controller):
        return {}
    found: dict[str, list[str]] = {}
    for parameter, value in controller.values().items():
        for name, keys in _lists(parameter, value):
            if _are_keys(keys):
                found.setdefault(name, []).extend(keys)
    return found


def acting(brain: Brain) -> Brain:
    """The brain that decides: in place of a script elsewhere it may be a person's."""
    hand = brain.override if isinstance(brain, RemoteBrain) else None
    return hand or brain


def takes_a_stick(brain: Brain) -> bool:
    """Whether a brain listens to a stick too, and not to keys alone."""
    controller = getattr(brain, "controller", None)
    return isinstance(controller, WASDRBMoveController | ArrowController)


def keyboard_brain(agent: BasicAgent) -> Brain | None:
    """With what a person could drive an agent that something else drives now.

    One of its brains that lies ready for that, or one that is made to fit its body, in the rhythm
    of the brain that it has. None if keys can't move it.
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
