"""The world: a plane with height, bodies by name, and a fixed tick."""

import math
from collections.abc import Iterable, Mapping
from functools import partial
from types import MappingProxyType
from typing import Any

import pymunk

from ai4u_edu.base.attributes import NoStrayAttributes
from ai4u_edu.base.errors import NameNotFoundError, WorldError, suggest
from ai4u_edu.base.seeding import Seeds
from ai4u_edu.locale import gettext as _
from ai4u_edu.world.body import Body, BodyView
from ai4u_edu.world.descriptions import (
    AreaDescription,
    BodyDescription,
    FloorDescription,
    WorldSettings,
)
from ai4u_edu.world.fields import AnyField
from ai4u_edu.world.ink import Ink
from ai4u_edu.world.messages import Messages
from ai4u_edu.world.native import IS_NATIVE, contact_distances
from ai4u_edu.world.physics import Physics
from ai4u_edu.world.placement import (
    MAX_OVERLAP_M,
    Places,
    Thing,
    ThingT,
    is_overlap,
    place_field,
    randomize,
)
from ai4u_edu.world.region import Region
from ai4u_edu.world.registry import Rectangle, Registry
from ai4u_edu.world.shapes import BodyShape, RegionShape
from ai4u_edu.world.state import BodyMotion, Motion, WorldState


