"""Numbers that a script turns into motion."""

from collections.abc import Callable
from typing import Annotated

from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.world import Body


class ContinuousActuator(Actuator):
    """Takes ``size`` numbers, each -1..1, and hands them to a script.

    The script says what they do: ``actuator.handler = f``, and ``f(body, numbers)`` is called for
    every tick of the decision. Whatever a body can do is open to it: forces, speeds, jumps.

    Action: Box(-1, 1, (size,)). Source: AI4U's ContinuousActuator.

    Differs from AI4U: the handler is a function, there a node with SetAction and Reset.

    >>> thruster = ContinuousActuator(size=2)
    >>> thruster.handler = lambda body, numbers: body.apply_force(10 * numbers[0], 10 * numbers[1])
    """

    size: Annotated[int, Field(ge=1, le=1024)] = 5
    """Count of numbers in an action."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.handler: Callable[[Body, tuple[float, ...]], None] | None = None

    def space(self) -> Box:
        """``size`` numbers."""
        return Box(-1.0, 1.0, (self.size,))

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Hands the numbers on."""
        if self.handler is None:
            raise BlockError(
                f"{type(self).__name__} {self.action_name!r}: nobody takes its numbers; expected "
                "a function, as in actuator.handler = lambda body, numbers: ..."
            )
        self.handler(body, action)
