"""An actuator whose effect a script defines."""

from collections.abc import Callable
from typing import Annotated

from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import Body


class ContinuousActuator(Actuator):
    """Takes ``size`` numbers, each -1..1, and passes them to a script.

    The script sets ``actuator.handler = f``, and ``f(body, numbers)`` is called in every tick of
    the decision. It may do all that a body can do: forces, speeds, jumps.

    Action: Box(-1, 1, (size,)). Source: AI4U's ContinuousActuator.

    Differs from AI4U: the handler is a function; there it is a node with SetAction and Reset.

    >>> thruster = ContinuousActuator(size=2)
    >>> thruster.handler = lambda body, numbers: body.apply_force(10 * numbers[0], 10 * numbers[1])
    """

    size: Annotated[int, Field(ge=1, le=1024)] = 5
    """Number of values in an action."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.handler: Callable[[Body, tuple[float, ...]], None] | None = None

    def space(self) -> Box:
        """Return the range -1..1 for each number."""
        return Box(-1.0, 1.0, (self.size,))

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Pass the numbers to the handler."""
        if self.handler is None:
            raise BlockError(
                _(
                    "{type} {action_name!r}: nobody takes its numbers; expected a function, as in "
                    "actuator.handler = lambda body, numbers: ...",
                    type=type(self).__name__,
                    action_name=self.action_name,
                )
            )
        self.handler(body, action)
