"""Floors and areas in world coordinates, and the ground that the floors form."""

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.world.descriptions import AreaDescription, RegionDescription
from ai4u_edu.world.pictures import Pixels, decode_picture
from ai4u_edu.world.shapes import BoxShape

SAME_HEIGHT_M = 1e-9
"""Heights closer than this (metres) count as equal."""

_RIM_M = 1e-6
"""Width of a floor's rim (metres) that is looked at exactly: more than any rounding error."""

Inside = tuple[float, float, float, float]
"""Left, right, lower and upper limit of a rectangle, metres."""


class Region:
    """A floor or an area in world coordinates.

    Args:
        description: kept as ``description``.
    """

    def __init__(self, description: RegionDescription) -> None:
        self.description = description
        self.name = description.name
        self.tags = description.tags
        self.x, self.y = description.position
        heading = math.radians(description.heading_deg)
        self.cos, self.sin = math.cos(heading), math.sin(heading)
        self._contains: Callable[[Any, Any], Any] = description.shape.contains
        shape = description.shape
        self.box = shape.size if isinstance(shape, BoxShape) and heading == 0.0 else None

    def contains(self, x: float, y: float) -> bool:
        """Return True if a point of the world (metres) lies in the region or on its rim."""
        if self.box is not None:
            return 2 * abs(x - self.x) <= self.box[0] and 2 * abs(y - self.y) <= self.box[1]
        inside: bool = self._contains(*self._to_local(x, y))
        return inside

    def contains_each(
        self, x: npt.NDArray[np.float64], y: npt.NDArray[np.float64]
    ) -> npt.NDArray[np.bool_]:
        """Return :meth:`contains` for many points, given as arrays of the same shape."""
        if self.box is not None:
            a, b = self.box
            upright: npt.NDArray[np.bool_] = np.abs(x - self.x) * 2 <= a
            upright &= np.abs(y - self.y) * 2 <= b
            return upright
        inside: npt.NDArray[np.bool_] = self._contains(*self._to_local(x, y))
        return inside

    def picture_at(self, x: npt.NDArray[np.float64], y: npt.NDArray[np.float64]) -> Pixels:
        """Return what an area's picture shows at points of the world (metres).

        Returns:
            Red, green, blue and opacity, of shape (n, 4); 0 beside the picture, or if there is
            none.
        """
        seen = np.zeros((len(x), 4), np.uint8)
        described = self.description
        if not isinstance(described, AreaDescription) or described.picture is None:
            return seen
        length, width = described.shape.size if isinstance(described.shape, BoxShape) else (1, 1)
        pixels = decode_picture(described.picture)
        rows, columns, _ = pixels.shape
        u, v = self._to_local(x, y)
        column = np.floor((u / length + 0.5) * columns).astype(np.int64)
        row = np.floor((0.5 - v / width) * rows).astype(np.int64)
        inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
        seen[inside] = pixels[row[inside], column[inside]]
        return seen

    def outline(self) -> list[tuple[float, float]]:
        """Return the rim in world coordinates, counter-clockwise."""
        return self.placed(self.description.shape.outline())

    def placed(self, points: list[tuple[float, float]]) -> list[tuple[float, float]]:
        """Return points of the region's own frame in world coordinates."""
        return [
            (self.x + self.cos * x - self.sin * y, self.y + self.sin * x + self.cos * y)
            for x, y in points
        ]

    def _to_local(self, x: Any, y: Any) -> tuple[Any, Any]:
        dx, dy = x - self.x, y - self.y
        return self.cos * dx + self.sin * dy, self.cos * dy - self.sin * dx


class Ground:
    """Floors sorted by height; without any, the ground is endless at height 0.

    Args:
        floors: top (metres) and region of each.
    """

    def __init__(self, floors: Iterable[tuple[float, Region]] = ()) -> None:
        self.floors = sorted(floors, key=lambda pair: -pair[0])
        self._insides = list(self._find_insides())

    def at(self, x: float, y: float, below: float = float("inf")) -> float | None:
        """Return the highest floor at a place that is not above ``below``; None over the void."""
        if not self.floors:
            return 0.0 if below >= -SAME_HEIGHT_M else None
        for top, region in self.floors:
            if top <= below + SAME_HEIGHT_M and region.contains(x, y):
                return top
        return None

    def inside(self, x: float, y: float, z: float) -> Inside | None:
        """Return a rectangle around a place in which :meth:`at` of ``z`` is ``z`` everywhere.

        Most floors are boxes that are not turned, and each body on them asks at each tick whether
        it still stands there. Other floors, and a floor's rim, give None.
        """
        for top, inside in self._insides:
            if top == z and inside[0] < x < inside[1] and inside[2] < y < inside[3]:
                return inside
        return None

    def _find_insides(self) -> Iterator[tuple[float, Inside]]:
        for top, region in self.floors:
            # at() would give the top of a floor that is higher by a rounding error
            is_highest = not any(top < other <= top + SAME_HEIGHT_M for other, _ in self.floors)
            if region.box and is_highest:
                (x, y), (width, depth) = (region.x, region.y), region.box
                across, along = width / 2 - _RIM_M, depth / 2 - _RIM_M
                yield top, (x - across, x + across, y - along, y + along)
