"""Ticks at one go, by the compiled part, as long as nobody takes off, lands or falls."""

from functools import cache
from struct import Struct
from typing import TYPE_CHECKING, Any

import numpy as np

from ai4u_edu.world.body import Body, Drive
from ai4u_edu.world.native.chipmunk import address, c_function, ffi, lib

if TYPE_CHECKING:
    from ai4u_edu.world.world import World

_WORLD = Struct("=7QdQq2Q")  # World in ticks.c
_RUN = "long long (*)(void *, long long, void *, double, double, double, long long)"
_FORMS = {  # in World's order
    "cpSpaceStep": "void(*)(struct cpSpace *, double)",
    "cpBodyGetPosition": "struct cpVect(*)(struct cpBody *)",
    "cpBodyGetAngle": "double(*)(struct cpBody *)",
    "cpBodySetVelocity": "void(*)(struct cpBody *, struct cpVect)",
    "cpBodySetAngularVelocity": "void(*)(struct cpBody *, double)",
    "cpBodyApplyForceAtLocalPoint": "void(*)(struct cpBody *, struct cpVect, struct cpVect)",
}
_VECT = ["x", "y"]


class Ticks:
    """Moves a world on, for as long as its space is there.

    What the loop has to know is laid out anew only after a change: a mover came, went, took off or
    landed. Bodies that are built anew, and all where there are other floors, go and come.

    Args:
        world: which one.
    """

    def __init__(self, world: "World") -> None:
        self._world, self._run = world, compiled()
        self._learnt = -1
        self._job: bytes | None = None
        self._heights: list[float] = []

    def run(self, body: Body, drive: Drive, ticks: int) -> bool:
        """Ticks as often as it can, at most so often; the contacts' clock tells how often that was.

        Returns:
            Whether the last tick has to be followed by a look at the movers.
        """
        if self._run is None or body.fallen or not body.on_ground:
            return False
        height = self._world._height
        if self._learnt != height.changes:
            self._learn()
        # a script may have set a height by hand
        if self._job is None or self._heights != [mover.z for mover in height.movers]:
            return False
        return bool(self._run(self._job, ticks, body._handle, *drive))

    def _learn(self) -> None:
        world, height = self._world, self._world._height
        self._learnt = height.changes
        self._job = None
        self._heights = [mover.z for mover in height.movers]
        if not all(mover.on_ground for mover in height.movers):
            return
        floors: list[tuple[float, ...]] = []
        spans: dict[float, tuple[int, int]] = {}
        for z in self._heights:
            if z in spans:
                continue
            boxes = [each.upright_box for each in height.level(z)]
            here = [box for box in boxes if box is not None]
            if not here:
                return  # it stands on a body, or on what is no upright box
            spans[z] = len(floors), len(here)
            floors += here
        movers = [(address(each._handle), *spans[each.z]) for each in height.movers]
        self._kept = np.array(movers, np.int64), np.array(floors, np.float64)
        functions = [address(ffi.addressof(lib, name)) for name in _FORMS]
        clock, _ = world.contacts.clock.buffer_info()
        self._job = _WORLD.pack(
            *functions,
            address(world.space._space),
            world.dt,
            clock,
            len(movers),
            *(each.ctypes.data for each in self._kept),
        )


@cache
def compiled() -> Any:
    """The loop in C: (job, ticks, body, and a drive); None where it can't be had.

    It calls Chipmunk by addresses, so it is used only if that is what it was written for.
    """
    run = c_function("run", _RUN)
    return run if run is not None and _as_expected() else None


def _as_expected() -> bool:
    """Whether pymunk's own declarations are those of ticks.c."""
    return (
        ffi.sizeof("cpVect") == 16
        and [name for name, _ in ffi.typeof("cpVect").fields] == _VECT
        and all(
            hasattr(lib, name) and ffi.typeof(ffi.addressof(lib, name)).cname == form
            for name, form in _FORMS.items()
        )
    )
