"""A bumper for one body or area."""

from gymnasium.spaces import Box

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class TouchSensor(Sensor):
    """+1 while the agent touches the target, else -1: a bumper that knows one thing.

    The target is a body, or an area (which is touched with the agent's centre). The reading is of
    this moment: a touch that began and ended between two decisions is not felt. A reset clears it;
    what is touched from the start is felt after the first tick.

    Reading: (1,), -1 or 1. Source: AI4U's TouchSensor, whose contacts outlive a reset.
    """

    target: str
    """Name of the body or area that is felt."""

    def space(self) -> Box:
        """-1 or 1."""
        return Box(-1.0, 1.0, (1,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Looks the target up."""
        view.check_target(self.target)

    def read(self, body: BodyView, view: WorldView) -> float:
        """One reading."""
        return 1.0 if view.touching(body, self.target) else -1.0
