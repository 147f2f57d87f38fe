"""Calls while the partner faces its flag, and drives ahead while it is called."""

from tests.program.solutions.call import decide
from tests.scenes.solvers import Driver


def solver() -> Driver:
    """Drive as the program of the page does."""
    return decide
