"""A sensor of a line on the ground."""

from typing import Annotated

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.base.parameters import Metres, Name, NonNegativeMetres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.pictures import SpotPicture
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import AreaDescription, BodyView, WorldView
from ai4u_edu.world.pictures import OPAQUE, are_dark


class LineSensor(Sensor):
    """A row of eyes that look down at the ground: 1 on the line, 0 beside it.

    ``points`` eyes sit on a bar, ``ahead`` of the body's centre and square to its heading. The bar
    is ``width`` long, with the first eye at its left end and the last at its right. Each eye looks
    straight down at one point. The line consists of the areas with the tag ``group``, of all that
    is dark in a picture on the ground, and of all ink that pens have drawn; bodies on it do not
    hide it.

    A robot that drives along a line reads [0, 0, 1, 0, 0]; when it reads [0, 1, 0, 0, 0], the line
    is a bit to the left. Far from the line all numbers are 0, on either side: to find it again, an
    agent has to remember (or to stack readings).

    Reading: (points,), each 0 or 1. Source: ours; after the line sensors of small robots, which
    measure how much light the ground reflects.
    """

    group: Name = "line"
    """The tag of the areas that are the line; there need be none for ink and pictures."""
    points: Annotated[int, Field(ge=1, le=64)] = 5
    """Number of eyes on the bar."""
    ahead: Metres = 0.4
    """Distance of the bar in front of the body's centre; negative: behind it."""
    width: NonNegativeMetres = 0.6
    """Length of the bar, from the first eye to the last."""

    def space(self) -> Box:
        """Return the range 0..1 for each point."""
        return Box(0.0, 1.0, (self.points,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the areas of the line."""
        tags = {tag: None for area in view.areas.values() for tag in area.tags}
        if self.group not in tags and self.group != LineSensor.group:  # a misspelt one
            raise NameNotFoundError(
                _(
                    "no area carries the tag {group}; {hint}",
                    group=repr(self.group),
                    hint=suggest(self.group, tags),
                )
            )
        left = np.linspace(0.5, -0.5, self.points) if self.points > 1 else np.zeros(1)
        self._left = left * self.width
        self._reach = float(np.hypot(self.ahead, self.width / 2))
        self._built_for = -1
        nowhere = np.zeros(self.points)
        self._seen = nowhere, nowhere, 0.0, nowhere.astype(np.bool_)

    def read(self, body: BodyView, view: WorldView) -> npt.NDArray[np.bool_]:
        """Return the reading."""
        if self._built_for != view.generation:
            self._build(view)
        (x, y), heading = body.position, body.heading
        cos, sin = np.cos(heading), np.sin(heading)
        xs = x + cos * self.ahead - sin * self._left
        ys = y + sin * self.ahead + cos * self._left
        on_it = np.zeros(self.points, np.bool_)
        # a line has many areas, of which one or two are near
        for index in np.flatnonzero(np.hypot(self._x - x, self._y - y) <= self._far):
            on_it |= self._line[index].contains_each(xs, ys)
        if self._pictures:
            on_it |= self._dark_in_pictures(xs, ys)
        ink = view.ink
        if ink:
            on_it |= np.fromiter(map(ink.at, xs, ys), np.bool_, self.points)
        self._seen = xs, ys, body.z, on_it
        return on_it

    def spots(self) -> SpotPicture:
        """Return the points at which the eyes looked in the last reading."""
        xs, ys, z, on_it = self._seen
        places = np.column_stack([xs, ys, np.full(self.points, z)])
        return SpotPicture(places, tuple(on_it.tolist()))

    def _dark_in_pictures(
        self, xs: npt.NDArray[np.float64], ys: npt.NDArray[np.float64]
    ) -> npt.NDArray[np.bool_]:
        """Return True where the uppermost of all pictures and paint is a picture, and dark."""
        dark = np.zeros(self.points, np.bool_)
        for area, is_picture in self._pictures:
            if is_picture:
                pixels = area.picture_at(xs, ys)
                seen = pixels[:, 3] >= OPAQUE
                dark = np.where(seen, are_dark(pixels), dark)
            else:
                dark &= ~area.contains_each(xs, ys)
        return dark

    def _build(self, view: WorldView) -> None:
        self._built_for = view.generation
        described = [
            (area, area.description)
            for area in view.areas.values()
            if isinstance(area.description, AreaDescription)
        ]
        pictures = {area.name for area, each in described if each.picture is not None}
        self._line = [
            area for area, _ in described if self.group in area.tags and area.name not in pictures
        ]
        flat = [(area, area.name in pictures) for area, each in described if each.is_flat]
        self._pictures = sorted(flat, key=lambda pair: not pair[1]) if pictures else []
        """Pictures, and paint that may lie on them, the lowest first; True for pictures."""
        self._x = np.array([piece.x for piece in self._line])
        self._y = np.array([piece.y for piece in self._line])
        reaches = np.array([piece.description.shape.reach for piece in self._line])
        self._far = reaches + self._reach
