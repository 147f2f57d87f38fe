"""A Python function as a controller."""

from collections.abc import Callable
from typing import Annotated

from pydantic import WithJsonSchema

from ai4u_edu.blocks.brains.brain import Answer
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.percept import Percept


class ScriptController(Controller):
    """Calls a Python function that maps a percept to an action.

    >>> ScriptController(function=lambda percept: {"move": [1, 0, 0, 0]}).get_action({})
    {'move': [1, 0, 0, 0]}
    """

    function: Annotated[Callable[[Percept], Answer], WithJsonSchema({"type": "a Python function"})]
    """Function that takes a percept and returns an action, or a command."""

    def get_action(self, percept: Percept) -> Answer:
        """Return the function's result."""
        return self.function(percept)
