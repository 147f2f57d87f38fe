"""Behind the ball, seen from the goal, and then through it."""

import math
from typing import Any

import numpy as np

from ai4u_edu import Percept
from tests.scenes.solvers import Driver
from tests.scenes.solvers.seek import seek

METRES = math.hypot(16.2, 9.2) + 5  # what a position of 1 is


def solver() -> Driver:
    stuck = 0

    def drive(percept: Percept) -> dict[str, Any]:
        nonlocal stuck
        stuck = stuck + 1 if abs(percept["velocity"][0]) < 1 or stuck > 10 else 0
        if stuck > 10:  # somebody pushes as hard as it does
            stuck %= 18
            return {"move": [-1, 0.5, 0, 0]}
        ball, goal, home = (METRES * percept[key][:2] for key in ("ball", "goal", "home"))
        shot = (goal - ball) / math.hypot(*(goal - ball))
        across = np.array([-shot[1], shot[0]])
        before, beside = float((ball * shot).sum()), float((ball * across).sum())
        if before > 0 and abs(beside) < (1.2 if before < 1 else 0.4) * before:
            aim = ball + 0.3 * shot
        elif before > 0:
            aim = ball - 1.2 * shot
        else:  # it is in the way: round it, on the side of the middle
            inwards = math.copysign(1.2, float((((goal + home) / 2 - ball) * across).sum()))
            aim = ball - 1.0 * shot + inwards * across
        return seek(*(aim / math.hypot(*aim)).tolist())

    return drive
