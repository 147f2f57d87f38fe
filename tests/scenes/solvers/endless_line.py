"""Steers by where the line is under its row of eyes; goes straight on over gaps, then turns."""

from typing import Any

from ai4u_edu import Percept
from tests.scenes.solvers import Driver

GAP_DECISIONS = 12
"""Decisions for which it goes straight on without a line, which lead over a gap."""


def solver() -> Driver:
    left, lost, calm = 0.0, 0, 0

    def drive(percept: Percept) -> dict[str, Any]:
        nonlocal left, lost, calm
        eyes = percept["line"]
        if eyes.all():  # a crossing
            lost = 0
            return {"move": [0.5, 0.5]}
        if eyes.any():
            lost = 0
            left = float((eyes * [1, 0.5, 0, -0.5, -1]).sum() / eyes.sum())
            calm = calm + 1 if abs(left) <= 0.25 else 0
            return {"move": [0.5 - 0.45 * left, 0.5 + 0.45 * left]}
        lost += 1
        if lost <= GAP_DECISIONS and abs(left) < 0.6:
            return {"move": [0.5, 0.5]}
        turn = 0.35 if left >= 0 else -0.35
        return {"move": [-turn, turn]}

    return drive
