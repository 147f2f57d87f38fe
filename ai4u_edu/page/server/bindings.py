"""A brain with keys for an agent whose own listens to none, and the agent that a page asks for."""

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.driving_keys import keys_of
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
    WASDController,
    WASDRBMoveController,
)

WASD = {
    "up": ["KeyW", "ArrowUp"],
    "left": ["KeyA", "ArrowLeft"],
    "down": ["KeyS", "ArrowDown"],
    "right": ["KeyD", "ArrowRight"],
}
"""Default keys of a controller with discrete choices."""


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
