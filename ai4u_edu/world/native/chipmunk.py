"""Motion of bodies and steps of a space through pymunk's cffi layer."""

import ctypes
from collections.abc import Callable, Mapping
from functools import cache, partial
from typing import Any, NamedTuple

import pymunk

from ai4u_edu.world.native.compiled import load_library

try:
    from pymunk._chipmunk_cffi import ffi as ffi
    from pymunk._chipmunk_cffi import lib as lib
except ImportError:  # pragma: no cover - another pymunk than the pinned one
    ffi = lib = None

PYMUNK_VERSION = "7.3."
"""Start of the version of pymunk whose private layer is known."""
_FUNCTIONS = (
    "cpBodyApplyForceAtLocalPoint",
    "cpShapesCollide",
    "cpSpaceSegmentQueryFirst",
    "cpSpaceStep",
)
_ARBITER_FUNCTIONS = ("cpSpaceEachCachedArbiter", "ext_cpArbiterIteratorFunc")
_APART = 3
"""State of an arbiter whose shapes don't touch any more."""
_CENTRE_POINT = 0.0, 0.0
_VELOCITY, _ANGLE, _SPIN, _CENTRE = 10, 14, 15, 21
"""Places of a body's motion in Chipmunk's struct of a body, which is made of numbers of 8 bytes."""


def _is_known() -> bool:
    """Return True if pymunk's private layer is the one that this package was written for."""
    return (
        lib is not None
        and pymunk.version.startswith(PYMUNK_VERSION)
        and all(hasattr(lib, name) for name in _FUNCTIONS)
        and bool(ffi.sizeof("cpSegmentQueryInfo") == 48)
    )


IS_NATIVE = _is_known()
"""True if Chipmunk is called through pymunk's private layer, False if through its public API."""


class ChipmunkMotion(NamedTuple):
    """Motion of a body: up to date whenever it is read, and set at once.

    It lies in Chipmunk's own memory. A call of Chipmunk lets another thread of Python go first, and
    reading memory doesn't: a world of 30 robots does it 120 times a tick, and could wait as often
    for the threads that draw pages.
    """

    centre: Any
    """Centre with ``x`` and ``y``, metres; to be read."""
    angle: Any
    """Radians, not wrapped, at index 0; to be read."""
    velocity: Any
    """Velocity with ``x`` and ``y``, world frame, m/s."""
    spin: Any
    """Radians per second, at index 0."""


class _PublicVector:
    """A vector of a body, through pymunk's public API."""

    def __init__(self, pm: pymunk.Body, name: str) -> None:
        self._pm, self._name = pm, name

    @property
    def x(self) -> float:
        return float(getattr(self._pm, self._name)[0])

    @x.setter
    def x(self, number: float) -> None:
        setattr(self._pm, self._name, (number, self.y))

    @property
    def y(self) -> float:
        return float(getattr(self._pm, self._name)[1])

    @y.setter
    def y(self, number: float) -> None:
        setattr(self._pm, self._name, (self.x, number))


class _PublicNumber:
    """A number of a body, likewise."""

    def __init__(self, pm: pymunk.Body, name: str) -> None:
        self._pm, self._name = pm, name

    def __getitem__(self, index: int) -> float:
        return float(getattr(self._pm, self._name))

    def __setitem__(self, index: int, number: float) -> None:
        setattr(self._pm, self._name, number)


def public_motion(pm: pymunk.Body) -> ChipmunkMotion:
    """Return a body's motion through pymunk's public API."""
    return ChipmunkMotion(
        centre=_PublicVector(pm, "position"),
        angle=_PublicNumber(pm, "angle"),
        velocity=_PublicVector(pm, "velocity"),
        spin=_PublicNumber(pm, "angular_velocity"),
    )


def _motion(pm: pymunk.Body) -> ChipmunkMotion:
    numbers = _numbers(pm)
    return ChipmunkMotion(
        centre=ffi.cast("cpVect *", numbers + _CENTRE)[0],
        angle=numbers + _ANGLE,
        velocity=ffi.cast("cpVect *", numbers + _VELOCITY)[0],
        spin=numbers + _SPIN,
    )


def _numbers(pm: pymunk.Body) -> Any:
    return ffi.cast("double *", pm._body)


def _knows_motion() -> bool:
    """Return True if motion is where it should be in Chipmunk's private struct of a body."""
    if not IS_NATIVE:
        return False
    pm = pymunk.Body(1, 1)
    motion, public = _motion(pm), public_motion(pm)
    pm.center_of_gravity, pm.position, pm.angle = (2, 3), (0.25, 0.5), 0.75
    pm.velocity, pm.angular_velocity = (1.25, 1.5), 1.75
    seen, expected = (
        (centre.x, centre.y, angle[0], velocity.x, velocity.y, spin[0])
        for centre, angle, velocity, spin in (motion, public)
    )
    return bool(seen == expected)


motion_of: Callable[[pymunk.Body], ChipmunkMotion] = _motion if _knows_motion() else public_motion
"""The fastest way to a body's motion that this pymunk allows; valid as long as the body lives."""


def apply_force(pm: pymunk.Body, forward: float, left: float) -> None:
    """Push a body at its centre for one step; newtons, in the body's own frame."""
    if IS_NATIVE:  # pymunk's own method checks the lengths of both vectors
        lib.cpBodyApplyForceAtLocalPoint(pm._body, (forward, left), _CENTRE_POINT)
    else:
        pm.apply_force_at_local_point((forward, left), _CENTRE_POINT)


