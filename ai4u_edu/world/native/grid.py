"""The compiled form of the perspective ray grid; same bits as RayGrid in rays.py, cell by cell."""

from collections.abc import Mapping, Sequence
from struct import Struct
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt
import pymunk

from ai4u_edu.world.native.chipmunk import compiled_function
from ai4u_edu.world.native.segments import CompiledSegments, Segments, query_address
from ai4u_edu.world.region import Region
from ai4u_edu.world.shapes import (
    BoxShape,
    CapsuleShape,
    CircleShape,
    PolygonShape,
    RegionShape,
    RingShape,
)

_GRID, _FLOOR = Struct("=4q10Qd3Q"), Struct("=2q8dQ")  # Grid and Floor in rays.c
_BEHIND = Struct("=3QdQ")  # Behind in rays.c
_LOOK = "long long (*)(void *, double, double, double, double, double)"
_LOOK_BEHIND = "void (*)(void *, void *, void *, double, double, double)"

Floats = npt.NDArray[np.float64]


class _Solid(Protocol):
    """Protocol of a body that rays may meet."""

    z: float
    height: float

    @property
    def moves(self) -> bool:
        """True if it may have another height at the next cast."""


class GridArrays(NamedTuple):
    """Arrays of a grid of m pitches and n angles; the last two are filled by a cast."""

    slopes: Floats
    """(m,) tangent of each pitch."""
    runs: Floats
    """(m,) 1 / slope; NaN for level rays."""
    reaches: Floats
    """(m,) reach in the plane, metres."""
    cosines: Floats
    """(m, 1) cosine of each pitch."""
    codes: Floats
    """(m, n) code of each ray's hit."""
    distances: Floats
    """(m, n) metres along the ray."""


def compile_grid(
    arrays: GridArrays, columns: Segments, reach: float, miss: float
) -> "CompiledGrid | None":
    """Return the compiled form of a grid; None where the library is missing.

    Args:
        arrays: the grid's arrays.
        columns: the segments that its columns cast in the plane.
        reach: their length, metres.
        miss: code of a ray that meets nothing.
    """
    look = compiled_function("look", _LOOK)
    look_behind = compiled_function("look_behind", _LOOK_BEHIND)
    if not isinstance(columns, CompiledSegments) or look is None or look_behind is None:
        return None
    return CompiledGrid(arrays, columns, reach, miss, look, look_behind)


class CompiledGrid:
    """Fills the codes and distances of a grid; made by :func:`compile_grid`.

    One call decides all rays by the first body of their column; a second one those that may meet
    another body behind or on top of it.
    """

    def __init__(
        self,
        arrays: GridArrays,
        columns: CompiledSegments,
        reach: float,
        miss: float,
        look: Any,
        look_behind: Any,
    ) -> None:
        undecided = np.zeros(arrays.codes.shape, np.bool_)
        self._own = arrays, columns, undecided  # kept alive, since C has their addresses
        self._reach, self._miss, self._look, self._look_behind = reach, miss, look, look_behind
        # a reset packs them again, and to ask an array for its address takes a microsecond
        self._inputs = (*map(_address, arrays[:4]), *columns.arrays)
        self._outputs = (*map(_address, (arrays.codes, arrays.distances, undecided)),)
        self._queries = query_address("cpSpaceSegmentQuery"), query_address("cpShapeSegmentQuery")
        self._movers: list[tuple[int, _Solid]] = []

    def update(
        self,
        bodies: Mapping[int, _Solid],
        codes: Mapping[int, float],
        grounds: Sequence[tuple[float, Region | None, float]],
    ) -> None:
        """Pack the contents of the world for the compiled function, after each change of them.

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
        self._heights_and_codes = np.array(
            [(each.z, each.z + each.height, codes[key]) for key, each in bodies.items()]
        ).reshape(-1, 3)
        self._movers = [(i, each) for i, each in enumerate(bodies.values()) if each.moves]
        self._heights: Any = self._heights_and_codes.reshape(-1).data
        (arrays, columns, _), where = self._own, self._kept_address
        self._job = _GRID.pack(
            *arrays.codes.shape,
            len(grounds),
            len(bodies),
            *self._inputs,
            where(np.frombuffer(floors, np.uint8)),
            where(shapes),
            where(self._heights_and_codes),
            self._miss,
            *self._outputs,
        )
        obstacles = where(np.zeros((len(bodies), 5)))
        self._behind = _BEHIND.pack(*self._queries, columns.address, self._reach, obstacles)

    def cast(
        self, space: pymunk.Space, eye: tuple[float, float, float], bottom: float, ceiling: float
    ) -> None:
        """Fill codes and distances.

        Args:
            space: the space in which the columns were cast.
            eye: its position, metres.
            bottom: height from which a ray may meet something behind the first body, metres.
            ceiling: height up to which it may.
        """
        heights = self._heights
        for i, body in self._movers:  # the others have not moved since the last update
            heights[3 * i] = z = body.z
            heights[3 * i + 1] = z + body.height
        if self._look(self._job, *eye, bottom, ceiling):
            self._look_behind(self._behind, self._job, space._space, *eye)

    def _floor(self, top: float, region: Region | None, code: float) -> bytes:
        if region is None:  # endless ground
            return _FLOOR.pack(0, 0, top, code, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0)
        shape = region.description.shape
        kind, a, b = _lengths(shape)
        corners = np.array(shape.vertices if isinstance(shape, PolygonShape) else [(0.0, 0.0)])
        place = region.x, region.y, region.cos, region.sin
        return _FLOOR.pack(kind, len(corners), top, code, *place, a, b, self._kept_address(corners))

    def _kept_address(self, array: Any) -> int:
        """Return the address of an array, and keep the array alive until the next update."""
        self._kept.append(array)
        return _address(array)


def _address(array: Any) -> int:
    where: int = array.ctypes.data
    return where


def _lengths(shape: RegionShape) -> tuple[int, float, float]:
    """Return the number of a shape's kind and its lengths, as in rays.c."""
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
