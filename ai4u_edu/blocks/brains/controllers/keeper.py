"""Guards a goal."""

import math

from ai4u_edu.base.parameters import PositiveMetres
from ai4u_edu.blocks.brains.controllers.steering import Spot, SteeringController, towards
from ai4u_edu.blocks.percept import Percept


class KeeperController(SteeringController):
    """Stays between the ball and its goal; a ball that comes near is hit away.

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
    """Distance from its goal within which it goes out to the ball."""

    reads = ("ball", "home")

    def wish(self, percept: Percept) -> Spot:
        """The ball, if it is in its area and farther from home; else a place between the two."""
        ball, home = self.spot(percept, "ball"), self.spot(percept, "home")
        out, distance = towards(home, ball)
        if math.hypot(*home) < distance < self.area:
            return ball
        guard = min(self.guard, distance)
        return home[0] + guard * out[0], home[1] + guard * out[1]

    def effort(self, percept: Percept, wish: Spot) -> float:
        """All of it to the ball; on guard, the less the nearer it is to where it wants to be."""
        return 1.0 if wish == self.spot(percept, "ball") else min(1.0, math.hypot(*wish))
