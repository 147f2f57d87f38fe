"""What a brain can answer instead of an action."""

from collections.abc import Mapping
from enum import StrEnum
from typing import Any


class Command(StrEnum):
    """An answer that is not an action."""

    RESTART = "restart"
    """Begin a new episode."""
    PAUSE = "pause"
    """Take no more decisions until resume."""
    RESUME = "resume"
    """Go on."""
    STOP = "stop"
    """Take no more decisions until the next reset."""
    WAIT = "wait"
    """No answer yet: ask again at the next tick."""


Action = Mapping[str, Any]
"""An action by the actuator's name: numbers for each. What is left out gets no action."""

Answer = Action | Command
