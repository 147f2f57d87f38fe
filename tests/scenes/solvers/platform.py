"""Eats the fruit, then goes east: it leaps from edge to edge, and round the spike to the exit."""

import math
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ai4u_edu import Percept
from tests.scenes.solvers import Driver

NOTHING, RIGHT, LEFT, AHEAD, LEAP = range(5)
FRUIT, SPIKE = 1, 3
BOUNDS = np.array([37.0, 10.5])
"""Divisors of the sensed position."""
EDGES = ((3.5, 1.0), (13.0, 1.0), (22.5, -1.0))
"""(x of the eastern edge, y at which there is a platform on both sides of the gap)."""

Point = tuple[float, float]


@dataclass
class Memory:
    """Last seen positions."""

    fruit: Point | None = None
    spike: Point | None = None


def found(percept: Percept, code: int, place: Point, heading: float) -> Point | None:
    """Return a visible thing's position in the world, the mean of the rays that hit it."""
    codes, distances = percept["around"].reshape(-1, 2).T
    seen = np.round(3 * codes) == code
    if not seen.any():
        return None
    angles = heading + 2 * math.pi * (np.flatnonzero(seen) + 1) / (len(codes) + 1) - math.pi
    angle = math.atan2(np.sin(angles).sum(), np.cos(angles).sum())
    far = 12 * float(distances[seen].min()) + 0.4
    return place[0] + far * math.cos(angle), place[1] + far * math.sin(angle)


def goal_on_the_last(spike: Point, place: Point) -> Point:
    """The exit, once it is past the spike; before, a way round it."""
    if place[0] > spike[0] + 0.8:
        return 31.0, -2.0
    return place[0] + 1.2, spike[1] + (1.9 if spike[1] < -1.5 else -1.9)


def solver() -> Driver:
    memory = Memory()

    def drive(percept: Percept) -> dict[str, Any]:
        x, y = (percept["position"][:2] * BOUNDS).tolist()
        sine, cosine = percept["heading"]
        heading = math.atan2(sine, cosine)
        ahead = [edge for edge in EDGES if x < edge[0]]
        see = partial(found, percept, place=(x, y), heading=heading)
        memory.fruit = see(FRUIT) or memory.fruit
        memory.spike = memory.spike or see(SPIKE)
        hungry = percept["inside"][0] < 0.25
        leap = False
        fruit = memory.fruit
        if hungry and fruit and (not ahead or fruit[0] < ahead[0][0]):
            goal = fruit
        elif ahead:
            edge, level = ahead[0]
            on_line = abs(y - level) < 0.6
            leap = on_line and x > edge - 0.8
            goal = (edge + 3.0, level) if on_line else (edge - 1.6, level)
        else:
            goal = goal_on_the_last(memory.spike or (x, -2.0), (x, y))
        aside = math.atan2(goal[1] - y, goal[0] - x) - heading
        aside = (aside + math.pi) % (2 * math.pi) - math.pi
        if abs(aside) > 0.2:
            return {"move": LEFT if aside > 0 else RIGHT}
        return {"move": LEAP if leap else AHEAD}

    return drive
