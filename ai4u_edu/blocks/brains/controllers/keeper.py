"""A controller that guards a goal."""

import math

from ai4u_edu.base.parameters import PositiveMetres
from ai4u_edu.blocks.brains.controllers.steering import LocalPoint, SteeringController, direction_to
from ai4u_edu.blocks.percept import Percept


class KeeperController(SteeringController):
    """Stays between the ball and its goal, and hits the ball away when it comes near.

    It needs two sensors, named by their perception keys: ``ball`` and ``home``, PositionSensors
    with ``frame="local"``, of the ball and of a body in the goal that it guards.

    Source: ours.
    """

    ball: str = "ball"
    """Perception key of a PositionSensor of the ball, with ``frame="local"``."""
    home: str = "home"
    """Perception key of a PositionSensor of a body in its own goal, with ``frame="local"``."""
    guard: PositiveMetres = 2.0
    """Distance from its goal at which it waits for the ball."""
    area: PositiveMetres = 3.5
    """Distance from its goal within which it drives to the ball."""

    reads = ("ball", "home")

    def target_point(self, percept: Percept) -> LocalPoint:
        """Return the ball if it is in the area and farther from the goal, else a point between."""
        ball, home = self.spot(percept, "ball"), self.spot(percept, "home")
        out, distance = direction_to(home, ball)
        if math.hypot(*home) < distance < self.area:
            return ball
        guard = min(self.guard, distance)
        return home[0] + guard * out[0], home[1] + guard * out[1]

    def speed_share(self, percept: Percept, target_point: LocalPoint) -> float:
        """Return 1 towards the ball; on guard, slow down near the point."""
        return (
            1.0
            if target_point == self.spot(percept, "ball")
            else min(1.0, math.hypot(*target_point))
        )
