"""After the nearest runner that is free, along a ray that is free."""

import math
from typing import Any

import numpy as np

from ai4u_edu import Percept
from tests.scenes.solvers import Driver
from tests.scenes.solvers.seek import seek

METRES = math.hypot(14.2, 10.2) + 5  # what a position of 1 is
RUNNERS = ("runner 1", "runner 2", "runner 3")
ANGLES = np.radians(360) * (np.arange(1, 16) / 16 - 0.5)


def solver() -> Driver:
    def drive(percept: Percept) -> dict[str, Any]:
        free = [name for name, there in zip(RUNNERS, percept["free"], strict=True) if there]
        away = {name: METRES * math.hypot(*percept[name][:2]) for name in free}
        nearest = min(free, key=lambda name: away[name])
        forward, aside, _ = percept[nearest]
        angle = math.atan2(aside, forward)
        codes, rooms = percept["rays"][0::2], 8 * percept["rays"][1::2]
        walls = (codes == 0.5) & (rooms < min(1.5, away[nearest]))
        if walls[np.argmin(np.abs(ANGLES - angle))]:
            worth = np.cos(ANGLES - angle) - 3 * walls
            angle = float(ANGLES[np.argmax(worth)])
        return seek(math.cos(angle), math.sin(angle))

    return drive
