"""The base of controllers, which a LocalBrain asks for actions."""

from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.block import Block
from ai4u_edu.blocks.brains.brain import Answer
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.locale import gettext as _


class Controller(Block):
    """The base of all controllers: override :meth:`get_action`. Source: AI4U's Controller.

    >>> class Forward(Controller):
    ...     '''Always drives forward.'''
    ...     speed: float = 1.0
    ...     def get_action(self, percept): return {"move": [self.speed, 0, 0, 0]}
    >>> Forward(speed=0.5).get_action({})
    {'move': [0.5, 0, 0, 0]}
    """

    def get_action(self, percept: Percept) -> Answer:
        """Return an action for each actuator, by its name, or a command.

        Args:
            percept: the agent's present readings.
        """
        raise BlockError(
            _(
                "{type} has no get_action(self, percept): it must return an action",
                type=type(self).__name__,
            )
        )

    def new_state_event(self, percept: Percept) -> None:
        """React to a new percept; called before :meth:`get_action`."""
