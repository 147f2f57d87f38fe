"""A sensor of solid ground."""

from gymnasium.spaces import Box

from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class GroundStatusSensor(Sensor):
    """+1 while the agent stands on a floor or on another body, -1 in the air.

    In the air no actuator moves it: so this is whether an action can do anything now.

    Reading: (1,), -1 or 1. Source: AI4U's GroundStatusSensor, which asks a move actuator; here the
    body knows.
    """

    def space(self) -> Box:
        """-1 or 1."""
        return Box(-1.0, 1.0, (1,))

    def read(self, body: BodyView, view: WorldView) -> float:
        """One reading."""
        return 1.0 if body.on_ground else -1.0
