"""A controller that finds food by trails of ink."""

import math
from typing import ClassVar

import numpy as np

from ai4u_edu.base.errors import BlockError
from ai4u_edu.base.parameters import PositiveMetres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Answer
from ai4u_edu.blocks.brains.controllers.steering import SteeringController, steer
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.blocks.sensors import LinearRayCastingSensor
from ai4u_edu.blocks.sensors.ray_sensor import Code, spread
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import WorldView

_TURN_BACK_DECISIONS = 10
"""Decisions for which it turns away from the nest when it has met a trail towards it."""
_WHEEL_RAD = 0.25
"""Largest random change of its direction in a decision, while it searches."""


class AntController(SteeringController):
    """Searches for food, carries it to the nest with the pen down, and follows trails.

    It wanders at random, away from walls, until its eyes see ink or it sees food. A trail leads
    from food to the nest, so it follows a trail away from the nest. Once it has touched food, it
    goes straight to the nest and draws; there it turns back.

    It needs four sensors, named by their perception keys: ``eyes``, a LineSensor; ``nest``, a
    PositionSensor with ``frame="local"``; ``touch``, a TouchSensor of the food; ``rays``, a
    LinearRayCastingSensor in front with ``return_distance``, which sees the food as ``food_code``.

    Source: ours, after how ants find food.
    """

    eyes: str = "line"
    """Perception key of a LineSensor, which sees ink."""
    nest: str = "nest"
    """Perception key of a PositionSensor of the nest, with ``frame="local"``."""
    touch: str = "touch"
    """Perception key of a TouchSensor of the food."""
    rays: str = "rays"
    """Perception key of a LinearRayCastingSensor in front, with ``return_distance``."""
    pen: str = "pen"
    """Action name of its PenActuator."""
    food_code: Code = 2
    """Code of the food among the rays."""
    home: PositiveMetres = 0.8
    """Distance from the nest's centre at which it is at home."""

    reads = ("eyes", "nest", "touch", "rays")
    carried: ClassVar[tuple[str, ...]] = ("_is_laden", "_turning", "_wheel")

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
        self._angles = spread(sensor.number_of_rays, sensor.field_of_view)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Begin without food, in a direction of its own."""
        super().on_reset(agent, view)
        self._is_laden = False
        self._turning = 0
        self._wheel = 0.0

    def get_action(self, percept: Percept) -> Answer:
        """Return the action, and whether the pen is down."""
        nest = self.spot(percept, "nest")
        if self._is_laden and math.hypot(*nest) < self.home:
            self._is_laden, self._turning = False, _TURN_BACK_DECISIONS
        elif not self._is_laden and percept[self.touch][0] > 0:
            self._is_laden = True
        point = nest if self._is_laden else self._searching(percept, nest)
        return {
            self.actuator_name: steer(*point, self.speed),
            self.pen: (float(self._is_laden),),
        }

    def _searching(self, percept: Percept, nest: tuple[float, float]) -> tuple[float, float]:
        """Return a point on the way to food."""
        rays = self.read(percept, "rays")
        is_food = rays[::2] == self.food_code
        if is_food.any():
            angle = float(self._angles[is_food].mean())
            return math.cos(angle), math.sin(angle)
        eyes = np.asarray(percept[self.eyes])
        if self._turning:
            self._turning -= 1
            return -nest[0], -nest[1]
        if eyes.any():
            if nest[0] > 0.5 and math.hypot(*nest) > 2 * self.home:
                self._turning = _TURN_BACK_DECISIONS
            # no dot product: its last bit is another one on another processor
            side = float((eyes * np.linspace(1.0, -1.0, len(eyes))).sum() / eyes.sum())
            return 1.0, side
        is_hit = rays[1::2] > 0.0
        if is_hit.any():  # away from a wall
            self._wheel = 0.8 if float(self._angles[is_hit].mean()) < 0.0 else -0.8
        change = float(self._rng.uniform(-_WHEEL_RAD, _WHEEL_RAD))
        self._wheel = 0.9 * self._wheel + change
        return math.cos(self._wheel), math.sin(self._wheel)
