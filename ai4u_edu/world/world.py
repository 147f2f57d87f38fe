"""The world: a plane with height, bodies by name, and a fixed tick."""

import math
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

import pymunk

from ai4u_edu.base.errors import NameNotFoundError, WorldError, suggest
from ai4u_edu.base.seeding import Seeds
from ai4u_edu.world.body import Body, BodyView
from ai4u_edu.world.bounds import Rectangle, around
from ai4u_edu.world.build import build
from ai4u_edu.world.contacts import Contacts
from ai4u_edu.world.descriptions import (
    AreaDescription,
    BodyDescription,
    FloorDescription,
    WorldSettings,
)
from ai4u_edu.world.grasp import detach
from ai4u_edu.world.height import Height
from ai4u_edu.world.native import release_space, step_function
from ai4u_edu.world.overlap import in_the_way
from ai4u_edu.world.placement import Thing
from ai4u_edu.world.randomize import place_now, randomize
from ai4u_edu.world.region import Region
from ai4u_edu.world.shapes import BodyShape, RegionShape

MAX_BODIES = 500

SLOP = 0.01
"""How far into each other bodies come to rest (metres); some of it keeps contacts steady."""

BIAS = 0.2**60
"""What is left of a deeper overlap after a second; after 1/60 s that is a fifth.

A velocity that is set anew each tick drives a body into a wall for one tick, before the wall can
answer; with pymunk's own nine tenths that adds up to half a metre at 3 m/s.
"""


KIND = {BodyDescription: "a body", FloorDescription: "a floor", AreaDescription: "an area"}


