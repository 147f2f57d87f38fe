"""Soccer pitch: places on it, as a robot senses them, and practice with nobody else in it."""

import math
from collections.abc import Sequence
from json import dumps
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.lessons.rollouts import Drive, drives
from ai4u_edu.scenes import Scene

METRE = 1 / (math.hypot(16.2, 9.2) + 5)
"""A metre, in the unit of the pitch's position sensors."""
SAME_WAY_RAD = 0.5
"""Largest angle between two directions that count as the same."""
GAP = 1.4 * METRE
"""Distance from the ball of the place behind it."""

Place = Sequence[float] | npt.NDArray[np.float64]


def go_to(forward: float, left: float) -> dict[str, list[float]]:
    """Return the action that drives towards a place: so far ahead of the robot, so far left."""
    angle = math.atan2(left, forward)
    return {"move": [float(abs(angle) < 0.5), max(-1.0, min(1.0, -2 * angle)), 0, 0]}


def lined_up(ball: Place, goal: Place) -> bool:
    """Return True if ball and goal lie in the same direction, seen from the robot."""
    angle = math.atan2(ball[1], ball[0]) - math.atan2(goal[1], goal[0])
    return abs(math.remainder(angle, math.tau)) < SAME_WAY_RAD


def behind(ball: Place, goal: Place, gap: float = GAP) -> tuple[float, float]:
    """Return the place behind the ball, seen from the goal: (ahead, left) of the robot."""
    x, y = goal[0] - ball[0], goal[1] - ball[1]
    length = math.hypot(x, y)
    return float(ball[0] - gap * x / length), float(ball[1] - gap * y / length)


def practice() -> Scene:
    """Return the soccer scene with nobody in it but you and the ball."""
    plain = Scene.load("soccer").plain()
    plain["agents"] = plain["agents"][:1]
    others = {"blue keeper", "orange striker", "orange keeper"}
    plain["bodies"] = [each for each in plain["bodies"] if each["name"] not in others]
    return Scene.loads(dumps(plain), name="practice")  # JSON is YAML as well


def in_front(done: Drive) -> None:
    """Put the striker between the ball and the goal, at the beginning."""
    if done.steps == 0:
        chance = np.random.default_rng(done.seed)
        x, y, heading = chance.uniform(1.5, 5), chance.uniform(-3.5, 3.5), chance.uniform(-3, 3)
        done.agent.body.move_to(float(x), float(y), heading=float(heading))


def goals(strike: Any, games: int = 12) -> int:
    """Return in how many games a striker scores that begins in front of the ball."""
    return sum(each.won for each in drives("soccer", strike, list(range(games)), watch=in_front))
