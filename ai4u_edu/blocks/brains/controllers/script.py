"""A Python function as a controller."""

from collections.abc import Callable

from ai4u_edu.blocks.brains.command import Answer
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.percept import Percept


class ScriptController(Controller):
    """Asks a function.

    >>> ScriptController(function=lambda percept: {"move": [1, 0, 0, 0]}).get_action({})
    {'move': [1, 0, 0, 0]}
    """

    function: Callable[[Percept], Answer]

    def get_action(self, percept: Percept) -> Answer:
        """What the function returns."""
        return self.function(percept)