class World:
    """A plane with height: x right, y up on the screen, z towards the viewer; SI units.

    The same descriptions, seed and inputs give the same trajectory, bit for bit.

    Args:
        seed: a whole number from 0 to 2**63 - 1; all chance of the episode grows from it.
        settings: fields of :class:`WorldSettings`.

    >>> world = World(seed=1, ticks_per_second=60)
    >>> from ai4u_edu.world import CircleShape
    >>> robot = world.add_body("robot", CircleShape(radius=0.5), position=(1, 2))
    >>> robot.set_velocity(3.0, 0.0)
    >>> for _ in range(60):
    ...     world.tick()
    >>> robot.position[0] > 1.5
    True
    """

    def __init__(self, *, seed: int = 0, **settings: Any) -> None:
        self.settings: WorldSettings = WorldSettings(**settings)
        self.seeds = Seeds(seed)
        self.ticks = 0
        """Ticks since the reset."""
        self.space = pymunk.Space()
        self.contacts = Contacts()
        self.owners: dict[pymunk.Shape, Body] = {}
        self._described: dict[str, Thing] = {}
        self._has_random = False
        self._bodies: dict[str, Body] = {}
        self._floors: dict[str, tuple[FloorDescription, Region]] = {}
        self._areas: dict[str, Region] = {}
        self._height = Height(self)
        self._ticks_per_second = self.settings.ticks_per_second
        self._dt = 1.0 / self._ticks_per_second
        self._groups = 0
        self.generation = 0
        """Grows whenever the space is built anew or what is in it changes."""
        self.rebuild()

    @property
    def bodies(self) -> Mapping[str, Body]:
        """All bodies by name, in the order in which they were added."""
        return MappingProxyType(self._bodies)

    @property
    def areas(self) -> Mapping[str, Region]:
        """All areas by name."""
        return MappingProxyType(self._areas)

    @property
    def floors(self) -> tuple[FloorDescription, ...]:
        """All floors; none means endless ground at height 0."""
        return tuple(floor for floor, _ in self._floors.values())

    @property
    def described(self) -> tuple[Thing, ...]:
        """Everything as it was described, nothing drawn yet, in the order in which it was added."""
        return tuple(self._described.values())

    @property
    def dt(self) -> float:
        """A tick's length in seconds."""
        return self._dt

    @property
    def time(self) -> float:
        """Seconds since the reset, in the world's own time."""
        return self.ticks * self._dt

    def __getitem__(self, name: str) -> Body:
        body = self._bodies.get(name)
        if body is None:
            raise NameNotFoundError(f"no body is named {name!r}; {suggest(name, self._bodies)}")
        return body

    def add_body(self, name: str, shape: BodyShape, **fields: Any) -> Body:
        """Adds a body; ``fields`` are those of :class:`BodyDescription`."""
        return self.add(BodyDescription(name=name, shape=shape, **fields))

    def add_floor(self, name: str, shape: RegionShape, **fields: Any) -> None:
        """Adds ground to stand on; ``fields`` are those of :class:`FloorDescription`."""
        self.add_region(FloorDescription(name=name, shape=shape, **fields))

    def add_area(self, name: str, shape: RegionShape, **fields: Any) -> None:
        """Adds a place to ask about; ``fields`` are those of :class:`AreaDescription`."""
        self.add_region(AreaDescription(name=name, shape=shape, **fields))

    def add(self, description: BodyDescription) -> Body:
        """Adds a body from its description.

        Raises:
            WorldError: its name or its place is taken, or the world is full.
        """
        self.add_all([description])
        return self._bodies[description.name]

    def add_region(self, description: FloorDescription | AreaDescription) -> None:
        """Adds a floor or an area from its description."""
        self.add_all([description])

    def add_all(self, things: Iterable[Thing]) -> None:
        """Adds bodies, floors and areas, in this order.

        Before the first tick, whatever is random is drawn when all of them are there, so that the
        world is the one that a reset to its seed gives. Later, only what is new is drawn.

        Raises:
            WorldError: a name or a place is taken, or the world is full.
        """
        things = list(things)
        if self.ticks == 0 and (self._has_random or any(each.random for each in things)):
            self._add_and_draw(things)
            return
        for each in things:
            self._add_now(each)

    def remove(self, name: str) -> None:
        """Takes a body out of the world for good."""
        body = self[name]
        self._remove_parts(body)
        self._forget(name)

    def reset(self, seed: int | None = None) -> None:
        """Puts every body back where its description says, on a space built anew.

        What is random in that is drawn anew.

        Args:
            seed: of the coming episode; left out, it follows from the last one.

        Raises:
            WorldError: there is no room for something random; then all stays as it is.
            ParameterError: it is no seed; then all stays as it is.
        """
        before = self.seeds
        self.seeds = before.next() if seed is None else Seeds(seed)
        try:
            self.rebuild()
        except BaseException:
            self.seeds = before
            raise

    def put_back(self, name: str) -> None:
        """Puts one body back where its description says, as a reset does; all others stay.

        What is random in that is drawn anew. Nobody holds it or touches it then; it pushes aside
        what stands in its place.

        Raises:
            WorldError: there is no room for something random; then all stays as it is.
        """
        body = self[name]
        chance = self.seeds.child(f"put back/{name}")
        body.sampled = place_now(self, body.description, int(chance.integers(2**63)))
        self._remove_parts(body)
        self._embody(body)
        self._height.settle(body, body.sampled.z)
        self._height.rest(body)

    def rebuild(self) -> None:
        """Builds the physics anew: one that is only put back remembers old contacts.

        Raises:
            WorldError: there is no room for something random; then all stays as it is.
        """
        if self._has_random:
            self._draw()
        release_space(self.space)
        self.space = pymunk.Space()
        self.space.damping = self.settings.damping
        self.space.collision_slop, self.space.collision_bias = SLOP, BIAS
        self.ticks = 0
        self.owners = {}
        self._step = step_function(self.space, self._dt)
        self.contacts.attach(self.space, self.owners)
        self._groups = 0
        for body in self._bodies.values():
            if not self._has_random:
                body.sampled = body.description  # it may have been changed where it stood
            self._embody(body)
        self._rest_all()

    def tick(self) -> None:
        """Moves the world by one tick."""
        contacts = self.contacts
        self.ticks = contacts.tick = ticks = self.ticks + 1
        self._step()
        if self._height.movers:
            self._height.step(self._dt)
        if contacts.error is not None or ticks % self._ticks_per_second == 0:
            contacts.raise_error()
            if ticks % self._ticks_per_second == 0:
                self._check_finite()

    def ground(self, x: float, y: float) -> float | None:
        """The height of the highest floor at a place; None over the void."""
        return self._height.ground(x, y)

    def bounds(self) -> Rectangle:
        """A rectangle ((x0, y0), (x1, y1)), metres, around all floors and bodies.

        As described, and wherever chance may put them: it is the same in every episode.
        """
        things = self._described.values()
        return around(each for each in things if not isinstance(each, AreaDescription))

    def count_contacts(self) -> int:
        """How many pairs of bodies touch, about; takes a while where there are many."""
        found: list[pymunk.Arbiter] = []
        for body in self.bodies.values():
            body._pm.each_arbiter(found.append)
        return (len(found) + 1) // 2

    def filter_for(self, body: BodyView | None, mask: int) -> pymunk.ShapeFilter:
        """A filter that lets through what the mask names, but not the body itself."""
        group = 0 if body is None or not body._shapes else body._shapes[0].filter.group
        return pymunk.ShapeFilter(group=group, mask=mask)

    def _floor_regions(self) -> Iterator[tuple[FloorDescription, Region]]:
        yield from self._floors.values()

    def _add_now(self, thing: Thing) -> None:
        """Adds one thing to what is there, wherever that is now."""
        self._check_name(thing)
        if isinstance(thing, BodyDescription):
            self._add_body(thing, place_now(self, thing))
        else:
            self._put_region(place_now(self, thing))
            if isinstance(thing, FloorDescription):
                self._rest_all()
            self.generation += 1
        self._know(thing)

    def _add_and_draw(self, things: list[Thing]) -> None:
        """Adds things to a world that has not begun, and finds a place for all that is random."""
        added = []
        try:
            for thing in things:
                self._check_name(thing)
                added.append(thing.name)
                if isinstance(thing, BodyDescription):
                    self._bodies[thing.name] = Body(self, thing)
                self._know(thing)
            self.rebuild()
            for name in added:
                if name in self._bodies:
                    self._check_place(self._bodies[name])
        except WorldError:
            for name in added:
                self._forget(name)
            self.rebuild()
            raise

    def _add_body(self, description: BodyDescription, drawn: BodyDescription) -> None:
        body = Body(self, description)
        body.sampled = drawn
        self._embody(body)
        self._height.settle(body, drawn.z)
        try:
            self._check_place(body)
        except WorldError:
            self._remove_parts(body)
            raise
        self._bodies[body.name] = body
        self._height.rest(body)

    def _put_region(self, drawn: FloorDescription | AreaDescription) -> None:
        if isinstance(drawn, FloorDescription):
            self._floors[drawn.name] = drawn, Region(drawn)
        else:
            self._areas[drawn.name] = Region(drawn)

    def _know(self, thing: Thing) -> None:
        self._described[thing.name] = thing
        self._has_random = self._has_random or thing.random is not None

    def _forget(self, name: str) -> None:
        for things in (self._described, self._bodies, self._floors, self._areas):
            things.pop(name, None)
        self._has_random = any(thing.random for thing in self._described.values())

    def _draw(self) -> None:
        """Finds a place in this episode for all that is random."""
        found = randomize(self.seeds.seed, self._described.values())
        for thing in found.values():
            if isinstance(thing, BodyDescription):
                self._bodies[thing.name].sampled = thing
            else:
                self._put_region(thing)
        self.generation += 1

    def _embody(self, body: Body) -> None:
        self._groups += 1
        build(body, self.space, self._groups)
        body.fallen = False
        for shape in body._shapes:
            self.owners[shape] = body
        self.generation += 1

    def _rest_all(self) -> None:
        self._height.rebuild()
        bodies = [body for body in self._bodies.values() if not body.fallen]
        if self.ticks == 0:  # later, a new floor lifts nothing that is under way
            for body in bodies:
                self._height.settle(body, body.description.z)
        for body in bodies:
            self._height.rest(body)

    def _place(self, body: Body, x: float, y: float, angle: float, z: float | None) -> None:
        if body.fallen:
            self.space.add(body._pm, *body._shapes)
            body.fallen = False
        detach(self, body)
        body._pm.position, body._pm.angle = (x, y), angle
        body._pm.velocity, body._pm.angular_velocity = (0.0, 0.0), 0.0
        body._pm.force, body._pm.torque = (0.0, 0.0), 0.0
        self.space.reindex_shapes_for_body(body._pm)
        before = body.z
        self._height.settle(body, z)
        self._height.rest(body)
        if body.z != before and not body.moves:
            self.generation += 1  # rays look at the height of what can't fall only once

    def _drop(self, body: Body) -> None:
        """Takes a body out of the physics; it stays known."""
        body.fallen = True
        detach(self, body)
        self.space.remove(body._pm, *body._shapes)
        self.contacts.forget(body)
        body._pm.velocity, body._pm.angular_velocity, body.vz = (0.0, 0.0), 0.0, 0.0
        self._height.forget(body)

    def _remove_parts(self, body: Body) -> None:
        detach(self, body)
        if not body.fallen:
            self.space.remove(body._pm, *body._shapes)
        self.contacts.forget(body)
        for shape in body._shapes:
            del self.owners[shape]
        self._height.forget(body)
        self.generation += 1

    def _check_place(self, body: Body) -> None:
        """Raises WorldError if a body was put into another one."""
        taken = in_the_way(self, body)
        if taken is not None:
            raise WorldError(
                f"body {body.name!r}: its place {body.sampled.position} overlaps body "
                f"{taken.name!r} at {taken.sampled.position}; move one of them",
                thing=body.name,
            )

    def _check_name(self, thing: Thing) -> None:
        known = self._described.get(thing.name)
        problem = ""
        if known is not None:
            problem = f"{thing.name!r} is already the name of {KIND[type(known)]}; names are unique"
        elif isinstance(thing, BodyDescription) and len(self._bodies) >= MAX_BODIES:
            problem = (
                f"body {thing.name!r}: the world is full; expected at most {MAX_BODIES} bodies; "
                "remove some, or build walls from longer segments"
            )
        if problem:
            raise WorldError(problem, thing=thing.name)

    def _check_finite(self) -> None:
        for body in self._bodies.values():
            x, y, _, heading = body.pose
            if not math.isfinite(x + y + heading):
                raise WorldError(
                    f"body {body.name!r} is at ({x}, {y}): the physics went out of range; "
                    "are masses or speeds extreme?"
                )
