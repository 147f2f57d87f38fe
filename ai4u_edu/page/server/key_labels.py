"""Labels of the keys on the screen, and the keys that have an effect at all."""

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.driving_keys import keys_of
from ai4u_edu.blocks import (
    Actuator,
    ArrowController,
    Brain,
    DiscreteActuator,
    DiscreteArrowController,
    WASDRBMoveController,
)

MOTIONS = {
    (1, 0, 0): "forward",
    (-1, 0, 0): "back",
    (0, 1, 0): "right",
    (0, -1, 0): "left",
    (0, 0, 1): "jump",
    (1, 0, 1): "jump forward",
}
"""Label of a motion, by the signs of (forward, turn, jump of either kind)."""

JUMPS = ("jump", "jump_forward")
MIN_JUMP_NUMBERS = 4
"""Size of an actuator's smallest action that includes jumps."""

CHOICES = ("right", "left", "up", "down", "accept")
"""Names of a DiscreteArrowController's choices, from 1 on."""


def usable_keys(agent: BasicAgent, brain: Brain | None = None) -> dict[str, list[str]]:
    """Return an agent's keys without those for actions that its body can't do.

    Args:
        agent: the agent to drive.
        brain: the brain to ask; left out, the agent's own.
    """
    brain = brain or agent.brain
    useless = _useless_actions(agent, brain)
    keys = keys_of(agent, brain)
    return {action: codes for action, codes in keys.items() if action not in useless}


def key_labels(agent: BasicAgent, brain: Brain | None = None) -> dict[str, str]:
    """Return the labels of actions that do something else in this scene than their name says."""
    brain = brain or agent.brain
    actuator = _actuator(agent, brain)
    controller = getattr(brain, "controller", None)
    if not isinstance(actuator, DiscreteActuator) or actuator.handler is not None:
        return {}
    if not isinstance(controller, DiscreteArrowController):
        return {}
    names = {}
    for action, row in zip(CHOICES, actuator.table[1:], strict=False):
        forward, turn, jump, forward_jump = row
        name = MOTIONS.get((_sign(forward), _sign(turn), _sign(jump + forward_jump)))
        if name is not None:
            names[action] = name
    return names


def _useless_actions(agent: BasicAgent, brain: Brain) -> set[str]:
    """Return the actions that the controller knows and the body can't do."""
    controller, actuator = getattr(brain, "controller", None), _actuator(agent, brain)
    if isinstance(actuator, Actuator) and isinstance(controller, DiscreteArrowController):
        return set(CHOICES[int(actuator.limits()[1][0]) :])
    if actuator is None or not isinstance(controller, WASDRBMoveController | ArrowController):
        return set()
    numbers = len(actuator.limits()[0])
    parts = getattr(controller, "components", None) or (
        JUMPS if numbers >= MIN_JUMP_NUMBERS else ()
    )
    jump = getattr(actuator, "jump_power", 1.0)
    forward = jump or getattr(actuator, "jump_forward_power", 1.0)
    can = {"jump": jump and "jump" in parts, "jump_forward": forward and "jump_forward" in parts}
    return {action for action in JUMPS if not can[action]}


def _actuator(agent: BasicAgent, brain: Brain) -> Actuator | None:
    """Return the actuator that a brain's controller drives."""
    controller = getattr(brain, "controller", None)
    return agent.bound_blocks.actuators.get(getattr(controller, "actuator_name", ""))


def _sign(number: float) -> int:
    return (number > 0) - (number < 0)
