"""Goes round the block to its far side, seen from the field; then pushes, and steers by the rest.

All places are in the robot's own frame: x forward, y left.
"""

import math
from typing import Any

import numpy as np

from ai4u_edu import Percept
from tests.scenes.solvers import Driver
from tests.scenes.solvers.seek import seek

PLATE = math.hypot(11, 11) + 5  # what the readings are divided by, metres


def solver() -> Driver:
    def drive(percept: Percept) -> dict[str, Any]:
        block, field = (PLATE * percept[key][:2].astype(float) for key in ("block", "field"))
        way = (field - block) / math.hypot(*(field - block))
        along, left = -float((block * way).sum()), float(way[0] * -block[1] + way[1] * block[0])
        # along, left: where the robot is, seen from the block, with the field ahead
        if along < -0.5 and abs(left) < 0.35:
            aim = block + 0.4 * way  # right behind it: push
        elif along < -0.5:
            aim = block - 1.7 * way
        else:  # beside or before it: out and past it
            side = 1.0 if left >= 0 else -1.0
            aim = block + 1.8 * side * np.array([-way[1], way[0]]) - 1.2 * way
        return seek(*(aim / math.hypot(*aim)).tolist())

    return drive
