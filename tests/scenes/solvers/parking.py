"""Backs up along the lane until there is room for a quarter circle, and drives in on that."""

import math
from typing import Any

import numpy as np

from ai4u_edu import Percept
from tests.scenes.solvers import Driver

RADIUS = 2.6  # a bit more than the car's smallest
BEHIND = 0.4  # the point that is led along the circle is so far behind the car's centre


def solver() -> Driver:
    backing = True

    def drive(percept: Percept) -> dict[str, Any]:
        nonlocal backing
        forward, left, _ = map(float, percept["bay"])
        sine, cosine = map(float, percept["heading"])
        heading = math.atan2(sine, cosine)
        across = cosine * (forward + BEHIND) - sine * left  # how far on along the lane the bay is
        deep = sine * forward + cosine * left
        up = math.copysign(1.0, deep)
        backing = backing and across < RADIUS + 0.2
        if backing:
            return {"move": [-0.6, np.clip(-2 * heading, -1, 1)]}
        on_circle = math.acos(np.clip(1 - abs(across) / RADIUS, 0, 1))
        wanted = up * (math.pi / 2 - math.copysign(min(on_circle, 1.2 * abs(across)), across))
        askew = math.remainder(wanted - heading, 2 * math.pi)
        speed = 0.0 if up * deep < 0.1 else 0.5
        return {"move": [speed, np.clip(-5 * askew, -1, 1)]}

    return drive