def step_function(space: pymunk.Space, dt: float) -> Callable[[], None]:
    """Return a function that steps a space by ``dt`` seconds.

    pymunk's own step also checks masses, which descriptions have done, and lets collision handlers
    add and remove objects, which ours don't.
    """
    return partial(lib.cpSpaceStep, space._space, dt) if IS_NATIVE else partial(space.step, dt)


def release_space(space: pymunk.Space) -> None:
    """Break the reference cycles of a space that is no longer used, so that it is freed at once.

    Its collision handlers refer back to it. Where episodes are short, hundreds of spaces would
    wait for the garbage collector.
    """
    for handler in getattr(space, "_handlers", {}).values():
        handler.separate = None  # it would still be called for bodies that touch at the end
        handler._space = None


_PUSH = slice(24, 27)
"""Place of a body's push in the same struct."""

Impulses = tuple[tuple[int, float, float], ...]
"""Number of each contact point of two shapes, and its impulses (N s) along and across."""


def contact_impulses(space: pymunk.Space) -> dict[tuple[pymunk.Shape, pymunk.Shape], Impulses]:
    """Return the impulses with which shapes pressed on each other in the last step.

    The next step's solver begins with them. Empty where Chipmunk's private layer is not known.
    """
    if not _knows_pushes():
        return {}
    arbiters = [each for each in space._get_arbiters() if each.count and each.state != _APART]
    if not arbiters:
        return {}
    shapes = {shape._shape: shape for shape in space.shapes}
    return {
        (shapes[arbiter.a], shapes[arbiter.b]): tuple(
            (int(point.hash), point.jnAcc, point.jtAcc)
            for point in arbiter.contacts[0 : arbiter.count]
        )
        for arbiter in arbiters
    }


def set_contact_impulses(
    space: pymunk.Space, impulses: Mapping[frozenset[pymunk.Shape], Impulses]
) -> None:
    """Replace the impulses of shapes that touched in the last step.

    Args:
        space: has just done a step in which the same shapes touched.
        impulses: by pairs of shapes, as :func:`contact_impulses` has them.
    """
    shapes = {shape._shape: shape for shape in space.shapes}
    for arbiter in space._get_arbiters():
        known = impulses.get(frozenset((shapes[arbiter.a], shapes[arbiter.b])), ())
        by_number = {number: values for number, *values in known}
        for index in range(arbiter.count):
            point = arbiter.contacts[index]
            values = by_number.get(int(point.hash))
            if values is None and len(known) == arbiter.count:
                values = [*known[index][1:]]  # a body that was added again has other numbers
            point.jnAcc, point.jtAcc = values or (0.0, 0.0)


def push_of(pm: pymunk.Body) -> tuple[float, float, float]:
    """Return the velocity (m/s, m/s, rad/s) that moves a body out of others in the next step."""
    x, y, turn = ffi.unpack(_numbers(pm) + _PUSH.start, _PUSH.stop - _PUSH.start)
    return x, y, turn


def set_push(pm: pymunk.Body, push: tuple[float, float, float]) -> None:
    """Set the velocity that moves a body out of others in the next step."""
    _numbers(pm)[_PUSH] = push


@cache
def _knows_pushes() -> bool:
    """Return True if pushes are where they should be in Chipmunk's private structs."""
    if not (IS_NATIVE and all(hasattr(lib, name) for name in _ARBITER_FUNCTIONS)):
        return False
    if ffi.sizeof("cpArbiter") != 184 or ffi.sizeof("struct cpContact") != 96:
        return False
    space, bodies = pymunk.Space(), [pymunk.Body(1, 1), pymunk.Body(2, 3)]
    for number, pm in enumerate(bodies):
        pm.position = 0.25 * number, 0.5 * number
        space.add(pm, pymunk.Poly.create_box(pm))
    space.step(0.25)
    (x, y), turn, push = bodies[1].position, bodies[1].angle, push_of(bodies[1])
    (vx, vy), omega = bodies[1].velocity, bodies[1].angular_velocity
    space.step(0.25)
    expected = (
        x + (vx + push[0]) * 0.25,
        y + (vy + push[1]) * 0.25,
        turn + (omega + push[2]) * 0.25,
    )
    return any(push) and (*bodies[1].position, bodies[1].angle) == expected


def contact_distances(
    shape: pymunk.Shape, other: pymunk.Shape, other_pm: pymunk.Body
) -> list[float]:
    """Return the distances (metres) of two shapes at their contact points; empty without contact.

    Args:
        shape: a shape with an up-to-date bounding box (``cache_bb``).
        other: likewise; without Chipmunk's private layer it must be in no space.
        other_pm: the body of ``other``.
    """
    if IS_NATIVE:  # pymunk's own Shape.shapes_collide fails for shapes that don't touch
        found = lib.cpShapesCollide(shape._shape, other._shape)
        return [found.points[i].distance for i in range(found.count)]
    space = pymunk.Space()
    space.add(other_pm, other)
    hits = space.shape_query(shape)
    space.remove(other_pm, other)
    return [point.distance for hit in hits for point in hit.contact_point_set.points]


def shape_key(shape: pymunk.Shape) -> int:
    """Return the number by which a cast of segments names the shape that it met."""
    return address_of(shape._shape) if IS_NATIVE else id(shape)


def address_of(pointer: Any) -> int:
    """Return the memory address of a cffi pointer, for the compiled functions."""
    return int(ffi.cast("uintptr_t", pointer))


def compiled_function(name: str, form: str) -> Any:
    """Return a function of the compiled library as a cffi function; None without the library.

    Args:
        name: its name in the C source.
        form: its C type, as ``"void (*)(void *)"``.
    """
    library = load_library() if IS_NATIVE else None
    if library is None:
        return None
    return ffi.cast(form, ctypes.cast(getattr(library, name), ctypes.c_void_p).value)
