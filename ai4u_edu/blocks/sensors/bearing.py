"""A sensor of the direction to a target."""

import math

from gymnasium.spaces import Box

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class BearingSensor(Sensor):
    """[sine, cosine] of the angle to the target, counter-clockwise from the heading.

    The sine is positive if the target is to the left, negative to the right: two numbers tell all
    directions apart, one cosine can't.

    Reading: (2,), each -1..1. Source: ours.
    """

    target: str
    """Name of the body whose direction is read."""

    def space(self) -> Box:
        """Return the range of sine and cosine."""
        return Box(-1.0, 1.0, (2,))

    def slots(self) -> tuple[str, ...]:
        """Return the names of the two numbers."""
        return "sine", "cosine"

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target."""
        _ = view[self.target]

    def read(self, body: BodyView, view: WorldView) -> tuple[float, float]:
        """Return the reading."""
        angle = body.bearing(view[self.target])
        return math.sin(angle), math.cos(angle)
