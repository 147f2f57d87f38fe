"""A contact sensor for one body or area."""

from gymnasium.spaces import Box

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class TouchSensor(Sensor):
    """+1 while the agent touches the target, else -1: a bumper for one target.

    The target is a body, or an area (which the agent touches with its centre). It reads the present
    contacts: a touch that began and ended between two decisions is missed. A reset clears it; a
    touch from the start is read after the first tick.

    Reading: (1,), -1 or 1. Source: AI4U's TouchSensor, whose contacts outlive a reset.
    """

    target: str
    """Name of the body or area."""

    def space(self) -> Box:
        """Return the range -1..1."""
        return Box(-1.0, 1.0, (1,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target."""
        view.check_target(self.target)

    def read(self, body: BodyView, view: WorldView) -> float:
        """Return the reading."""
        return 1.0 if view.touching(body, self.target) else -1.0
