"""Follows the line, turns at green marks, drives around obstacles, and finds the victim."""

from typing import Any

from ai4u_edu import Percept
from tests.program.solutions.endless_rescue import Rescuer
from tests.scenes.solvers import Driver


def solver() -> Driver:
    """Drive as the program of the page does, which sees only what the agent senses."""
    rescuer = Rescuer()
    rescuer.on_reset(None, None)  # type: ignore[no-untyped-call]  # a beginner's program

    def drive(percept: Percept) -> dict[str, Any]:
        action: dict[str, Any] = rescuer.get_action(percept)  # type: ignore[no-untyped-call]
        return action

    return drive
