"""The base of controllers that steer to a point, with some randomness."""

import math
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.errors import BlockError, suggest
from ai4u_edu.base.parameters import Count, quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Answer
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.brains.controllers.wasd import Amount
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import WorldView

LocalPoint = tuple[float, float]
"""A point in the agent's own frame: (forward, left), metres."""

MAX_ERROR_RAD = math.radians(40)
"""Largest error of the direction at whim 1."""
NEW_ERROR_PROBABILITY = 0.1
"""Probability that a decision draws a new error."""
BACK_OFF_PROBABILITY = 0.1
"""Probability that a decision at whim 1 begins to back off, so that no two push for ever."""
BACK_OFF_DECISIONS = 6
"""Duration of backing off."""


class SteeringController(Controller):
    """The base of scripted drivers: a subclass chooses the point to drive to at every decision.

    Parameters name its sensors by their perception keys. Normalised readings are converted back to
    metres.
    """

    abstract = True

    actuator_name: str = "move"
    """Action name of its RBMoveActuator."""
    speed: Amount = 1.0
    """Forward number at full speed, as a share of full power."""
    whim: Annotated[float, quantity("1", ge=0, le=1)] = 0.2
    """Random variation, from the world's seed: of its direction (by up to 40 degrees at
    1), speed, and backing off for half a second (on average every 10 / whim decisions)."""
    head_start: Count = 0
    """Number of decisions at the start for which it stands still."""

    reads: ClassVar[tuple[str, ...]] = ()
    """Names of the parameters that hold perception keys."""

    carried: ClassVar[tuple[str, ...]] = (
        "_speed_factor",
        "_error",
        "_backward",
        "_decisions_to_wait",
    )

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up its sensors."""
        self._sensors = {name: _sensor_of(agent, name, getattr(self, name)) for name in self.reads}
        self._scales = {
            name: sensor.scale() if sensor.normalized else 1.0
            for name, sensor in self._sensors.items()
        }

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Draw the episode's variation."""
        self._rng = view.random(f"{agent.id}/controller")
        self._speed_factor = 1.0 - self.whim * float(self._rng.random())
        self._error = 0.0
        self._backward = 0
        self._decisions_to_wait = self.head_start

    def get_action(self, percept: Percept) -> Answer:
        """Return the action towards its point: [forward, turn, jump, forward jump]."""
        if self._decisions_to_wait:
            self._decisions_to_wait -= 1
            return {self.actuator_name: (0.0, 0.0, 0.0, 0.0)}
        if self._rng.random() < NEW_ERROR_PROBABILITY:
            self._error = MAX_ERROR_RAD * self.whim * float(self._rng.uniform(-1, 1))
        if not self._backward and self._rng.random() < BACK_OFF_PROBABILITY * self.whim:
            self._backward = BACK_OFF_DECISIONS
        if self._backward:
            self._backward -= 1
            return {self.actuator_name: (-self.speed * self._speed_factor, self._error, 0.0, 0.0)}
        forward, left = spot = self.target_point(percept)
        angle = math.atan2(left, forward) + self._error
        speed_share = self.speed_share(percept, spot) * self._speed_factor
        return {
            self.actuator_name: steer(math.cos(angle), math.sin(angle), self.speed * speed_share)
        }

    def target_point(self, percept: Percept) -> LocalPoint:
        """Return the point to drive to."""
        raise NotImplementedError  # each driver has its own

    def speed_share(self, percept: Percept, target_point: LocalPoint) -> float:
        """Return the share of its speed at which to drive there."""
        return 1.0

    def read(self, percept: Percept, name: str) -> npt.NDArray[np.float64]:
        """Return the reading of one of its sensors, in the sensor's unit."""
        reading = np.asarray(percept[getattr(self, name)], np.float64)
        return reading * self._scales[name]

    def spot(self, percept: Percept, name: str) -> LocalPoint:
        """Return the target's position from a PositionSensor with ``frame="local"``."""
        forward, left, _ = self.read(percept, name).tolist()
        return forward, left


def steer(forward: float, left: float, speed: float = 1.0) -> tuple[float, float, float, float]:
    """Return an RBMoveActuator's action that turns to a point, and drives faster if it is ahead.

    >>> steer(0.0, 2.0)  # the point is to the left, so it only turns
    (0.0, -1.0, 0.0, 0.0)
    """
    angle = math.atan2(left, forward)
    ahead = round(max(0.0, math.cos(angle)), 6)
    return ahead * speed, max(-1.0, min(1.0, -2.0 * angle)), 0.0, 0.0


def _sensor_of(agent: AgentView, parameter: str, key: str) -> Sensor:
    sensors: dict[str, Any] = {
        sensor.perception_key: sensor for sensor in agent.sensors if sensor.is_active
    }
    if key not in sensors:
        raise BlockError(
            _(
                "{parameter}: no sensor has the perception_key {key!r}; {hint}",
                parameter=parameter,
                key=key,
                hint=suggest(key, sensors),
            )
        )
    found: Sensor = sensors[key]
    return found


def direction_to(start: Sequence[float], end: Sequence[float]) -> tuple[LocalPoint, float]:
    """Return the unit vector from one point to another, and their distance.

    >>> direction_to((1, 0), (1, 2))
    ((0.0, 1.0), 2.0)
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    distance = math.hypot(dx, dy)
    return (dx / distance, dy / distance) if distance else (1.0, 0.0), distance
