"""Many segments cast from one point: three implementations with the same bits.

The compiled one is a loop in C, the second one a loop in Python over Chipmunk's own query, the
third one uses pymunk's public API. :func:`make_segments` takes the first one that is available.
"""

from functools import cache
from struct import Struct
from typing import Any

import numpy as np
import numpy.typing as npt
import pymunk
from numpy import add, fmod, multiply

from ai4u_edu.world.native.chipmunk import (
    IS_NATIVE,
    address_of,
    compiled_function,
    ffi,
    lib,
    shape_key,
)

_HIT = np.dtype(
    [("shape", "u8"), ("px", "f8"), ("py", "f8"), ("nx", "f8"), ("ny", "f8"), ("alpha", "f8")]
)
_FAN = Struct("=QqQIIQQQ")  # Fan in rays.c
_QUERIES = {
    "cpSpaceSegmentQueryFirst": (
        "struct cpShape *(*)(struct cpSpace *, struct cpVect, struct cpVect, double, "
        "struct cpShapeFilter, struct cpSegmentQueryInfo *)"
    ),
    "cpSpaceSegmentQuery": (
        "void(*)(struct cpSpace *, struct cpVect, struct cpVect, double, struct cpShapeFilter, "
        "void(*)(struct cpShape *, struct cpVect, struct cpVect, double, void *), void *)"
    ),
    "cpShapeSegmentQuery": (
        "unsigned char(*)(struct cpShape *, struct cpVect, struct cpVect, double, "
        "struct cpSegmentQueryInfo *)"
    ),
}
_LAYOUT = {
    "cpVect": (16, {"x": 0, "y": 8}),
    "cpShapeFilter": (16, {"group": 0, "categories": 8, "mask": 12}),
    "cpSegmentQueryInfo": (48, {"shape": 0, "point": 8, "normal": 24, "alpha": 40}),
}
_WHOLE = np.ones(())


class Segments:
    """n segments from one point and the first shape that each meets; uses pymunk's public API.

    Args:
        count: number of segments.

    Attributes:
        directions: (n, 2) float64 unit vectors, written by the caller.
        alpha: (n,) float64, fraction of each segment up to its hit; 1 without a hit.
        distances: (n,) float64, metres to each hit; 0 without a hit.
    """

    def __init__(self, count: int) -> None:
        self.directions: npt.NDArray[np.float64] = np.zeros((count, 2))
        self.alpha: npt.NDArray[np.float64] = np.ones(count)
        self.distances: npt.NDArray[np.float64] = np.zeros(count)
        self._shapes: list[int] = [0] * count

    def cast(
        self, space: pymunk.Space, x: float, y: float, reach: float, accept: pymunk.ShapeFilter
    ) -> None:
        """Cast all segments: fill ``alpha``, ``distances`` and the result of :meth:`shapes`."""
        keys = []
        for i, (dx, dy) in enumerate(self.directions.tolist()):
            end = dx * reach + x, dy * reach + y
            hit = space.segment_query_first((x, y), end, 0.0, accept)
            self.alpha[i] = 1.0 if hit is None else hit.alpha
            self.distances[i] = hit.alpha * reach if hit and hit.alpha < 1.0 else 0.0
            keys.append(0 if hit is None else shape_key(hit.shape))
        self._shapes = keys

    def shapes(self) -> list[int]:
        """Return the :func:`shape_key` of each hit of the last cast; 0 without a hit."""
        return self._shapes


