"""Steers by where the line is under its row of eyes; off the line, to where it was last seen."""

from typing import Any

from ai4u_edu import Percept
from tests.scenes.solvers import Driver


def solver() -> Driver:
    left = 0.0

    def drive(percept: Percept) -> dict[str, Any]:
        nonlocal left
        eyes = percept["line"]
        if eyes.any():
            left = float((eyes * [1, 0.5, 0, -0.5, -1]).sum() / eyes.sum())
            return {"move": [0.7 - 0.5 * left, 0.7 + 0.5 * left]}
        turn = 0.4 if left >= 0 else -0.4
        return {"move": [-turn, turn]}

    return drive
