"""A sensor of the colour of the ground."""

import math

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.base.colors import FLOOR_RGB, rgb
from ai4u_edu.base.parameters import Metres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.pictures import SpotPicture
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import AreaDescription, BodyView, Region, WorldView
from ai4u_edu.world.ink import INK_COLOURS, NO_INK
from ai4u_edu.world.pictures import OPAQUE

_LUMA = 0.299, 0.587, 0.114
"""Shares of red, green and blue in brightness, as in television (ITU-R BT.601)."""


class ColourSensor(Sensor):
    """An eye that looks down at one point of the ground: [red, green, blue, brightness].

    It sees ink that a PenActuator has drawn; where there is none, painted areas; where there is
    none, pictures on the ground; and else the floor. Over the void all numbers are 0. Bodies hide
    nothing: the eye is under the robot.

    Reading: (4,), each 0..1. White is [1, 1, 1, 1], black [0, 0, 0, 0]. Source: ours; after the
    colour sensors of small robots.
    """

    ahead: Metres = 0.4
    """Distance of the point in front of the body's centre; negative: behind it."""
    left: Metres = 0.0
    """Distance of the point to the left of the body's centre; negative: to the right."""

    def space(self) -> Box:
        """Return the range 0..1 for each number."""
        return Box(0.0, 1.0, (4,))

    def slots(self) -> tuple[str, ...]:
        """Return the names of the numbers."""
        return ("red", "green", "blue", "brightness")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Prepare to look the ground up."""
        self._built_for = -1
        self._seen = 0.0, 0.0, 0.0, False

    def read(self, body: BodyView, view: WorldView) -> tuple[float, ...]:
        """Return the reading."""
        if self._built_for != view.generation:
            self._build(view)
        (x, y), heading = body.position, body.heading
        cos, sin = math.cos(heading), math.sin(heading)
        x, y = x + cos * self.ahead - sin * self.left, y + sin * self.ahead + cos * self.left
        colour, is_marked = self._colour_at(x, y, view)
        self._seen = x, y, body.z, is_marked
        red, green, blue = (number / 255 for number in colour)
        luma = _LUMA[0] * red + _LUMA[1] * green + _LUMA[2] * blue
        return red, green, blue, min(luma, 1.0)

    def spots(self) -> SpotPicture:
        """Return the point at which it looked; it is lit on ink, paint or a picture."""
        x, y, z, is_marked = self._seen
        return SpotPicture(np.array([[x, y, z]]), (is_marked,))

    def _colour_at(self, x: float, y: float, view: WorldView) -> tuple[tuple[int, int, int], bool]:
        code = view.ink.at(x, y)
        if code != NO_INK:
            return rgb(INK_COLOURS[code - 1]), True
        if view.ground(x, y) is None:
            return (0, 0, 0), False
        for area, colour in self._painted:
            if colour is None:
                pixel = area.picture_at(np.array([x]), np.array([y]))[0]
                if pixel[3] >= OPAQUE:
                    return (int(pixel[0]), int(pixel[1]), int(pixel[2])), True
            elif area.contains(x, y):
                return colour, True
        name = view.ink.floor_at(x, y)
        return self._floors.get(name or "", FLOOR_RGB), False

    def _build(self, view: WorldView) -> None:
        self._built_for = view.generation
        painted: list[tuple[Region, tuple[int, int, int] | None]] = []
        for area in view.areas.values():
            described = area.description
            if isinstance(described, AreaDescription) and described.is_flat:
                colour = None if described.picture else rgb(described.colour or "green")
                painted.append((area, colour))
        highest_first = painted[::-1]
        self._painted = [pair for pair in highest_first if pair[1] is not None]
        self._painted += [pair for pair in highest_first if pair[1] is None]  # under all paint
        self._floors = {each.name: rgb(each.colour) for each in view.floors if each.colour}
