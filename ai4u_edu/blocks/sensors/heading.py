"""A sensor of the heading."""

import math

from gymnasium.spaces import Box

from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class HeadingSensor(Sensor):
    """[sine, cosine] of the heading, counter-clockwise from the world's x axis: a compass.

    Looking along +x (right on the screen) reads [0, 1], along +y (up) [1, 0]. These are two numbers
    because one angle would jump from 180 to -180 degrees between two neighbouring headings.

    Reading: (2,), each -1..1. Source: ours.
    """

    def space(self) -> Box:
        """Return the range of sine and cosine."""
        return Box(-1.0, 1.0, (2,))

    def slots(self) -> tuple[str, ...]:
        """Return the names of the two numbers."""
        return "sine", "cosine"

    def read(self, body: BodyView, view: WorldView) -> tuple[float, float]:
        """Return the reading."""
        heading = body.heading
        return math.sin(heading), math.cos(heading)
