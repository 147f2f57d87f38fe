"""Drives round the nest until it sees a trail, follows it to the food, and goes home."""

from typing import Any

from ai4u_edu import Percept
from tests.program.solutions.ants import Ant
from tests.scenes.solvers import Driver


def solver() -> Driver:
    """Drive as the program of the page does, which sees only what the agent senses."""
    ant = Ant()
    ant.on_reset(None, None)  # type: ignore[no-untyped-call]  # a beginner's program

    def drive(percept: Percept) -> dict[str, Any]:
        return {"pen": [0.0], **ant.get_action(percept)}  # type: ignore[no-untyped-call]

    return drive
