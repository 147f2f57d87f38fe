"""Contacts between bodies, updated by pymunk's begin and separate callbacks.

Only watched bodies (those of agents) and bodies that are not at height 0 on the ground have
callbacks, so a pile of boxes that no block asks about costs nothing.
"""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import pymunk

from ai4u_edu.world.body import Body
from ai4u_edu.world.native import (
    Impulses,
    contact_impulses,
    push_of,
    set_contact_impulses,
    set_push,
)

UNWATCHED, WATCHED, RAISED = 0, 1, 2
"""Collision types: no callbacks; begin and separate; also one at every tick, to compare heights."""

TOUCH_GAP_M = 1e-6
"""Bodies with a smaller vertical gap than this (metres) touch."""


Part = tuple[str, int]
"""Name of a body, and the number of one of its shapes."""


class PressState(NamedTuple):
    """The forces between bodies that the physics keeps of a tick for the next one."""

    impulses: Mapping[tuple[Part, Part], Impulses]
    """Impulses at the contact points of shapes that touch."""
    pushes: Mapping[str, tuple[float, float, float]]
    """Velocities (m/s, m/s, rad/s) that move bodies out of others in the next tick, by name."""


NO_PRESSES = PressState({}, {})


class ContactState(NamedTuple):
    """Contacts of watched bodies by names, and the forces between all bodies."""

    touching: dict[str, tuple[str, ...]]
    """The bodies that each body touches, in the order of first touch."""
    last: dict[tuple[str, str], int]
    """The last tick of each contact that has ended."""
    begun: dict[str, int]
    """Contacts of each body that have begun."""
    presses: PressState
    """Empty if nothing touches, in snapshots, and with a pymunk of another version."""


