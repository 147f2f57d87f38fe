"""Towards the middle of the floor that it sees a bit ahead."""

from typing import Any

import numpy as np

from ai4u_edu import Percept
from tests.scenes.solvers import Driver


def solver() -> Driver:
    def drive(percept: Percept) -> dict[str, Any]:
        floor = percept["vision"][0, 1]  # 18 degrees down: 1.5 m ahead; column 0 is the leftmost
        right = float((floor * np.linspace(-1, 1, len(floor))).sum()) / max(float(floor.sum()), 1.0)
        return {"move": [0.9, np.clip(2 * right, -1, 1), 0, 0]}

    return drive
