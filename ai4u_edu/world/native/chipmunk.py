"""Pymunk's private parts: motion and ticks without an object each; rays are beside, in _segments.

Everything here has a twin in pymunk's public interface, which is used where the private one is
not as expected, and gives exactly the same numbers.
"""

import ctypes
from collections.abc import Callable
from functools import partial
from operator import attrgetter
from typing import Any, NamedTuple

import pymunk

from ai4u_edu.world.native.compiled import library

try:
    from pymunk._chipmunk_cffi import ffi as ffi
    from pymunk._chipmunk_cffi import lib as lib

    FAST = (
        all(hasattr(lib, name) for name in ("cpSpaceSegmentQueryFirst", "cpSpaceStep"))
        and ffi.sizeof("cpSegmentQueryInfo") == 48
    )
except ImportError:  # pragma: no cover - another pymunk than the pinned one
    ffi = lib = None
    FAST = False


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
    if FAST
    else PUBLIC
)
"""The fastest way there is."""


def stepper(space: pymunk.Space, dt: float) -> Callable[[], None]:
    """What moves a space on by one tick, for as long as it is there.

    pymunk's own also checks masses, which descriptions have done, and lets collision handlers add
    and remove things, which ours don't.
    """
    return partial(lib.cpSpaceStep, space._space, dt) if FAST else partial(space.step, dt)


def let_go(space: pymunk.Space) -> None:
    """Lets a space that nobody needs any more be freed at once.

    Its collision handlers point back at it, so it would wait for the garbage collector; and where
    episodes are short, hundreds of spaces would wait.
    """
    for handler in getattr(space, "_handlers", {}).values():
        handler.separate = None  # it would still be called for whoever touches at the end
        handler._space = None


def distances(shape: pymunk.Shape, other: pymunk.Shape, its_pm: pymunk.Body) -> list[float]:
    """Metres between two shapes at the points where they touch; none if they don't.

    Neither is in a space; both know where they are, by ``cache_bb``.

    Args:
        shape: one.
        other: the other one.
        its_pm: the other one's body.
    """
    if FAST:  # pymunk's own Shape.shapes_collide can't tell of two that don't touch
        found = lib.cpShapesCollide(shape._shape, other._shape)
        return [found.points[i].distance for i in range(found.count)]
    space = pymunk.Space()
    space.add(its_pm, other)
    hits = space.shape_query(shape)
    space.remove(its_pm, other)
    return [point.distance for hit in hits for point in hit.contact_point_set.points]


def shape_key(shape: pymunk.Shape) -> int:
    """The number by which a ray names the shape that it met."""
    if FAST:
        return address(shape._shape)
    return id(shape)


def address(pointer: Any) -> int:
    """Where something of Chipmunk's lies, for the compiled part."""
    return int(ffi.cast("uintptr_t", pointer))


def c_function(name: str, form: str) -> Any:
    """A function of the compiled part, to be called through cffi; None where there is none.

    Args:
        name: as in the C source.
        form: its type, as ``"void (*)(void *)"``.
    """
    made = library() if FAST else None
    if made is None:
        return None
    return ffi.cast(form, ctypes.cast(getattr(made, name), ctypes.c_void_p).value)