class CffiSegments(Segments):
    """The same through pymunk's cffi layer, into preallocated memory."""

    def __init__(self, count: int) -> None:
        super().__init__(count)
        self._hit_memory = ffi.new("cpSegmentQueryInfo[]", count)
        self._hits = np.frombuffer(ffi.buffer(self._hit_memory), _HIT)
        self.alpha = self._hits["alpha"]
        self._accept: pymunk.ShapeFilter | None = None
        self._prepare()

    def _prepare(self) -> None:
        count = len(self.directions)
        end_memory = ffi.new("cpVect[]", count)
        ends = np.frombuffer(ffi.buffer(end_memory), np.float64)
        self._ends = ends.reshape(count, 2)
        # a pair (x, y) side by side is a complex number; for numpy, an array of one number is
        # half the work of a Python number
        self._end_points, self._start_point = ends.view(np.complex128), np.zeros((), np.complex128)
        self._reach = np.zeros(())
        self._start, self._filter = ffi.new("cpVect *")[0], ffi.new("cpShapeFilter *")[0]
        self._pairs = [(end_memory[i], self._hit_memory + i) for i in range(count)]

    def cast(
        self, space: pymunk.Space, x: float, y: float, reach: float, accept: pymunk.ShapeFilter
    ) -> None:
        """Cast all segments: fill ``alpha``, ``distances`` and the result of :meth:`shapes`."""
        chosen = self._filter
        if accept is not self._accept:  # converted once, not for each ray
            self._accept = accept
            chosen.group, chosen.categories, chosen.mask = accept
        self._reach[()], self._start_point[()] = reach, complex(x, y)
        multiply(self.directions, self._reach, self._ends)
        add(self._end_points, self._start_point, self._end_points)
        start, handle, first = self._start, space._space, lib.cpSpaceSegmentQueryFirst
        start.x, start.y = x, y
        for end, hit in self._pairs:
            first(handle, start, end, 0.0, chosen, hit)
        # alpha is 1 without a hit, and fmod makes 0 of it
        fmod(self.alpha, _WHOLE, self.distances)
        multiply(self.distances, self._reach, self.distances)

    def shapes(self) -> list[int]:
        """Return the :func:`shape_key` of each hit of the last cast; 0 without a hit."""
        keys: list[int] = self._hits["shape"].tolist()
        return keys


class CompiledSegments(CffiSegments):
    """The same in one call of a loop in C; only where :func:`compiled_cast` finds it.

    Attributes:
        address: of the Fan in rays.c, for other compiled functions.
        arrays: addresses of directions, hits and distances, likewise.
    """

    def _prepare(self) -> None:
        self._call = compiled_cast()
        self._query = query_address("cpSpaceSegmentQueryFirst")
        self._fan = ffi.new("char[]", _FAN.size)
        self._memory = ffi.buffer(self._fan)
        self.address = address_of(self._fan)
        self.arrays = (
            self.directions.ctypes.data,
            address_of(self._hit_memory),
            self.distances.ctypes.data,
        )

    def cast(
        self, space: pymunk.Space, x: float, y: float, reach: float, accept: pymunk.ShapeFilter
    ) -> None:
        """Cast all segments: fill ``alpha``, ``distances`` and the result of :meth:`shapes`."""
        if accept is not self._accept:
            self._accept = accept
            self._memory[:] = _FAN.pack(self._query, len(self.directions), *accept, *self.arrays)
        self._call(self._fan, space._space, x, y, reach)


def make_segments(count: int) -> Segments:
    """Return segments of the fastest implementation that is available."""
    if not IS_NATIVE:
        return Segments(count)
    return CffiSegments(count) if compiled_cast() is None else CompiledSegments(count)


def is_compiled() -> bool:
    """Return True if rays are cast by the compiled part."""
    return compiled_cast() is not None


@cache
def compiled_cast() -> Any:
    """Return the loop in C, called as (fan, space, x, y, reach); None where it is not available.

    It calls Chipmunk's queries by their addresses, so it is used only if they have the known types.
    """
    if not _is_known():
        return None
    return compiled_function("cast_fan", "void (*)(void *, void *, double, double, double)")


def query_address(name: str) -> int:
    """Return the address of one of Chipmunk's queries, for the compiled functions."""
    return address_of(ffi.addressof(lib, name))


def _is_known() -> bool:
    """Return True if pymunk's declarations are those that rays.c was written for."""
    return all(
        ffi.typeof(ffi.addressof(lib, name)).cname == form for name, form in _QUERIES.items()
    ) and all(
        ffi.sizeof(name) == size
        and len(ffi.typeof(name).fields) == len(offsets)
        and all(ffi.offsetof(name, field) == offset for field, offset in offsets.items())
        for name, (size, offsets) in _LAYOUT.items()
    )
