"""An actuator that says a few numbers to others."""

from typing import Annotated

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.parameters import PositiveMetres
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.world import Body

MAX_NUMBERS = 8


class SpeakActuator(Actuator):
    """Says a few numbers to all robots within reach: [speak], and ``size`` numbers of -1 to 1.

    Above 0.5 the first number speaks; at 0.5 or less the robot is silent, as in a decision without
    this action. With ``size`` 0 it only calls. What the numbers mean is up to the robots.

    Others hear it with a HearSensor, in their next percept. A new message replaces the last one.

    Source: ours.
    """

    action_name: str = "speak"
    size: Annotated[int, Field(ge=0, le=MAX_NUMBERS)] = 1
    """Count of numbers in a message; 0 for a call without any."""
    reach: PositiveMetres = 10.0
    """Distance up to which others hear it."""

    def space(self) -> Box:
        """Return the range of each number."""
        low = np.full(1 + self.size, -1.0, np.float32)
        low[0] = 0.0
        return Box(low, np.ones(1 + self.size, np.float32))

    def slots(self) -> tuple[str, ...]:
        """Return the names of the numbers."""
        return ("speak", *numbers_named(self.size))

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Say the numbers, or nothing."""
        if action[0] > 0.5:
            body.say(action[1:], self.reach)


def numbers_named(size: int) -> tuple[str, ...]:
    """Return names of a message's numbers.

    >>> numbers_named(1), numbers_named(2)
    (('number',), ('number 1', 'number 2'))
    """
    return ("number",) if size == 1 else tuple(f"number {index + 1}" for index in range(size))
