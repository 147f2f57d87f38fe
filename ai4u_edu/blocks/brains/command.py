"""Answers of brains: actions and commands."""

from collections.abc import Mapping
from enum import StrEnum
from typing import Any

__all__ = ["Action", "Command"]


class Command(StrEnum):
    """An answer that is not an action."""

    RESTART = "restart"
    """Begin a new episode, for the world and all its agents."""
    RESPAWN = "respawn"
    """Begin a new episode for this agent alone; the world and the others go on."""
    PAUSE = "pause"
    """Take no more decisions until resume."""
    RESUME = "resume"
    """Go on."""
    STOP = "stop"
    """Take no more decisions until the next reset."""
    WAIT = "wait"
    """No answer yet: ask again at the next tick."""
    HOLD = "hold"
    """No answer yet, and the world waits for it: ask again before the next tick."""


Action = Mapping[str, Any]
"""Numbers by the actuator's name; actuators that are left out get no action."""


class Accepted(dict[str, tuple[float, ...]]):
    """An action whose numbers the agent's actuators have checked already."""


Answer = Action | Command
