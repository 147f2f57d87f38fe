"""The one place that touches pymunk's private parts: rays without an object for each.

Everything here has a twin in pymunk's public interface, which is used where the private one is
not as expected, and gives exactly the same numbers.
"""

from typing import Any

import numpy as np
import numpy.typing as npt
import pymunk

try:
    from pymunk._chipmunk_cffi import ffi, lib

    _FAST = hasattr(lib, "cpSpaceSegmentQueryFirst") and ffi.sizeof("cpSegmentQueryInfo") == 48
except ImportError:  # pragma: no cover - another pymunk than the pinned one
    ffi = lib = None
    _FAST = False

_HIT = np.dtype(
    [("shape", "u8"), ("px", "f8"), ("py", "f8"), ("nx", "f8"), ("ny", "f8"), ("alpha", "f8")]
)


class Segments:
    """Casts n segments that start at one point and tells what each meets first.

    Args:
        count: how many segments.
        fast: None for the fastest way there is; False for the public interface.

    Attributes:
        ends: (n, 2) float64, where each segment ends; written by the caller, metres.
        alpha: (n,) float64, the share of each segment up to what it meets; 1 for nothing.
        shapes: n keys as :func:`shape_key` gives them; 0 where nothing was met.
    """

    def __init__(self, count: int, *, fast: bool | None = None) -> None:
        self._fast = _FAST if fast is None else fast
        self.shapes: list[int] = [0] * count
        self.ends: npt.NDArray[np.float64]
        self.alpha: npt.NDArray[np.float64]
        if self._fast:
            self._end_memory = ffi.new("cpVect[]", count)
            self._hit_memory = ffi.new("cpSegmentQueryInfo[]", count)
            self.ends = np.frombuffer(ffi.buffer(self._end_memory), np.float64).reshape(count, 2)
            self._hits = np.frombuffer(ffi.buffer(self._hit_memory), _HIT)
            self.alpha = self._hits["alpha"]
            self._start = ffi.new("cpVect *")
            self._filter = ffi.new("cpShapeFilter *")
            self._accept: pymunk.ShapeFilter | None = None
            self._pairs = [(self._end_memory[i], self._hit_memory + i) for i in range(count)]
        else:
            self.ends = np.zeros((count, 2))
            self.alpha = np.ones(count)

    def cast(self, space: pymunk.Space, x: float, y: float, accept: pymunk.ShapeFilter) -> None:
        """Fills ``alpha`` and ``shapes``."""
        if not self._fast:
            self._cast_publicly(space, x, y, accept)
            return
        if accept is not self._accept:  # turned into Chipmunk's form once, not for each ray
            self._accept = accept
            self._filter[0] = tuple(accept)
        start, handle, chosen = self._start[0], space._space, self._filter[0]
        start.x, start.y = x, y
        first = lib.cpSpaceSegmentQueryFirst
        for end, hit in self._pairs:
            first(handle, start, end, 0.0, chosen, hit)
        self.shapes = self._hits["shape"].tolist()

    def _cast_publicly(
        self, space: pymunk.Space, x: float, y: float, accept: pymunk.ShapeFilter
    ) -> None:
        keys = []
        for i, (end_x, end_y) in enumerate(self.ends.tolist()):
            hit = space.segment_query_first((x, y), (end_x, end_y), 0.0, accept)
            self.alpha[i] = 1.0 if hit is None else hit.alpha
            keys.append(0 if hit is None else shape_key(hit.shape, fast=False))
        self.shapes = keys


def let_go(space: pymunk.Space) -> None:
    """Lets a space that nobody needs any more be freed at once.

    Its collision handlers point back at it, so it would wait for the garbage collector; and where
    episodes are short, hundreds of spaces would wait.
    """
    for handler in getattr(space, "_handlers", {}).values():
        handler.separate = None  # it would still be called for whoever touches at the end
        handler._space = None


def shape_key(shape: pymunk.Shape, *, fast: bool | None = None) -> int:
    """The number by which :class:`Segments` names a shape."""
    if _FAST if fast is None else fast:
        pointer: Any = shape._shape
        return int(ffi.cast("uintptr_t", pointer))
    return id(shape)
