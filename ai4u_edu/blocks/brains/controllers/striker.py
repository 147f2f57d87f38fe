"""A controller that pushes a ball into a goal."""

import math

from ai4u_edu.base.parameters import PositiveMetres
from ai4u_edu.blocks.brains.controllers.steering import LocalPoint, SteeringController, direction_to
from ai4u_edu.blocks.percept import Percept

FAR_SHOT_COSINE, NEAR_SHOT_COSINE = 0.9, 0.5
"""Smallest cosine of the angle between agent, ball and goal at which it shoots: far off, close."""


class StrikerController(SteeringController):
    """Goes behind the ball, as seen from the goal, and pushes it there.

    If the ball is in its way it drives around it, on the side of the pitch's middle, where no wall
    is in the way.

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
    """Distance behind the ball from which it starts to push."""

    reads = ("ball", "goal", "home")

    def target_point(self, percept: Percept) -> LocalPoint:
        """Return a point beyond the ball if it is lined up, else one behind or beside it."""
        ball, goal, home = (self.spot(percept, name) for name in self.reads)
        (x, y), _ = direction_to(ball, goal)
        (ahead, left), distance = direction_to((0.0, 0.0), ball)
        in_line = ahead * x + left * y
        if in_line > (NEAR_SHOT_COSINE if distance < self.run_up else FAR_SHOT_COSINE):
            return ball[0] + 0.3 * x, ball[1] + 0.3 * y
        behind = ball[0] - self.run_up * x, ball[1] - self.run_up * y
        if in_line > 0.0:
            return behind
        middle = (goal[0] + home[0]) / 2, (goal[1] + home[1]) / 2
        aside = self.run_up * y, self.run_up * -x
        sides = [(behind[0] + s * aside[0], behind[1] + s * aside[1]) for s in (1, -1)]
        return min(sides, key=lambda side: math.dist(side, middle))
