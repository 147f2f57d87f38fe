"""Draws the house: to the nearest corner, and round from corner to corner with the pen down."""

import math
from collections.abc import Mapping
from typing import Any

from ai4u_edu import Percept
from tests.scenes.solvers import Driver

CORNERS = [(-2.0, -2.0), (2.0, -2.0), (2.0, 1.0), (0.0, 3.0), (-2.0, 1.0)]


def solver() -> Driver:
    """Drive at the next corner, and turn on the spot where it is far aside."""
    goal: list[int] = []
    passed = [0]

    def drive(percept: Percept) -> Mapping[str, Any]:
        x, y, _ = percept["position"]
        sin, cos = percept["heading"]
        if not goal:
            goal.append(min(range(len(CORNERS)), key=lambda n: math.dist((x, y), CORNERS[n])))
        if math.dist((x, y), CORNERS[goal[0]]) < 0.15:
            goal[0], passed[0] = (goal[0] + 1) % len(CORNERS), passed[0] + 1
        to_x, to_y = CORNERS[goal[0]]
        angle = math.remainder(math.atan2(to_y - y, to_x - x) - math.atan2(sin, cos), 2 * math.pi)
        turn = max(-1.0, min(1.0, -3 * angle))
        ahead = max(0.0, math.cos(angle)) ** 8
        return {"move": [ahead, turn, 0, 0], "pen": [float(passed[0] > 0)]}

    return drive
