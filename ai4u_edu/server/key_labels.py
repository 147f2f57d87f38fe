"""What the keys on the screen are for: only those that do something, and what they do."""

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import (
    Actuator,
    ArrowController,
    Brain,
    DiscreteActuator,
    DiscreteArrowController,
    WASDRBMoveController,
)
from ai4u_edu.server.bindings import keys_of

MOTIONS = {
    (1, 0, 0): "forward",
    (-1, 0, 0): "back",
    (0, 1, 0): "right",
    (0, -1, 0): "left",
    (0, 0, 1): "jump",
    (1, 0, 1): "leap",
}
"""What a motion is called, by the signs of (forward, turn, jump of either kind)."""

JUMPS = ("jump", "jump_forward")
FEWEST = 4
"""An actuator of fewer numbers has none for a jump."""


CHOICES = ("right", "left", "up", "down", "accept")
"""What a DiscreteArrowController's choices are called, from 1 on."""


def useful_keys(agent: BasicAgent, brain: Brain | None = None) -> dict[str, list[str]]:
    """The keys of an agent, without those for what its body can't do.

    Args:
        agent: which.
        brain: that it would have; left out, the one that it has.
    """
    brain = brain or agent.brain
    idle = _idle(agent, brain)
    return {action: codes for action, codes in keys_of(agent, brain).items() if action not in idle}


def captions(agent: BasicAgent, brain: Brain | None = None) -> dict[str, str]:
    """What keys do in this scene, where it isn't what they are called."""
    brain = brain or agent.brain
    actuator = _actuator(agent, brain)
    controller = getattr(brain, "controller", None)
    if not isinstance(actuator, DiscreteActuator) or actuator.handler is not None:
        return {}
    if not isinstance(controller, DiscreteArrowController):
        return {}
    names = {}
    for action, row in zip(CHOICES, actuator.table[1:], strict=False):
        forward, turn, jump, leap = row
        name = MOTIONS.get((_sign(forward), _sign(turn), _sign(jump + leap)))
        if name is not None:
            names[action] = name
    return names


def _idle(agent: BasicAgent, brain: Brain) -> set[str]:
    """What an agent's controller knows and its body can't do."""
    controller, actuator = getattr(brain, "controller", None), _actuator(agent, brain)
    if isinstance(actuator, Actuator) and isinstance(controller, DiscreteArrowController):
        return set(CHOICES[int(actuator.limits()[1][0]) :])
    if actuator is None or not isinstance(controller, WASDRBMoveController | ArrowController):
        return set()
    numbers = len(actuator.limits()[0])
    parts = getattr(controller, "components", None) or (JUMPS if numbers >= FEWEST else ())
    jump = getattr(actuator, "jump_power", 1.0)
    leap = jump or getattr(actuator, "jump_forward_power", 1.0)
    can = {"jump": jump and "jump" in parts, "jump_forward": leap and "jump_forward" in parts}
    return {action for action in JUMPS if not can[action]}


def _actuator(agent: BasicAgent, brain: Brain) -> Actuator | None:
    """The actuator that a brain's controller drives."""
    controller = getattr(brain, "controller", None)
    return agent.bound_blocks.actuators.get(getattr(controller, "actuator_name", ""))


def _sign(number: float) -> int:
    return (number > 0) - (number < 0)
