"""With the bearing: it turns to the target and pushes on, through boxes if need be."""

import math
from typing import Any

import numpy as np

from ai4u_edu import Percept
from tests.scenes.solvers import Driver


def solver() -> Driver:
    def drive(percept: Percept) -> dict[str, Any]:
        sine, cosine = (float(each) for each in percept["bearing"])
        turn = -np.clip(2 * math.atan2(sine, cosine), -1, 1)
        return {"move": [max(cosine, 0.0), turn]}

    return drive
