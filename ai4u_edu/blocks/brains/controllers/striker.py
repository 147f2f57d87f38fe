"""Pushes a ball into a goal."""

import math

from ai4u_edu.base.parameters import PositiveMetres
from ai4u_edu.blocks.brains.controllers.steering import Spot, SteeringController, towards
from ai4u_edu.blocks.percept import Percept

IN_LINE, NEARLY = 0.9, 0.5
"""Cosine of the angle at the ball under which it shoots: from far off, and when it is close."""


class StrikerController(SteeringController):
    """Goes behind the ball, seen from the goal, and drives it there; round it, if it is in the way.

    It goes round on the side of the pitch's middle, so that no wall is in its way.

    It needs three sensors, named by their perception keys: ``ball``, ``goal`` and ``home``. All are
    PositionSensors with ``frame="local"``: of the ball, of a body in the goal that it shoots at and
    of one in the other goal.

    Source: ours.
    """

    ball: str = "ball"
    """Perception key of a PositionSensor of the ball, with ``frame="local"``."""
    goal: str = "goal"
    """Perception key of a PositionSensor of a body in the goal to shoot at, with
    ``frame="local"``."""
    home: str = "home"
    """Perception key of a PositionSensor of a body in the other goal, with ``frame="local"``."""
    run_up: PositiveMetres = 1.2
    """Distance behind the ball from which it takes its run."""

    reads = ("ball", "goal", "home")

    def wish(self, percept: Percept) -> Spot:
        """Through the ball, where that leads to the goal; else a place behind it, or beside it."""
        ball, goal, home = (self.spot(percept, name) for name in self.reads)
        (x, y), _ = towards(ball, goal)
        (ahead, left), distance = towards((0.0, 0.0), ball)
        in_line = ahead * x + left * y
        if in_line > (NEARLY if distance < self.run_up else IN_LINE):
            return ball[0] + 0.3 * x, ball[1] + 0.3 * y
        behind = ball[0] - self.run_up * x, ball[1] - self.run_up * y
        if in_line > 0.0:
            return behind
        middle = (goal[0] + home[0]) / 2, (goal[1] + home[1]) / 2
        aside = self.run_up * y, self.run_up * -x
        sides = [(behind[0] + s * aside[0], behind[1] + s * aside[1]) for s in (1, -1)]
        return min(sides, key=lambda side: math.dist(side, middle))
