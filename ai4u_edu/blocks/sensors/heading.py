"""A compass."""

import math

from gymnasium.spaces import Box

from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class HeadingSensor(Sensor):
    """[sine, cosine] of the heading, counter-clockwise from the world's x axis: a compass.

    Looking along +x (right on the screen) reads [0, 1], along +y (up) [1, 0]. Two numbers instead
    of one angle: an angle jumps from 180 to -180 degrees between two headings that are neighbours.

    Reading: (2,), each -1..1. Source: ours.
    """

    def space(self) -> Box:
        """[sine, cosine]."""
        return Box(-1.0, 1.0, (2,))

    def slots(self) -> tuple[str, ...]:
        """Sine and cosine."""
        return "sine", "cosine"

    def read(self, body: BodyView, view: WorldView) -> tuple[float, float]:
        """One reading."""
        heading = body.heading
        return math.sin(heading), math.cos(heading)
