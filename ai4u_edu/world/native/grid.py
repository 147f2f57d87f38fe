"""The grid in perspective, worked out by the compiled part: cell by cell what ray_grid.py does."""

from collections.abc import Mapping, Sequence
from struct import Struct
from typing import TYPE_CHECKING, Any

import numpy as np

from ai4u_edu.world.body import BodyView
from ai4u_edu.world.native.chipmunk import c_function
from ai4u_edu.world.native.segments import CompiledSegments
from ai4u_edu.world.region import Region
from ai4u_edu.world.shapes import (
    BoxShape,
    CapsuleShape,
    CircleShape,
    PolygonShape,
    RegionShape,
    RingShape,
)

if TYPE_CHECKING:
    from ai4u_edu.world.ray_grid import RayGrid

_GRID, _FLOOR = Struct("=4q10Qd3Q"), Struct("=2q8dQ")  # Grid and Floor in rays.c
_LOOK = "long long (*)(void *, double, double, double, double, double)"


def compiled_grid(grid: "RayGrid") -> "CompiledGrid | None":
    """The quick way for a grid; None where nothing is compiled."""
    rays, look = grid._segments, c_function("look", _LOOK)
    return CompiledGrid(grid, rays, look) if isinstance(rays, CompiledSegments) and look else None


class CompiledGrid:
    """Fills the codes and distances of a grid.

    Args:
        grid: whose, ready but for this.
        rays: its columns.
        look: the function that does it.

    Attributes:
        undecided: (m, n) bool: which rays may meet more than what stands first in their column.
    """

    def __init__(self, grid: "RayGrid", rays: CompiledSegments, look: Any) -> None:
        self._grid, self._rays, self._look = grid, rays, look
        self.undecided = np.zeros(grid.codes.shape, np.bool_)
        self._movers: list[tuple[int, BodyView]] = []

    def learn(
        self,
        bodies: Mapping[int, BodyView],
        codes: Mapping[int, float],
        grounds: Sequence[tuple[float, Region | None, float]],
    ) -> None:
        """Lays out what is in the world, after each build of it.

        Args:
            bodies: by the key of each of their shapes.
            codes: by the same keys.
            grounds: top, region (None for endless ground) and code of each floor.
        """
        floors = bytearray()
        self._kept: list[Any] = [floors]
        for top, region, code in grounds:
            floors += self._floor(top, region, code)
        shapes = np.array(list(bodies), np.uint64)
        self._things = np.array(
            [(each.z, each.z + each.height, codes[key]) for key, each in bodies.items()]
        ).reshape(-1, 3)
        self._movers = [(i, each) for i, each in enumerate(bodies.values()) if each.moves]
        self._heights: Any = self._things.reshape(-1).data
        grid, where = self._grid, self._address
        pitched = (grid._slopes, grid._runs, grid._reaches, grid._cos)
        self._job = _GRID.pack(
            *grid.codes.shape,
            len(grounds),
            len(bodies),
            *map(where, pitched),
            *self._rays.addresses(),
            where(np.frombuffer(floors, np.uint8)),
            where(shapes),
            where(self._things),
            grid._miss,
            *map(where, (grid.codes, grid.distances, self.undecided)),
        )

    def look(self, eye: tuple[float, float, float], bottom: float, ceiling: float) -> bool:
        """Fills codes and distances.

        Args:
            eye: where it is, metres.
            bottom: from which height something may stand behind what is first...
            ceiling: ... to which.

        Returns:
            Whether all is done; else there are some ``undecided``, and all distances are still
            those in the plane, infinite for nothing.
        """
        heights = self._heights
        for i, body in self._movers:  # all else is where it was when the world was built
            heights[3 * i] = z = body.z
            heights[3 * i + 1] = z + body.height
        return not self._look(self._job, *eye, bottom, ceiling)

    def _floor(self, top: float, region: Region | None, code: float) -> bytes:
        if region is None:  # endless ground
            return _FLOOR.pack(0, 0, top, code, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0)
        shape = region.description.shape
        kind, a, b = _lengths(shape)
        corners = np.array(shape.vertices if isinstance(shape, PolygonShape) else [(0.0, 0.0)])
        place = region.x, region.y, region._cos, region._sin
        return _FLOOR.pack(kind, len(corners), top, code, *place, a, b, self._address(corners))

    def _address(self, array: Any) -> int:
        """Where an array lies; it stays there as long as this is kept."""
        self._kept.append(array)
        where: int = array.ctypes.data
        return where


def _lengths(shape: RegionShape) -> tuple[int, float, float]:
    """Which shape it is, and its lengths, as rays.c has them."""
    match shape:
        case CircleShape():
            return 1, shape.radius, 0.0
        case BoxShape():
            return 2, *shape.size
        case PolygonShape():
            return 3, 0.0, 0.0
        case CapsuleShape():
            return 4, shape.length, shape.radius
        case RingShape():
            return 5, shape.inner, shape.outer
