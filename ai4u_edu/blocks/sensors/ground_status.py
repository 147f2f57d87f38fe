"""A sensor of ground contact."""

from gymnasium.spaces import Box

from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class GroundStatusSensor(Sensor):
    """+1 while the agent stands on a floor or on another body, -1 in the air.

    In the air no actuator moves the agent, so the reading tells if an action has an effect now.

    Reading: (1,), -1 or 1. Source: AI4U's GroundStatusSensor, which asks a move actuator; here the
    body knows.
    """

    def space(self) -> Box:
        """Return the range -1..1."""
        return Box(-1.0, 1.0, (1,))

    def read(self, body: BodyView, view: WorldView) -> float:
        """Return the reading."""
        return 1.0 if body.on_ground else -1.0
