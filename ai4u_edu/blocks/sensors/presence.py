"""A sensor of which bodies of a group are still there."""

from gymnasium.spaces import Box

from ai4u_edu.base.parameters import Name
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class PresenceSensor(Sensor):
    """A number for each body of the group: 1 while it is in the world, 0 while it is gone.

    Gone is what was collected, or fell out. A position of something that is gone is the last one
    that it had, so this tells which positions still count. The bodies stand in the order in which
    the scene names them; wherever they are, near or far, seen or hidden.

    Reading: (n,) for n bodies, each 0 or 1. Source: ours.
    """

    group: Name
    """Tag of the bodies that are counted."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self._names: tuple[str, ...] = ("",)

    def space(self) -> Box:
        """0 or 1 for each."""
        return Box(0.0, 1.0, (len(self._names),))

    def slots(self) -> tuple[str, ...]:
        """The bodies' names."""
        return self._names

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Looks the group up."""
        view.check_group(self.group)
        self._names = view.named(self.group)

    def read(self, body: BodyView, view: WorldView) -> list[float]:
        """One reading."""
        return [0.0 if view[name].fallen else 1.0 for name in self._names]
