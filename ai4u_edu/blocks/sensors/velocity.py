"""A sensor of the agent's own speeds."""

import math
from typing import Annotated

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class VelocitySensor(Sensor):
    """[forward speed, leftward speed (m/s), turning speed (rad/s, counter-clockwise positive)].

    In the body's own frame, so it reads the same wherever the agent looks. What is faster than
    ``max_speed`` or ``max_turn`` reads as that.

    Reading: (3,), each up to ``max_speed`` or ``max_turn`` to either side; with ``normalized``
    -1..1, as a share of those. Source: ours.
    """

    max_speed: Annotated[float, quantity("m/s", gt=0, le=1e4)] = 20.0
    """Largest speed that is told, forward and sideways."""
    max_turn: Annotated[float, quantity("rad/s", gt=0, le=1e4)] = 20.0
    """Largest turning speed that is told."""
    unit = "m/s, m/s, rad/s"

    def space(self) -> Box:
        """[forward, left, turning]."""
        high = np.array([self.max_speed, self.max_speed, self.max_turn], np.float32)
        return Box(-high, high)

    def slots(self) -> tuple[str, ...]:
        """Speeds in the body's own frame."""
        return "forward", "left", "turning"

    def read(self, body: BodyView, view: WorldView) -> tuple[float, float, float]:
        """One reading."""
        vx, vy = body.velocity
        heading = body.heading
        cos, sin = math.cos(heading), math.sin(heading)
        return (
            _limit(cos * vx + sin * vy, self.max_speed),
            _limit(cos * vy - sin * vx, self.max_speed),
            _limit(body.angular_velocity, self.max_turn),
        )


def _limit(value: float, largest: float) -> float:
    return max(-largest, min(largest, value))
