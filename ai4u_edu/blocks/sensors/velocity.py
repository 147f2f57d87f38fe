"""A sensor of the agent's own velocity."""

import math
from typing import Annotated

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class VelocitySensor(Sensor):
    """[forward speed, leftward speed (m/s), turning speed (rad/s, counter-clockwise positive)].

    The velocity is in the body's own frame, so it doesn't depend on the heading. It is clipped to
    ``max_speed`` and ``max_turn``.

    Reading: (3,), each up to ``max_speed`` or ``max_turn`` in both directions; with ``normalized``
    -1..1, as a share of these. Source: ours.
    """

    max_speed: Annotated[float, quantity("m/s", gt=0, le=1e4)] = 20.0
    """Largest speed that is read, forward and sideways."""
    max_turn: Annotated[float, quantity("rad/s", gt=0, le=1e4)] = 20.0
    """Largest turning speed that is read."""
    unit = "m/s, m/s, rad/s"

    def space(self) -> Box:
        """Return the ranges of [forward, left, turning]."""
        high = np.array([self.max_speed, self.max_speed, self.max_turn], np.float32)
        return Box(-high, high)

    def slots(self) -> tuple[str, ...]:
        """Return the names of the numbers, in the body's own frame."""
        return "forward", "left", "turning"

    def read(self, body: BodyView, view: WorldView) -> tuple[float, float, float]:
        """Return the reading."""
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
