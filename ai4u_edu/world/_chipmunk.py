"""The one place that touches pymunk's private parts: rays, motion and ticks without an object each.

Everything here has a twin in pymunk's public interface, which is used where the private one is
not as expected, and gives exactly the same numbers.
"""

from collections.abc import Callable
from functools import partial
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pymunk

try:
    from pymunk._chipmunk_cffi import ffi, lib

    _FAST = (
        all(hasattr(lib, name) for name in ("cpSpaceSegmentQueryFirst", "cpSpaceStep"))
        and ffi.sizeof("cpSegmentQueryInfo") == 48
    )
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
    """

    def __init__(self, count: int, *, fast: bool | None = None) -> None:
        self._fast = _FAST if fast is None else fast
        self._shapes: list[int] = [0] * count
        self.ends: npt.NDArray[np.float64]
        self.alpha: npt.NDArray[np.float64]
        if self._fast:
            self._end_memory = ffi.new("cpVect[]", count)
            self._hit_memory = ffi.new("cpSegmentQueryInfo[]", count)
            self.ends = np.frombuffer(ffi.buffer(self._end_memory), np.float64).reshape(count, 2)
            self._hits = np.frombuffer(ffi.buffer(self._hit_memory), _HIT)
            self.alpha = self._hits["alpha"]
            self._start = ffi.new("cpVect *")[0]
            self._filter = ffi.new("cpShapeFilter *")[0]
            self._accept: pymunk.ShapeFilter | None = None
            self._first = lib.cpSpaceSegmentQueryFirst
            self._pairs = [(self._end_memory[i], self._hit_memory + i) for i in range(count)]
        else:
            self.ends = np.zeros((count, 2))
            self.alpha = np.ones(count)

    def cast(self, space: pymunk.Space, x: float, y: float, accept: pymunk.ShapeFilter) -> None:
        """Fills ``alpha``, and what :meth:`shapes` tells."""
        if not self._fast:
            self._cast_publicly(space, x, y, accept)
            return
        chosen = self._filter
        if accept is not self._accept:  # turned into Chipmunk's form once, not for each ray
            self._accept = accept
            chosen.group, chosen.categories, chosen.mask = accept
        start, handle, first = self._start, space._space, self._first
        start.x, start.y = x, y
        for end, hit in self._pairs:
            first(handle, start, end, 0.0, chosen, hit)

    def shapes(self) -> list[int]:
        """What each met at the last cast, as :func:`shape_key` names it; 0 for nothing."""
        return self._hits["shape"].tolist() if self._fast else self._shapes

    def _cast_publicly(
        self, space: pymunk.Space, x: float, y: float, accept: pymunk.ShapeFilter
    ) -> None:
        keys = []
        for i, (end_x, end_y) in enumerate(self.ends.tolist()):
            hit = space.segment_query_first((x, y), (end_x, end_y), 0.0, accept)
            self.alpha[i] = 1.0 if hit is None else hit.alpha
            keys.append(0 if hit is None else shape_key(hit.shape, fast=False))
        self._shapes = keys


class _Vector:
    """Two numbers, where Chipmunk's own vector is not to be had."""

    x = y = 0.0


class Motion(NamedTuple):
    """How bodies are asked and moved, many times a tick: functions of a body's ``handle``."""

    handle: Callable[[pymunk.Body], Any]
    vector: Callable[[], Any]
    """Makes something with an ``x`` and a ``y``, to be filled."""
    place: Callable[[Any], Any]
    """(handle): its centre, with ``x`` and ``y``, metres."""
    angle: Callable[[Any], float]
    """(handle): radians, not wrapped."""
    set_velocity: Callable[[Any, Any], None]
    """(handle, vector): in the world's frame, m/s."""
    set_angular_velocity: Callable[[Any, float], None]
    """(handle, omega): radians per second."""
    push: Callable[[Any, Any, Any], None]
    """(handle, vector, where): adds a force in its own frame, newtons."""


def _set_velocity(pm: pymunk.Body, vector: Any) -> None:
    pm.velocity = vector.x, vector.y


def _set_angular_velocity(pm: pymunk.Body, omega: float) -> None:
    pm.angular_velocity = omega


def _push(pm: pymunk.Body, vector: Any, where: Any) -> None:
    pm.apply_force_at_local_point((vector.x, vector.y), (where.x, where.y))


PUBLIC = Motion(
    handle=lambda pm: pm,
    vector=_Vector,
    place=attrgetter("position"),
    angle=attrgetter("angle"),
    set_velocity=_set_velocity,
    set_angular_velocity=_set_angular_velocity,
    push=_push,
)
QUICK = (
    Motion(
        handle=attrgetter("_body"),
        vector=lambda: ffi.new("cpVect *")[0],
        place=lib.cpBodyGetPosition,
        angle=lib.cpBodyGetAngle,
        set_velocity=lib.cpBodySetVelocity,
        set_angular_velocity=lib.cpBodySetAngularVelocity,
        push=lib.cpBodyApplyForceAtLocalPoint,
    )
    if _FAST
    else PUBLIC
)
"""The fastest way there is."""


def stepper(space: pymunk.Space, dt: float) -> Callable[[], None]:
    """What moves a space on by one tick, for as long as it is there.

    pymunk's own also checks masses, which descriptions have done, and lets collision handlers add
    and remove things, which ours don't.
    """
    return partial(lib.cpSpaceStep, space._space, dt) if _FAST else partial(space.step, dt)


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
