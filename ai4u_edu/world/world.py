"""The world: a plane with height, bodies by name, and a fixed tick."""

import math
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any

import pymunk

from ai4u_edu.base.errors import NameNotFoundError, WorldError, suggest
from ai4u_edu.base.seeding import Seeds
from ai4u_edu.world import construction
from ai4u_edu.world.body import Body, BodyView
from ai4u_edu.world.bounds import Rectangle, bounds_of
from ai4u_edu.world.descriptions import (
    AreaDescription,
    BodyDescription,
    FloorDescription,
    WorldSettings,
)
from ai4u_edu.world.physics import Physics
from ai4u_edu.world.placement import Thing
from ai4u_edu.world.region import Region
from ai4u_edu.world.registry import Registry
from ai4u_edu.world.shapes import BodyShape, RegionShape


class World:
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
        self.ticks = 0
        """Ticks since the reset."""
        self._registry = Registry()
        self._physics = Physics(self.settings)
        self.contacts = self._physics.contacts
        self._ticks_per_second = self.settings.ticks_per_second
        self.rebuild()

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
    def space(self) -> pymunk.Space:
        """Pymunk's space of this episode."""
        return self._physics.space

    @property
    def owners(self) -> Mapping[pymunk.Shape, Body]:
        """The body of each shape in the space."""
        return self._physics.owners

    @property
    def generation(self) -> int:
        """A number that grows whenever the space is built anew or its contents change."""
        return self._physics.generation

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
            raise NameNotFoundError(f"no body is named {name!r}; {suggest(name, bodies)}")
        return body

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

    def add_all(self, things: Iterable[Thing]) -> None:
        """Add bodies, floors and areas, in this order.

        Before the first tick everything random is sampled together, so that the world is the one
        that a reset to its seed gives. Later, only the new things are sampled.

        Raises:
            WorldError: a name or a place is taken, or the world is full.
        """
        construction.add_all(self, things)

    def remove(self, name: str) -> None:
        """Remove a body for good."""
        construction.remove(self, name)

    def put_back(self, name: str) -> None:
        """Put one body back to its described place, as a reset does; all others stay.

        Its random values are sampled anew. It is not held and touches nothing then, and pushes
        aside what stands in its place.

        Raises:
            WorldError: there is no room for something random; then nothing changes.
        """
        construction.put_back(self, name)

    def rebuild(self) -> None:
        """Build the physics anew, with all bodies in their places of this episode.

        Raises:
            WorldError: there is no room for something random; then nothing changes.
        """
        construction.rebuild(self)

    # -- running ---------------------------------------------------------------------------------

    def reset(self, seed: int | None = None) -> None:
        """Put every body back to its described place, in a space that is built anew.

        Random values are sampled anew.

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
        self.ticks = contacts.tick = ticks = self.ticks + 1
        physics.step()
        if physics.height.movers:
            physics.height.step(physics.dt)
        if contacts.error is not None or ticks % self._ticks_per_second == 0:
            contacts.raise_error()
            if ticks % self._ticks_per_second == 0:
                self._check_finite()

    # -- queries ---------------------------------------------------------------------------------

    def ground(self, x: float, y: float) -> float | None:
        """Return the height of the highest floor at a place; None over the void."""
        return self._physics.height.ground(x, y)

    def bounds(self) -> Rectangle:
        """Return a rectangle ((x0, y0), (x1, y1)), metres, around all floors and bodies.

        It covers all places that they may be given in any episode.
        """
        things = self._registry.described.values()
        return bounds_of(each for each in things if not isinstance(each, AreaDescription))

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
            x, y, _, heading = body.pose
            if not math.isfinite(x + y + heading):
                raise WorldError(
                    f"body {body.name!r} is at ({x}, {y}): the physics went out of range; "
                    "are masses or speeds extreme?"
                )
