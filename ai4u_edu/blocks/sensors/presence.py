"""A sensor of the bodies of a group that are still in the world."""

from gymnasium.spaces import Box

from ai4u_edu.base.parameters import Name
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class PresenceSensor(Sensor):
    """A number for each body of the group: 1 while it is in the world, 0 while it is gone.

    A body is gone when it was collected or fell out. Its position then stays the last one it had,
    so this sensor tells which positions are still valid. The bodies are in the scene's order. Their
    distance and visibility have no effect.

    Reading: (n,) for n bodies, each 0 or 1. Source: ours.
    """

    group: Name
    """Tag of the bodies that are counted."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self._names: tuple[str, ...] = ("",)

    def space(self) -> Box:
        """Return the range 0..1 for each body."""
        return Box(0.0, 1.0, (len(self._names),))

    def slots(self) -> tuple[str, ...]:
        """Return the bodies' names."""
        return self._names

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the group."""
        view.check_group(self.group)
        self._names = view.named(self.group)

    def read(self, body: BodyView, view: WorldView) -> list[float]:
        """Return the reading."""
        return [0.0 if view[name].fallen else 1.0 for name in self._names]
