"""How fast the agent moves and turns."""

import math

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.parameters import PositiveMetres
from ai4u_edu.world import BodyView, WorldView


class VelocitySensor(Sensor):
    """[forward speed, leftward speed (m/s), turning speed (rad/s, counter-clockwise positive)].

    In the body's own frame, so it reads the same wherever the agent looks. What is faster than
    ``max_speed`` or ``max_turn`` reads as that.

    Reading: (3,). Source: ours.
    """

    max_speed: PositiveMetres = 20.0
    max_turn: PositiveMetres = 20.0
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
