"""A contact sensor for all bodies of a group."""

from gymnasium.spaces import Box

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class GroupTouchSensor(Sensor):
    """+1 while the agent touches any body of the group (with that tag), else -1.

    For example, one bumper for all walls. Like a TouchSensor it reads the present contacts and is
    cleared at a reset.

    Reading: (1,), -1 or 1. Source: AI4U's GroupTouchSensor.
    """

    group: str
    """Tag of the bodies that count."""

    def space(self) -> Box:
        """Return the range -1..1."""
        return Box(-1.0, 1.0, (1,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the group."""
        view.check_group(self.group)

    def read(self, body: BodyView, view: WorldView) -> float:
        """Return the reading."""
        touched = any(self.group in view[name].tags for name in view.contacts(body))
        return 1.0 if touched else -1.0
