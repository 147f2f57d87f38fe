"""Who touches whom, kept up to date by the physics' own begin and separate signals.

Only bodies somebody watches (agents' bodies) and bodies off their ground level are followed, so a
pile of boxes that nobody asks about costs nothing.
"""

from collections.abc import Callable
from typing import Any

import pymunk

from ai4u_edu.world.body import Body

PLAIN, WATCHED, ALOFT = 0, 1, 2
"""Collision types: no signals; begin and separate; and one more every tick, to compare heights."""

TOUCH = 1e-6
"""Bodies closer than this above one another (metres) touch."""


class Contacts:
    """The contacts of one world, and which pairs pass each other at different heights."""

    def __init__(self) -> None:
        self.tick = 0
        """The last tick, or the one that is under way."""
        self.error: BaseException | None = None
        self._space: pymunk.Space | None = None
        self._owners: dict[pymunk.Shape, Body] = {}
        self._watched: dict[str, None] = {}
        self._touching: dict[str, dict[str, None]] = {}
        self._last: dict[tuple[str, str], int] = {}
        self._passing: dict[Body, dict[Body, None]] = {}

    def attach(self, space: pymunk.Space, owners: dict[pymunk.Shape, Body]) -> None:
        """Starts over, on a space that was built anew."""
        self.tick, self.error = 0, None
        self._space, self._owners = space, owners
        self._touching.clear()
        self._last.clear()
        self._passing.clear()
        compare, separate = self._guard(self._compare), self._guard(self._separate)
        space.on_collision(WATCHED, None, begin=compare, separate=separate)
        space.on_collision(ALOFT, None, begin=compare, pre_solve=compare, separate=separate)

    def raise_error(self) -> None:
        """Raises what a handler has raised since the last time, if any did."""
        if self.error is not None:
            error, self.error = self.error, None
            raise error

    def watch(self, body: Body) -> None:
        """From now on the contacts of this body are known."""
        self._watched[body.name] = None
        self.classify(body)
        # what it touches already does not begin again
        body._pm.each_arbiter(lambda arbiter: self._touch(*self._pair(arbiter)))

    def classify(self, body: Body) -> None:
        """Gives the body's shapes the collision type that its place asks for."""
        if body.z != 0.0 or not body.on_ground or body in self._passing:
            kind = ALOFT
        else:
            kind = WATCHED if body.name in self._watched else PLAIN
        for shape in body._shapes:
            if shape.collision_type != kind:
                shape.collision_type = kind

    def of(self, name: str) -> tuple[str, ...]:
        """The names of all that a watched body touches now, in the order of first touch."""
        return tuple(self._touching.get(name, ()))

    def touched_after(self, name: str, other: str, tick: int) -> bool:
        """Whether the two touch now, or touched at any tick after the given one."""
        return other in self._touching.get(name, ()) or self._last.get((name, other), -1) > tick

    def passes(self, body: Body) -> tuple[Body, ...]:
        """The bodies that this one is right above or below of now."""
        return tuple(self._passing.get(body, ()))

    def forget(self, body: Body) -> None:
        """Drops the contacts of a body that left the world."""
        self._passing.pop(body, None)
        for other in list(self._passing):
            self._meet_again(other, body)
        for name in list(self._touching):
            self._end(name, body.name, self.tick)
        for name in self.of(body.name):
            self._end(body.name, name, self.tick)

    def _compare(self, arbiter: pymunk.Arbiter) -> None:
        a, b = self._pair(arbiter)
        gap = max(b.z - (a.z + a.height), a.z - (b.z + b.height))
        apart = gap >= -TOUCH
        # the arbiter remembers this from tick to tick, so it is said both ways
        arbiter.process_collision = not apart
        if gap <= TOUCH:
            self._touch(a, b)
        for one, other in ((a, b), (b, a)):
            if apart:
                self._passing.setdefault(one, {})[other] = None
            else:
                self._meet_again(one, other)
            if gap > TOUCH:
                self._end(one.name, other.name, self.tick - 1)

    def _separate(self, arbiter: pymunk.Arbiter) -> None:
        a, b = self._pair(arbiter)
        # what is taken out of the space was touched until now, else it was until the last tick
        last = self.tick if arbiter.is_removal else self.tick - 1
        for one, other in ((a, b), (b, a)):
            self._meet_again(one, other)
            self._end(one.name, other.name, last)

    def _meet_again(self, one: Body, other: Body) -> None:
        """Forgets that one passes the other; on the ground and past all, it needs no more looks."""
        passing = self._passing.get(one)
        if passing is not None and other in passing:
            del passing[other]
            if not passing:
                del self._passing[one]
                self.classify(one)

    def _pair(self, arbiter: pymunk.Arbiter) -> tuple[Body, Body]:
        a, b = arbiter.shapes
        return self._owners[a], self._owners[b]

    def _touch(self, a: Body, b: Body) -> None:
        for one, other in ((a.name, b.name), (b.name, a.name)):
            if one in self._watched:
                self._touching.setdefault(one, {})[other] = None

    def _end(self, name: str, other: str, last: int) -> None:
        touching = self._touching.get(name)
        if touching is not None and other in touching:
            del touching[other]
            self._last[name, other] = last

    def _guard(
        self, handle: Callable[[pymunk.Arbiter], None]
    ) -> Callable[[pymunk.Arbiter, pymunk.Space, Any], None]:
        # pymunk prints and swallows what is raised in here; kept, it is raised after the tick
        def guarded(arbiter: pymunk.Arbiter, space: pymunk.Space, _data: Any) -> None:
            if space is not self._space:
                return  # a space of an earlier episode, which says goodbye when it is freed
            try:
                handle(arbiter)
            except Exception as error:  # whatever it is, World.tick raises it
                self.error = self.error or error

        return guarded
