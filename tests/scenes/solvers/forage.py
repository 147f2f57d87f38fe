"""Goes to the nearest of what it lacks most; stays where it is while it lacks nothing."""

import math
from typing import Any

import numpy as np

from ai4u_edu import Percept
from tests.scenes.solvers import Driver

FOOD, WATER = 1, 2
ENOUGH = 0.55


def solver() -> Driver:
    def drive(percept: Percept) -> dict[str, Any]:
        energy, water = percept["inside"]
        if min(energy, water) > ENOUGH:
            return {"move": [0, 0, 0, 0]}
        codes, distances = percept["vision"].reshape(-1, 2).T
        wanted = np.round(3 * codes) == (FOOD if energy < water else WATER)
        if not wanted.any():
            return {"move": [1.0, 0.3, 0, 0]}  # looks for some
        ray = int(np.where(wanted, distances, np.inf).argmin())
        angle = 2 * math.pi * (ray + 1) / (len(codes) + 1) - math.pi
        ahead = max(0.2, math.cos(angle))  # never on the spot: things hide behind one another
        return {"move": [ahead, -np.clip(2 * angle, -1, 1), 0, 0]}

    return drive
