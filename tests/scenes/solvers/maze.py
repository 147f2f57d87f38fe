"""Keeps a wall at its right hand; goes for the exit when it sees it."""

import math
from typing import Any

import numpy as np

from ai4u_edu import Percept
from tests.scenes.solvers import Driver
from tests.scenes.solvers.seek import seek

ANGLES = np.radians(np.arange(-90, 91, 15))  # of the rays, from the right to the left


def solver() -> Driver:
    def drive(percept: Percept) -> dict[str, Any]:
        codes, far = percept["vision"][::2], percept["vision"][1::2] * 12
        exits = ANGLES[codes == 1.0]
        if exits.size:
            angle = float(exits.mean())
            return seek(math.cos(angle), math.sin(angle))
        if far[5:8].min() < 0.85:  # a wall ahead
            return {"move": [0, -1, 0, 0]}
        # what is nearest at the right hand is kept 0.8 m away; where it ends, that leads round it
        right = float(np.clip(far[:5].min() - 0.8, -1, 1))
        return {"move": [0.8 - 0.4 * abs(right), right, 0, 0]}

    return drive
