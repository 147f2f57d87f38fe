"""An actuator with a table of motions."""

from collections.abc import Callable
from typing import Annotated

from gymnasium.spaces import Discrete
from pydantic import Field

from ai4u_edu.base.errors import BlockError
from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.actuators.choice import ChoiceActuator
from ai4u_edu.blocks.actuators.ground_motion import GroundMotion
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import Body, WorldView

Signed = Annotated[float, quantity("1", ge=-1, le=1)]
Share = Annotated[float, quantity("1", ge=0, le=1)]
Row = tuple[Signed, Signed, Share, Share]

ARROWS: list[Row] = [(0, 0, 0, 0), (0, 1, 0, 0), (0, -1, 0, 0), (1, 0, 0, 0), (-1, 0, 0, 0)]
"""Nothing, turn right, turn left, forward, backward: as in DiscreteArrowController."""


class DiscreteActuator(GroundMotion, ChoiceActuator):
    """Takes a whole number from 0 to size - 1 and looks it up in a table of motions.

    A row of the table is [forward, turn, jump, forward jump] as in RBMoveActuator (-1..1, -1..1,
    0..1, 0..1), and moves the body in the same way. The default rows are:
    0 nothing, 1 turn right, 2 turn left, 3 forward, 4 backward.

    A script may replace the table: with ``actuator.handler = f``, ``f(body, index)`` is called in
    every tick of the decision, on the ground or in the air.

    Action: Discrete(size), as an int. An invalid choice is refused, not clipped.
    Source: AI4U's DiscretActuator.

    Differs from AI4U: without a handler it moves the body by its table; there it does nothing. A
    handler is a function; there it is a node with SetAction and Reset.
    """

    size: Annotated[int, Field(ge=1, le=1024)] | None = None
    """Number of choices; left out: as many as the table has rows."""
    table: Annotated[list[Row], Field(min_length=1)] = Field(default_factory=lambda: list(ARROWS))
    """A row [forward, turn, jump, forward jump] for each choice: shares of full power, -1..1 for
    the first two, 0..1 for the jumps."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.handler: Callable[[Body, int], None] | None = None

    def space(self) -> Discrete:
        """Return the ``size`` choices."""
        return Discrete(self.size or len(self.table))

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Check that every choice has a row of the table, or that there is a handler."""
        # not earlier: until now a script could set a handler
        if self.handler is None and (self.size or 0) > len(self.table):
            raise BlockError(
                _(
                    "expected a row of the table for each of {size} choices, got {count} rows; "
                    "add some, or set a handler",
                    size=str(self.size),
                    count=len(self.table),
                )
            )

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Move the body by the table, or call the handler."""
        index = int(action[0])
        if self.handler is not None:
            self.handler(body, index)
        elif body.on_ground:
            self.drive(body, *self.table[index])
