"""DriverRegistry that know where they want to go: towards a point, with a little whim."""

import math
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.errors import BlockError, suggest
from ai4u_edu.base.parameters import Count, quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.command import Answer
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.brains.controllers.wasd import Amount
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import WorldView

Spot = tuple[float, float]
"""A place in the agent's own frame: (forward, left), metres."""

LONGEST_ERROR = math.radians(40)
"""How far beside its aim a driver of whim 1 may look."""
NEW_WHIM = 0.1
"""The chance that a decision is taken with another error than the one before."""
BACKS_OFF = 0.1
"""The chance that a driver of whim 1 begins to back off: so that nobody pushes for ever."""
BACKWARD = 6
"""So many decisions long."""


class SteeringController(Controller):
    """What scripted drivers share: each says at every decision to which point it wants to go.

    Where its sensors are is told by their perception keys. What a sensor normalises is measured in
    metres again here.
    """

    abstract = True

    actuator_name: str = "move"
    """Action name of its RBMoveActuator."""
    speed: Amount = 1.0
    """Forward number at full speed, as a share of full power."""
    whim: Annotated[float, quantity("1", ge=0, le=1)] = 0.2
    """How much it varies, by the world's seed: its aim (by up to 40 degrees at 1), its speed, and
    how often it backs off for half a second (ten times as many decisions apart as 1 / whim)."""
    head_start: Count = 0
    """Count of decisions for which it stands still at first."""

    reads: ClassVar[tuple[str, ...]] = ()
    """The parameters that hold perception keys."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look its sensors up."""
        self._sensors = {name: _sensor_of(agent, name, getattr(self, name)) for name in self.reads}
        self._scales = {
            name: sensor.scale() if sensor.normalized else 1.0
            for name, sensor in self._sensors.items()
        }

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Draws how it feels in this episode."""
        self._rng = view.random(f"{agent.id}/controller")
        self._vigour = 1.0 - self.whim * float(self._rng.random())
        self._error = 0.0
        self._backward = 0
        self._waits = self.head_start

    def get_action(self, percept: Percept) -> Answer:
        """Towards where it wants to go: [forward, turn, jump, forward jump]."""
        if self._waits:
            self._waits -= 1
            return {self.actuator_name: (0.0, 0.0, 0.0, 0.0)}
        if self._rng.random() < NEW_WHIM:
            self._error = LONGEST_ERROR * self.whim * float(self._rng.uniform(-1, 1))
        if not self._backward and self._rng.random() < BACKS_OFF * self.whim:
            self._backward = BACKWARD
        if self._backward:
            self._backward -= 1
            return {self.actuator_name: (-self.speed * self._vigour, self._error, 0.0, 0.0)}
        forward, left = spot = self.wish(percept)
        angle = math.atan2(left, forward) + self._error
        effort = self.effort(percept, spot) * self._vigour
        return {self.actuator_name: steer(math.cos(angle), math.sin(angle), self.speed * effort)}

    def wish(self, percept: Percept) -> Spot:
        """To which point it wants to go."""
        raise NotImplementedError  # each driver has its own

    def effort(self, percept: Percept, wish: Spot) -> float:
        """With which share of its speed it goes there."""
        return 1.0

    def read(self, percept: Percept, name: str) -> npt.NDArray[np.float64]:
        """The reading of one of its sensors, in the sensor's own unit."""
        reading = np.asarray(percept[getattr(self, name)], np.float64)
        return reading * self._scales[name]

    def spot(self, percept: Percept, name: str) -> Spot:
        """Where a PositionSensor with ``frame="local"`` says that its target is."""
        forward, left, _ = self.read(percept, name).tolist()
        return forward, left


def steer(forward: float, left: float, speed: float = 1.0) -> tuple[float, float, float, float]:
    """An RBMoveActuator's action that turns to a point, and drives the more the more it is ahead.

    >>> steer(0.0, 2.0)  # to the left, so no way forward yet
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
            f"{parameter}: no sensor has the perception_key {key!r}; {suggest(key, sensors)}"
        )
    found: Sensor = sensors[key]
    return found


def towards(start: Sequence[float], end: Sequence[float]) -> tuple[Spot, float]:
    """The direction from one spot to another, of length 1, and how far it is.

    >>> towards((1, 0), (1, 2))
    ((0.0, 1.0), 2.0)
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    distance = math.hypot(dx, dy)
    return (dx / distance, dy / distance) if distance else (1.0, 0.0), distance
