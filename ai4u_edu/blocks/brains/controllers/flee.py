"""A controller that flees from a pursuer."""

import math

import numpy as np

from ai4u_edu.base.errors import BlockError
from ai4u_edu.base.parameters import PositiveMetres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.controllers.steering import LocalPoint, SteeringController
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.blocks.sensors import LinearRayCastingSensor
from ai4u_edu.blocks.sensors.ray_sensor import spread
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import WorldView

STRAIGHT_WEIGHT = 0.3
"""Weight of going straight on, relative to a weight of 1 for getting away."""


class FleeController(SteeringController):
    """Flees from its pursuer to where there is room: it rates directions along rays.

    A ray is better if it leads away from the pursuer and if it is free for longer (up to ``room``).
    While the pursuer is farther away than ``calm_distance``, it drives to where there is room, at a
    third of its speed.

    It needs two sensors, named by their perception keys: ``pursuer``, a PositionSensor of the other
    body with ``frame="local"``; ``rays``, a LinearRayCastingSensor all around it (``field_of_view``
    360) with ``return_distance``.

    Source: ours.
    """

    pursuer: str = "pursuer"
    """Perception key of a PositionSensor of the pursuer, with ``frame="local"``."""
    rays: str = "rays"
    """Perception key of a LinearRayCastingSensor all around, with ``return_distance``."""
    calm_distance: PositiveMetres = 5.0
    """Distance beyond which the pursuer is no danger."""
    room: PositiveMetres = 2.5
    """Free length of a ray that is enough; more makes it no better."""

    reads = ("pursuer", "rays")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up its sensors and the rays' angles."""
        super().on_setup(agent, view)
        sensor = self._sensors["rays"]
        if not isinstance(sensor, LinearRayCastingSensor) or not sensor.return_distance:
            raise BlockError(
                _(
                    "rays: expected a LinearRayCastingSensor with return_distance=True, got "
                    "{sensor}",
                    sensor=repr(sensor),
                )
            )
        self._reach = sensor.vision_max_distance
        self._unit = sensor.vision_max_distance / sensor.farthest
        self._angles = spread(sensor.number_of_rays, sensor.field_of_view)
        self._angles -= math.radians(sensor.horizontal_shift)

    def target_point(self, percept: Percept) -> LocalPoint:
        """Return a point along the best ray."""
        forward, left = self.spot(percept, "pursuer")
        free = np.asarray(percept[self.rays][1::2], np.float64) * self._unit
        free = np.where(free == 0.0, self._reach, free)
        away = -np.cos(self._angles - math.atan2(left, forward)) * self._is_chased(percept)
        worth = (
            away + 2.0 * np.minimum(free / self.room, 1.0) + STRAIGHT_WEIGHT * np.cos(self._angles)
        )
        best = float(self._angles[np.argmax(worth)])
        return math.cos(best), math.sin(best)

    def speed_share(self, percept: Percept, target_point: LocalPoint) -> float:
        """Return 1 while the pursuer is near, else 0.3."""
        return 1.0 if self._is_chased(percept) else 0.3

    def _is_chased(self, percept: Percept) -> bool:
        return math.hypot(*self.spot(percept, "pursuer")) < self.calm_distance
