"""Scripted teachers of a network: a few lines that solve a scene."""

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from ai4u_edu import Percept
from tests.scenes.solvers import Driver, solver_of
from tests.scenes.solvers.draw_figure import CORNERS
from tests.scenes.solvers.platform import (
    AHEAD,
    BOUNDS,
    EDGES,
    FRUIT,
    LEAP,
    LEFT,
    RIGHT,
    SPIKE,
    Point,
    found,
)

RADIUS = 2.6
BEHIND = 0.4
AHEAD_M = 0.35
"""Distance along the outline at which it aims."""
FASTEST = 0.85
"""Speed at which it has driven over the longest gap."""


def parking() -> Driver:
    """Like the scene's own solver, but without a memory: what it does follows from what it senses.

    A network remembers nothing, so it can't learn from one that does. That the car is on its way
    into the bay shows in its last action; it gives up only when it looks far from where it should.
    """

    def drive(percept: Percept) -> dict[str, Any]:
        forward, left, _ = map(float, percept["bay"])
        sine, cosine = map(float, percept["heading"])
        heading = math.atan2(sine, cosine)
        across = cosine * (forward + BEHIND) - sine * left
        deep = sine * forward + cosine * left
        up = math.copysign(1.0, deep)
        on_circle = math.acos(np.clip(1 - abs(across) / RADIUS, 0, 1))
        turned = math.pi / 2 - math.copysign(min(on_circle, 1.2 * abs(across)), across)
        going = float(percept["last_action"][0]) > 0 or up * deep < 0.3
        if across < RADIUS + 0.2 and not (going and turned - up * heading < 1.3):
            return {"move": [-0.6, np.clip(-2 * heading, -1, 1)]}
        askew = math.remainder(up * turned - heading, 2 * math.pi)
        speed = 0.0 if up * deep < 0.1 else 0.5
        return {"move": [speed, np.clip(-5 * askew, -1, 1)]}

    return drive


def platform() -> Driver:
    """Like the scene's own solver, but without a memory, and without leaps of the goal.

    Where one step changes what is to be done, a network is of two minds: it turns left, and right
    again, until it dies of hunger. So the goal wanders ahead of the robot, and bends smoothly.
    """

    def drive(percept: Percept) -> dict[str, Any]:
        x, y = (percept["position"][:2] * BOUNDS).tolist()
        heading = math.atan2(*percept["heading"])
        see = partial(found, percept, place=(x, y), heading=heading)
        fruit, spike = see(FRUIT), see(SPIKE)
        edge, level = next((each for each in EDGES if x < each[0]), (math.inf, -2.0))
        hungry = percept["inside"][0] < 0.25
        leap = False
        if hungry and fruit and fruit[0] < edge:
            goal = fruit
        elif edge < math.inf:
            # along the line on which to leap; to it first, where little room is left
            off = abs(y - level)
            goal = x + np.clip(edge - 1.4 - x, -0.5, 1.5) + 6 * max(0.0, 0.6 - off), level
            leap = off < 0.6 and x > edge - 0.8
        else:
            goal = x + 1.2, float(np.interp(x, *round_the(spike)))
        aside = math.remainder(math.atan2(goal[1] - y, goal[0] - x) - heading, 2 * math.pi)
        if abs(aside) > 0.3:
            return {"move": LEFT if aside > 0 else RIGHT}
        return {"move": LEAP if leap else AHEAD}

    return drive


def round_the(spike: Point | None) -> tuple[Sequence[float], Sequence[float]]:
    """The way over the last platform, on the side on which there is more room: x and y."""
    aside = -1.0 if spike is None else spike[1] + (1.7 if spike[1] < -1.5 else -1.7)
    return (25.2, 26.4, 28.8, 30.3), (-1.0, aside, aside, -2.0)


def draw_figure() -> Driver:
    """Drives round the house in one direction, at the place of its outline that is a bit ahead.

    The scene's own solver knows which corner is next; here it follows from where the robot is.
    """
    corners = np.array(CORNERS)
    ways = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(*ways.T)

    def drive(percept: Percept) -> dict[str, Any]:
        place = percept["position"][:2].astype(float)
        sine, cosine = map(float, percept["heading"])
        shares = np.clip(((place - corners) * ways).sum(axis=1) / lengths**2, 0, 1)
        nearest = corners + shares[:, None] * ways
        off = np.hypot(*(nearest - place).T)
        edge = int(off.argmin())
        along = shares[edge] * lengths[edge] + AHEAD_M
        if along > lengths[edge]:
            edge, along = (edge + 1) % len(corners), along - lengths[edge]
        goal = corners[edge] + along / lengths[edge] * ways[edge]
        angle = math.remainder(
            math.atan2(*(goal - place)[::-1]) - math.atan2(sine, cosine), 2 * math.pi
        )
        ahead = max(0.0, math.cos(angle)) ** 4
        pen = 1.0 if off.min() < 0.15 else 0.0
        return {"move": [ahead, np.clip(-3 * angle, -1, 1), 0, 0], "pen": [pen]}

    return drive


def endless_line() -> Driver:
    """Like the scene's own solver, but it remembers nothing: its last action says how far it is.

    Without a line, it drives on a bit faster with each decision, and curves a bit to the side on
    which the line was. Once it is fast, it was no gap: it turns on the spot, and goes on turning.
    """

    def drive(percept: Percept) -> dict[str, Any]:
        eyes = percept["line"]
        left_wheel, right_wheel = map(float, percept["last_action"])
        if eyes.all():  # a crossing
            return {"move": [0.5, 0.5]}
        if eyes.any():
            left = float(np.dot(eyes, [1, 0.5, 0, -0.5, -1]) / eyes.sum())
            return {"move": [0.5 - 0.45 * left, 0.5 + 0.45 * left]}
        speed, bend = (left_wheel + right_wheel) / 2, (right_wheel - left_wheel) / 2
        if speed > 0.4 and abs(bend) < 0.27 and speed < FASTEST:
            bend = float(np.clip(bend, -0.02, 0.02))
            speed = max(0.5, speed) + 0.04
            return {"move": [speed - bend, speed + bend]}
        turn = 0.35 if bend >= 0 else -0.35
        return {"move": [-turn, turn]}

    return drive


OWN: dict[str, Callable[[], Driver]] = {
    "parking": parking,
    "platform": platform,
    "draw_figure": draw_figure,
    "endless_line": endless_line,
}


def teacher_of(scene: str) -> Driver:
    """A new teacher for one episode."""
    return OWN[scene]() if scene in OWN else solver_of(scene)
