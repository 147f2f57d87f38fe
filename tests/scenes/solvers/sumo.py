"""Straight at the other one, at full speed; from near the edge back to the middle."""

import math
from typing import Any

from ai4u_edu import Percept
from tests.scenes.solvers import Driver
from tests.scenes.solvers.seek import seek

METRES = 9.0  # what a position of 1 is: the ring's radius and 5 m


def solver() -> Driver:
    def drive(percept: Percept) -> dict[str, Any]:
        x, y = METRES * percept["position"][0], METRES * percept["position"][1]
        forward, left, _ = percept["opponent"]
        angle = math.atan2(left, forward)
        if math.hypot(x, y) > 3.2 and math.cos(angle) < 0.9:
            sine, cosine = percept["heading"]
            angle = math.atan2(-y, -x) - math.atan2(sine, cosine)
        return seek(math.cos(angle), math.sin(angle))

    return drive