class Contacts:
    """The contacts of one world, and the pairs that pass each other at different heights."""

    def __init__(self) -> None:
        self.tick = 0
        """The last tick, or the one under way."""
        self.error: BaseException | None = None
        self.has_news = False
        """True if :meth:`settle` has something to do after this tick."""
        self._unconfirmed: dict[tuple[str, str], None] = {}
        self._space: pymunk.Space | None = None
        self._owners: dict[pymunk.Shape, Body] = {}
        self._watched: dict[str, None] = {}
        self._touching: dict[str, dict[str, None]] = {}
        self._last: dict[tuple[str, str], int] = {}
        self._begun: dict[str, int] = {}
        self._passing: dict[Body, dict[Body, None]] = {}

    def attach(self, space: pymunk.Space, owners: dict[pymunk.Shape, Body]) -> None:
        """Start over on a new space."""
        self.tick, self.error, self.has_news = 0, None, False
        self._unconfirmed.clear()
        self._space, self._owners = space, owners
        self._touching.clear()
        self._last.clear()
        self._begun.clear()
        self._passing.clear()
        compare, separate = self._guard(self._compare), self._guard(self._separate)
        space.on_collision(WATCHED, None, begin=compare, separate=separate)
        space.on_collision(RAISED, None, begin=compare, pre_solve=compare, separate=separate)

    def get_state(self, *, with_presses: bool = True) -> ContactState:
        """Return the contacts of watched bodies, and the forces between all bodies."""
        touching = {name: tuple(others) for name, others in self._touching.items()}
        presses = self._get_presses() if with_presses else NO_PRESSES
        return ContactState(touching, dict(self._last), dict(self._begun), presses)

    def set_state(self, state: ContactState, step: Callable[[], None]) -> None:
        """Take over the contacts of another copy of this world, whose bodies stand alike.

        A new space reports contacts with its first step. One that ends in that very step it never
        reports, so that :meth:`settle` ends it.

        Args:
            state: of the other copy.
            step: steps the space.
        """
        if state.presses.impulses:
            self._set_presses(state.presses, step)
        reported = {(name, other) for name, others in self._touching.items() for other in others}
        self._touching = {name: dict.fromkeys(names) for name, names in state.touching.items()}
        self._last, self._begun = dict(state.last), dict(state.begun)
        self._unconfirmed = {
            (name, other): None
            for name, others in self._touching.items()
            for other in others
            if (name, other) not in reported
        }
        self.has_news = bool(self._unconfirmed)

    def _get_presses(self) -> PressState:
        impulses = contact_impulses(self._space) if self._space is not None else {}
        if not impulses:
            return NO_PRESSES
        bodies = dict.fromkeys(self._owners[shape] for pair in impulses for shape in pair)
        return PressState(
            {(self._part(a), self._part(b)): values for (a, b), values in impulses.items()},
            {body.name: push_of(body._pm) for body in bodies},
        )

    def _set_presses(self, state: PressState, step: Callable[[], None]) -> None:
        """Let bodies press on each other as in another copy of this world.

        A step in which nothing moves lets the space find the contacts, which it then keeps.
        """
        owners = self._owners.values()
        movers = {body.name: body for body in owners if body.description.kind != "static"}
        motions = {
            name: (body._pm.velocity, body._pm.angular_velocity) for name, body in movers.items()
        }
        for body in movers.values():
            body._pm.velocity, body._pm.angular_velocity = (0.0, 0.0), 0.0
        step()
        shapes = {self._part(shape): shape for shape in self._owners}
        impulses = {
            frozenset((shapes[a], shapes[b])): values
            for (a, b), values in state.impulses.items()
            if a in shapes and b in shapes
        }
        if self._space is not None:
            set_contact_impulses(self._space, impulses)
        for name, body in movers.items():
            body._pm.velocity, body._pm.angular_velocity = motions[name]
            set_push(body._pm, state.pushes.get(name, (0.0, 0.0, 0.0)))

    def _part(self, shape: pymunk.Shape) -> Part:
        body = self._owners[shape]
        return body.name, body._shapes.index(shape)

    def settle(self) -> None:
        """Finish a tick: end contacts that were taken over and are none, and raise an error.

        Raises:
            Exception: the first error of a callback since the last call.
        """
        self.has_news = False
        if self._unconfirmed:
            for name, other in self._unconfirmed:
                self._end(name, other, self.tick - 1)
            self._unconfirmed.clear()
        if self.error is not None:
            error, self.error = self.error, None
            raise error

    def watch(self, body: Body) -> None:
        """Record the contacts of a body from now on."""
        self._watched[body.name] = None
        self.classify(body)
        # contacts that exist already do not begin again
        body._pm.each_arbiter(lambda arbiter: self._touch(*self._pair(arbiter)))

    def classify(self, body: Body) -> None:
        """Set the collision type of a body's shapes."""
        if body.z != 0.0 or not body.on_ground or body in self._passing:
            kind = RAISED
        else:
            kind = WATCHED if body.name in self._watched else UNWATCHED
        for shape in body._shapes:
            if shape.collision_type != kind:
                shape.collision_type = kind

    def of(self, name: str) -> tuple[str, ...]:
        """Return the names of bodies that a watched body touches, in the order of first touch."""
        return tuple(self._touching.get(name, ()))

    def begun(self, name: str) -> int:
        """Return how many contacts of a watched body have begun since the world's reset."""
        return self._begun.get(name, 0)

    def touched_after(self, name: str, other: str, tick: int) -> bool:
        """Return True if the two touch now, or touched at any tick after the given one."""
        return other in self._touching.get(name, ()) or self._last.get((name, other), -1) > tick

    def passes(self, body: Body) -> tuple[Body, ...]:
        """Return the bodies that this one is above or below."""
        return tuple(self._passing.get(body, ()))

    def forget(self, body: Body) -> None:
        """End all contacts of a body that left the space."""
        self._passing.pop(body, None)
        for other in list(self._passing):
            self._end_passing(other, body)
        for name in list(self._touching):
            self._end(name, body.name, self.tick)
        for name in self.of(body.name):
            self._end(body.name, name, self.tick)

    def _compare(self, arbiter: pymunk.Arbiter) -> None:
        a, b = self._pair(arbiter)
        gap = max(b.z - (a.z + a.height), a.z - (b.z + b.height))
        apart = gap >= -TOUCH_GAP_M
        # the arbiter keeps this from tick to tick, so it is set in both cases
        arbiter.process_collision = not apart
        if gap <= TOUCH_GAP_M:
            self._touch(a, b)
        for one, other in ((a, b), (b, a)):
            if apart:
                self._passing.setdefault(one, {})[other] = None
            else:
                self._end_passing(one, other)
            if gap > TOUCH_GAP_M:
                self._end(one.name, other.name, self.tick - 1)

    def _separate(self, arbiter: pymunk.Arbiter) -> None:
        a, b = self._pair(arbiter)
        # a removed body was touched until now, any other until the last tick
        last = self.tick if arbiter.is_removal else self.tick - 1
        for one, other in ((a, b), (b, a)):
            self._end_passing(one, other)
            self._end(one.name, other.name, last)

    def _end_passing(self, one: Body, other: Body) -> None:
        """End the passing of one by another; past all, it needs no callback at each tick."""
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
                self._unconfirmed.pop((one, other), None)
                touching = self._touching.setdefault(one, {})
                if other not in touching:
                    touching[other] = None
                    self._begun[one] = self._begun.get(one, 0) + 1

    def _end(self, name: str, other: str, last: int) -> None:
        touching = self._touching.get(name)
        if touching is not None and other in touching:
            del touching[other]
            self._last[name, other] = last

    def _guard(
        self, handle: Callable[[pymunk.Arbiter], None]
    ) -> Callable[[pymunk.Arbiter, pymunk.Space, Any], None]:
        # pymunk prints and swallows errors of callbacks; this one is raised after the tick
        def guarded(arbiter: pymunk.Arbiter, space: pymunk.Space, _data: Any) -> None:
            if space is not self._space:
                return  # the space of an earlier episode, which ends its contacts when it is freed
            try:
                handle(arbiter)
            except Exception as error:  # whatever it is, World.tick raises it
                self.error, self.has_news = self.error or error, True

        return guarded