class World(NoStrayAttributes):
    """A plane with height: x right, y up on the screen, z towards the viewer; SI units.

    The same descriptions, seed and inputs give the same trajectory, bit for bit.

    Args:
        seed: a whole number from 0 to 2**63 - 1; all random numbers of the episode follow from it.
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
        self._registry = Registry()
        self._physics = Physics(self.settings)
        self.ink = Ink(self._registry.floors)
        """Ink that pens have left on the floors since the world's reset."""
        self.contacts = self._physics.contacts
        self.messages = Messages(self)
        """Messages of agents since the world's reset."""
        self._ticks_per_second = self.settings.ticks_per_second
        self.rebuild()
        self._is_complete = True

    @property
    def bodies(self) -> Mapping[str, Body]:
        """All bodies by name, in the order of addition."""
        return MappingProxyType(self._registry.bodies)

    @property
    def areas(self) -> Mapping[str, Region]:
        """All areas by name."""
        return MappingProxyType(self._registry.areas)

    @property
    def floors(self) -> tuple[FloorDescription, ...]:
        """All floors; none means endless ground at height 0."""
        return tuple(floor for floor, _ in self._registry.floors.values())

    @property
    def described(self) -> tuple[Thing, ...]:
        """Everything as described, with random values not sampled, in the order of addition."""
        return tuple(self._registry.described.values())

    @property
    def field(self) -> AnyField | None:
        """Description of the field that is generated at each reset; None for none."""
        return self._registry.field

    @property
    def space(self) -> pymunk.Space:
        """Pymunk's space of this episode."""
        return self._physics.space

    @property
    def owners(self) -> Mapping[pymunk.Shape, Body]:
        """The body of each shape in the space."""
        return self._physics.owners

    @property
    def generation(self) -> int:
        """A number that grows whenever the space is replaced or its contents change."""
        return self._physics.generation

    @property
    def ticks(self) -> int:
        """Ticks since the reset."""
        return self.contacts.tick

    @property
    def dt(self) -> float:
        """Length of a tick in seconds."""
        return self._physics.dt

    @property
    def time(self) -> float:
        """Seconds since the reset, in the world's own time."""
        return self.ticks * self._physics.dt

    def __getitem__(self, name: str) -> Body:
        bodies = self._registry.bodies
        body = bodies.get(name)
        if body is None:
            raise NameNotFoundError(
                _("no body is named {name!r}; {hint}", name=name, hint=suggest(name, bodies))
            )
        return body

    def _about(self, name: str) -> str:
        """Return a sentence about an attribute that it does not have, such as a setting."""
        settings = WorldSettings.model_fields
        near = name if name in settings else suggest(name, settings)
        for each in settings:
            if each in near and len(near) < len(each) + 20:
                return _(
                    "{owner} has no attribute {name!r}; expected the setting in "
                    "World({setting}=...) or in the scene, or for one episode in "
                    "sim.reset(options={{'world.{setting}': ...}})",
                    owner=type(self).__name__,
                    name=name,
                    setting=each,
                )
        return super()._about(name)

    # -- construction ----------------------------------------------------------------------------

    def add_body(self, name: str, shape: BodyShape, **fields: Any) -> Body:
        """Add a body; ``fields`` are those of :class:`BodyDescription`."""
        return self.add(BodyDescription(name=name, shape=shape, **fields))

    def add_floor(self, name: str, shape: RegionShape, **fields: Any) -> None:
        """Add ground to stand on; ``fields`` are those of :class:`FloorDescription`."""
        self.add_region(FloorDescription(name=name, shape=shape, **fields))

    def add_area(self, name: str, shape: RegionShape, **fields: Any) -> None:
        """Add an area for blocks to refer to; ``fields`` are those of :class:`AreaDescription`."""
        self.add_region(AreaDescription(name=name, shape=shape, **fields))

    def add(self, description: BodyDescription) -> Body:
        """Add a body from its description.

        Raises:
            WorldError: its name or its place is taken, or the world is full.
        """
        self.add_all([description])
        return self._registry.bodies[description.name]

    def add_region(self, description: FloorDescription | AreaDescription) -> None:
        """Add a floor or an area from its description."""
        self.add_all([description])

    def add_all(self, things: Iterable[Thing], field: AnyField | None = None) -> None:
        """Add bodies, floors and areas, in this order, and a field that has places for them.

        Before the first tick everything random is sampled together, so that the world is the one
        that a reset to its seed gives. Later, only the new things are sampled.

        Raises:
            WorldError: a name or a place is taken, or the world is full.
        """
        things = list(things)
        if field is not None:
            self._add_and_rebuild(things, field)
        elif self.ticks == 0 and (self._registry.has_random or any(each.random for each in things)):
            self._add_and_rebuild(things, self.field)
        else:
            for each in things:
                self._add_now(each)

    def set_field(self, field: AnyField | None) -> None:
        """Generate a field for this episode and each later one, by its seed; None for none.

        Raises:
            WorldError: what it places is not there, or there is no room; then nothing changes.
        """
        self._add_and_rebuild([], field)

    def remove(self, name: str) -> None:
        """Remove a body for good.

        Raises:
            NameNotFoundError: no body has that name.
        """
        self._physics.remove(self[name])
        self._registry.forget(name)

    def put_back(self, name: str) -> None:
        """Put one body back to its described place, as a reset does; all others stay.

        Its random values are sampled again. It is not held and touches nothing then, and pushes
        aside what stands in its place.

        Raises:
            WorldError: there is no room for something random; then nothing changes.
        """
        body, physics = self[name], self._physics
        rng = self.seeds.child(f"put back/{name}")
        body.sampled = self._place_now(body.description, int(rng.integers(2**63)))
        physics.remove(body)
        physics.add(body)
        physics.height.set_height(body, body.sampled.z)
        physics.height.update_support(body)

    def rebuild(self) -> None:
        """Build new physics, with all bodies in their places of this episode.

        Raises:
            WorldError: there is no room for something random; then nothing changes.
        """
        registry = self._registry
        if registry.has_random:
            self._sample_all()
        self.contacts.tick = 0
        self.ink.clear()
        self.messages.clear()
        self._physics.start_over()
        for body in registry.bodies.values():
            if not registry.has_random:
                body.sampled = body.description  # an edit may have changed it in its place
            self._physics.add(body)
        self._update_heights()

    def _add_now(self, thing: Thing) -> None:
        """Add one thing; everything else stays where it is now.

        Raises:
            WorldError: its name or its place is taken, or the world is full.
        """
        registry = self._registry
        registry.check_name(thing)
        if isinstance(thing, BodyDescription):
            self._add_body(thing, self._place_now(thing))
        else:
            registry.put_region(self._place_now(thing))
            if isinstance(thing, FloorDescription):
                self._update_heights()
            self._physics.generation += 1
        registry.register(thing)

    def _add_body(self, description: BodyDescription, sampled: BodyDescription) -> None:
        body, physics = Body(self, description), self._physics
        body.sampled = sampled
        physics.add(body)
        physics.height.set_height(body, sampled.z)
        try:
            self._check_place(body)
        except WorldError:
            physics.remove(body)
            raise
        self._registry.bodies[body.name] = body
        physics.height.update_support(body)

    def _add_and_rebuild(self, things: list[Thing], field: AnyField | None) -> None:
        """Add things before the first tick, and find places for everything random."""
        registry, added = self._registry, list[str]()
        before = registry.field
        try:
            registry.set_field(field)
            for thing in things:
                registry.check_name(thing)
                added.append(thing.name)
                if isinstance(thing, BodyDescription):
                    registry.bodies[thing.name] = Body(self, thing)
                registry.register(thing)
            self.rebuild()
            for name in added:
                if name in registry.bodies:
                    self._check_place(registry.bodies[name])
        except WorldError:
            for name in added:
                registry.forget(name)
            registry.set_field(before)
            self.rebuild()
            raise

    def _sample_all(self) -> None:
        """Sample everything random for this episode."""
        registry, seed = self._registry, self.seeds.seed
        things: Iterable[Thing] = registry.described.values()
        if registry.field is not None:
            placed, pieces = place_field(registry.field, list(things), seed)
            things = [*(placed.get(thing.name, thing) for thing in things), *pieces]
            sampled = randomize(seed, things)
            registry.put_pieces(pieces, placed, partial(Body, self))
        else:
            sampled = randomize(seed, things)
        for thing in sampled.values():
            if isinstance(thing, BodyDescription):
                registry.bodies[thing.name].sampled = thing
            else:
                registry.put_region(thing)
        self._physics.generation += 1

    def _place_now(self, thing: ThingT, seed: int | None = None) -> ThingT:
        """Return a thing as sampled now, at a free place among the others.

        Args:
            thing: its description.
            seed: seed of the samples; by default the episode's.

        Raises:
            WorldError: there is no room for it.
        """
        placed: Any = self._registry.placed.get(thing.name)
        if placed is not None or thing.random is None:
            return thing if placed is None else placed
        places = Places(self.seeds.seed if seed is None else seed)
        for floor in self.floors:
            places.occupy(floor)
        for other in self.bodies.values():
            if not other.fallen and other.name != thing.name:
                x, y, z, heading = other.pose
                now = {"position": (x, y), "z": z, "heading_deg": math.degrees(heading)}
                places.occupy(other.sampled.model_copy(update=now), _clearance(other.description))
        for name, area in self.areas.items():
            if isinstance(area.description, AreaDescription):
                places.occupy(area.description, _clearance(self._registry.described[name]))
        return places.find(thing)

    def _update_heights(self) -> None:
        """Find out what every body stands on, after the floors have changed."""
        height = self._physics.height
        height.rebuild(self._registry.floors.values())
        bodies = [body for body in self._registry.bodies.values() if not body.fallen]
        if self.ticks == 0:  # later, a new floor lifts no body
            for body in bodies:
                height.set_height(body, body.description.z)
        for body in bodies:
            height.update_support(body)

    def _check_place(self, body: Body) -> None:
        """Raise a WorldError if a body overlaps another one."""
        other = self.find_overlap(body)
        if other is not None:
            raise WorldError(
                _(
                    "body {name!r}: its place {position} overlaps body {name2!r} at {position2}; "
                    "move one of them",
                    name=body.name,
                    position=str(body.sampled.position),
                    name2=other.name,
                    position2=str(other.sampled.position),
                ),
                thing=body.name,
            )

    # -- running ---------------------------------------------------------------------------------

    def reset(self, seed: int | None = None) -> None:
        """Put every body back to its described place, in a new space.

        Random values are sampled again.

        Args:
            seed: the episode's seed; by default it follows from the last one.

        Raises:
            WorldError: there is no room for something random; then nothing changes.
            ParameterError: it is no seed; then nothing changes.
        """
        before = self.seeds
        self.seeds = before.next() if seed is None else Seeds(seed)
        try:
            self.rebuild()
        except BaseException:
            self.seeds = before
            raise

    def tick(self) -> None:
        """Move the world by one tick.

        Raises:
            WorldError: a position is not finite any more; checked once a second.
        """
        physics, contacts = self._physics, self.contacts
        contacts.tick = ticks = contacts.tick + 1
        physics.step()
        if physics.height.movers:
            physics.height.step(physics.dt)
        if contacts.has_news or ticks % self._ticks_per_second == 0:
            contacts.settle()
            if ticks % self._ticks_per_second == 0:
                self._check_finite()

    # -- its state, for a copy -------------------------------------------------------------------

    def get_state(self, *, with_motions: bool = True) -> WorldState:
        """Return everything that changes while the world runs; call it between two ticks.

        Args:
            with_motions: False leaves out motions and presses, which take most of the time.
        """
        bodies = self._registry.bodies
        holders = bodies.values() if self.space.constraints else ()
        return WorldState(
            seed=self.seeds.seed,
            ticks=self.ticks,
            generators=self.seeds.get_state(),
            held=tuple((body.name, body.held.name) for body in holders if body.held is not None),
            sampled={
                body.name: body.sampled for body in bodies.values() if body.description.random
            },
            contacts=self.contacts.get_state(with_presses=with_motions),
            ink=self.ink.image(),
            messages=self.messages.get_state(),
            motions={name: _motion(body) for name, body in bodies.items()} if with_motions else {},
        )

    def set_state(self, state: WorldState) -> None:
        """Go on from the state of another world of the same description.

        Bodies that only one of the two has are as after a reset.

        Args:
            state: of :meth:`get_state`; this world has just been reset to its seed.
        """
        bodies = self._registry.bodies
        for name, sampled in state.sampled.items():
            if name in bodies and bodies[name].sampled != sampled:
                self._place_as(name, sampled)
        for name, motion in state.motions.items():
            if name in bodies:
                self._set_motion(name, motion)
        self.contacts.set_state(state.contacts, self._physics.step)
        for holder, held in state.held:
            if holder in bodies and held in bodies:
                bodies[holder].hold(bodies[held])
        self.contacts.tick = state.ticks
        self.ink.set_image(state.ink)
        self.messages.set_state(state.messages)
        self.seeds.set_state(state.generators)

    def _place_as(self, name: str, sampled: BodyDescription) -> None:
        """Put a body to the place that was sampled for it in another copy of this world."""
        body, physics = self[name], self._physics
        physics.remove(body)
        body.sampled = sampled
        physics.add(body)
        physics.height.set_height(body, sampled.z)
        physics.height.update_support(body)

    def _set_motion(self, name: str, motion: Motion) -> None:
        """Put a body where it is in another copy of this world, with the same speeds."""
        body, physics = self[name], self._physics
        if motion.fallen or not math.isfinite(motion.x + motion.y + motion.z):
            if not body.fallen:
                physics.drop(body)
            body.on_ground = motion.on_ground
            if math.isfinite(motion.x + motion.y + motion.z):
                body._pm.position, body._pm.angle = (motion.x, motion.y), motion.heading
                body.z = motion.z
            return
        here = (*body._pm.position, body.z, body._pm.angle)
        if body.fallen or here != (motion.x, motion.y, motion.z, motion.heading):
            physics.place(body, motion.x, motion.y, motion.heading, motion.z)
        if body.description.kind != "static":
            body._pm.velocity = motion.vx, motion.vy
            body._pm.angular_velocity = motion.angular_velocity
        if body.moves and body.on_ground != motion.on_ground:
            physics.height.set_on_ground(body, motion.on_ground)
        body.vz = motion.vz

    # -- queries ---------------------------------------------------------------------------------

    def ground(self, x: float, y: float) -> float | None:
        """Return the height of the highest floor at a place; None over the void."""
        return self._physics.height.ground(x, y)

    def bounds(self) -> Rectangle:
        """Return a rectangle ((x0, y0), (x1, y1)), metres, around all floors and bodies.

        It covers all places that they may be given in any episode.
        """
        return self._registry.bounds()

    def find_overlap(self, body: BodyView) -> Body | None:
        """Return a body that overlaps a given one, or None; two that can't move may overlap."""
        if not body.moves and IS_NATIVE:
            return self._find_overlapping_mover(body)
        for shape in body._shapes:
            for hit in self.space.shape_query(shape):
                other = self.owners.get(hit.shape)
                if other is None or other is body or not (body.moves or other.moves):
                    continue
                found = [point.distance for point in hit.contact_point_set.points]
                if _level(body, other) and is_overlap(shape, body._pm, hit.shape, other._pm, found):
                    return other
        return None

    def _find_overlapping_mover(self, body: BodyView) -> Body | None:
        """Return a body that can move and overlaps a given one that can't.

        A query of the space would also return all bodies that can't move: with hundreds of
        overlapping walls, that took seconds (``python -m tests.benchmarks.many_walls``).
        """
        x, y = body.position
        for other in self._registry.bodies.values():
            if not other.moves or other is body or other.fallen:
                continue
            reach = body.sampled.shape.reach + other.sampled.shape.reach + MAX_OVERLAP_M
            if math.dist((x, y), other.position) > reach or not _level(body, other):
                continue
            for shape in body._shapes:
                for its in other._shapes:
                    if _pass_through(shape.filter, its.filter):
                        continue
                    found = contact_distances(shape, its, other._pm)
                    if is_overlap(shape, body._pm, its, other._pm, found):
                        return other
        return None

    def count_contacts(self) -> int:
        """Return the approximate number of touching pairs of bodies; slow where there are many."""
        found: list[pymunk.Arbiter] = []
        for body in self.bodies.values():
            body._pm.each_arbiter(found.append)
        return (len(found) + 1) // 2

    def filter_for(self, body: BodyView | None, mask: int) -> pymunk.ShapeFilter:
        """Return a filter of the layers in a mask that leaves out a body's own shapes."""
        group = 0 if body is None or not body._shapes else body._shapes[0].filter.group
        return pymunk.ShapeFilter(group=group, mask=mask)

    def _check_finite(self) -> None:
        for body in self._registry.bodies.values():
            if not body.is_finite:
                x, y = body.position
                raise WorldError(
                    _(
                        "body {name!r} is at ({x}, {y}): the physics went out of range; are "
                        "masses or speeds extreme?",
                        name=body.name,
                        x=x,
                        y=y,
                    )
                )


def _motion(body: Body) -> BodyMotion:
    x, y = body._pm.position
    return BodyMotion(
        x,
        y,
        body.z,
        body._pm.angle,
        *body.velocity,
        body.vz,
        body.angular_velocity,
        body.on_ground,
        body.fallen,
    )


def _clearance(described: Thing) -> float:
    return described.random.clearance if described.random else 0.0


def _level(body: BodyView, other: BodyView) -> bool:
    """Return True if neither of two bodies is above the other one."""
    return body.z < other.z + other.height and other.z < body.z + body.height


def _pass_through(one: pymunk.ShapeFilter, other: pymunk.ShapeFilter) -> bool:
    """Return True if the physics lets two shapes pass through each other."""
    return not (one.categories & other.mask and other.categories & one.mask)
