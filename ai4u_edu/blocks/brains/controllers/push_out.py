"""A controller that pushes an opponent out of a ring."""

import math

from ai4u_edu.base.parameters import Point, PositiveMetres
from ai4u_edu.blocks.brains.controllers.steering import LocalPoint, SteeringController
from ai4u_edu.blocks.percept import Percept

FALLING_BELOW_M = -0.1
"""Relative height (metres) below which the opponent is falling already."""


class PushOutController(SteeringController):
    """Drives at its opponent; near the edge it turns back, unless the opponent is farther out.

    A simple wrestler: strong head-on, but an opponent can drive past it and push it from the side,
    where it can't push back.

    It needs three sensors, named by their perception keys: ``opponent``, a PositionSensor of the
    other body with ``frame="local"``; ``position``, a PositionSensor of its own; ``heading``, a
    HeadingSensor.

    Source: ours.
    """

    opponent: str = "opponent"
    """Perception key of a PositionSensor of the opponent, with ``frame="local"``."""
    position: str = "position"
    """Perception key of a PositionSensor of the agent itself."""
    heading: str = "heading"
    """Perception key of a HeadingSensor."""
    middle: Point = (0.0, 0.0)
    """Centre of the ring in the world: (x, y), in metres."""
    safe_radius: PositiveMetres = 2.8
    """Distance from the centre beyond which it turns back."""

    reads = ("opponent", "position", "heading")

    def target_point(self, percept: Percept) -> LocalPoint:
        """Return the opponent's position, or the middle of the ring."""
        forward, left, up = self.read(percept, "opponent").tolist()
        middle = self._middle(percept)
        outside = math.hypot(*middle) > self.safe_radius
        if outside and math.dist((forward, left), middle) < math.hypot(*middle):
            return middle
        return middle if up < FALLING_BELOW_M else (forward, left)

    def _middle(self, percept: Percept) -> LocalPoint:
        x, y, _ = self.read(percept, "position").tolist()
        sine, cosine = self.read(percept, "heading").tolist()
        dx, dy = self.middle[0] - x, self.middle[1] - y
        return cosine * dx + sine * dy, cosine * dy - sine * dx
