"""A sensor of brightness."""

import math

from gymnasium.spaces import Box

from ai4u_edu.base.parameters import Degrees, Name, PositiveMetres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class LightSensor(Sensor):
    """Brightness on one side of the body: an eye for lamps, the bodies of a group.

    A lamp at distance d and at an angle a from the eye's direction adds
    ``cos(a) / (1 + (d / reach)²)``: half as much at ``reach`` as close by, less to the sides, and
    nothing from behind the eye. Nothing casts a shadow. Two of these sensors, one looking left and
    one right, are the eyes of Braitenberg's vehicles.

    Reading: (1,), 0 in the dark to 1. Source: ours, after V. Braitenberg, Vehicles (1984).
    """

    group: Name
    """Tag of the bodies that are lamps."""
    angle_deg: Degrees = 0.0
    """Direction of the eye, counter-clockwise from the heading."""
    reach: PositiveMetres = 5.0
    """Distance at which a lamp is half as bright as close by."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self._lamps: tuple[str, ...] = ()
        self._angle = math.radians(self.angle_deg)

    def space(self) -> Box:
        """Return the range 0..1."""
        return Box(0.0, 1.0, (1,))

    def slots(self) -> tuple[str, ...]:
        """Return the name of the number."""
        return ("brightness",)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the group."""
        view.check_group(self.group)
        self._lamps = view.named(self.group)

    def read(self, body: BodyView, view: WorldView) -> float:
        """Return the reading."""
        light = 0.0
        for name in self._lamps:
            lamp = view[name]
            if lamp.fallen or lamp is body:
                continue
            aside = math.cos(body.bearing(lamp) - self._angle)
            light += max(0.0, aside) / (1.0 + (body.distance(lamp) / self.reach) ** 2)
        return min(1.0, light)
