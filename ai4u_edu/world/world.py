"""The world: a plane with height, bodies by name, and a fixed tick."""

import math
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any

import pymunk

from ai4u_edu.errors import NameNotFoundError, WorldError, suggest
from ai4u_edu.seeding import Seeds
from ai4u_edu.world._chipmunk import let_go
from ai4u_edu.world.body import Body, BodyView
from ai4u_edu.world.build import build
from ai4u_edu.world.contacts import Contacts
from ai4u_edu.world.descriptions import (
    AreaDescription,
    BodyDescription,
    FloorDescription,
    RegionDescription,
    WorldSettings,
)
from ai4u_edu.world.grip import tear_off
from ai4u_edu.world.height import Height
from ai4u_edu.world.region import Region
from ai4u_edu.world.shapes import BodyShape, RegionShape

MAX_BODIES = 500

OVERLAP = 1e-3
"""Bodies may be put this far into each other (metres): touching is no overlap."""

SLOP = 0.01
"""How far into each other bodies come to rest (metres); some of it keeps contacts steady."""

BIAS = 0.2**60
"""What is left of a deeper overlap after a second; after 1/60 s that is a fifth.

A velocity that is set anew each tick drives a body into a wall for one tick, before the wall can
answer; with pymunk's own nine tenths that adds up to half a metre at 3 m/s.
"""


class World:
    """A plane with height: x right, y up on the screen, z towards the viewer; SI units.

    The same descriptions, seed and inputs give the same trajectory, bit for bit.

    Args:
        seed: a whole number >= 0; all chance of the episode grows from it.
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
        self._bodies: dict[str, Body] = {}
        self._floors: dict[str, tuple[FloorDescription, Region]] = {}
        self._areas: dict[str, Region] = {}
        self._height = Height(self)
        self._dt = 1.0 / self.settings.ticks_per_second
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
        self._check_name(description.name)
        if len(self._bodies) >= MAX_BODIES:
            raise WorldError(
                f"body {description.name!r}: the world is full; expected at most {MAX_BODIES} "
                "bodies; remove some, or build walls from longer segments"
            )
        body = Body(self, description)
        self._embody(body)
        self._height.settle(body, description.z)
        taken = self._taken_by(body)
        if taken is not None:
            self._remove_parts(body)
            raise WorldError(
                f"body {description.name!r}: its place {description.position} overlaps body "
                f"{taken.name!r} at {taken.description.position}; move one of them"
            )
        self._bodies[description.name] = body
        self._height.rest(body)
        return body

    def add_region(self, description: FloorDescription | AreaDescription) -> None:
        """Adds a floor or an area from its description."""
        self._check_name(description.name)
        if isinstance(description, FloorDescription):
            self._floors[description.name] = description, Region(description)
            self._rest_all()
        else:
            self._areas[description.name] = Region(description)
        self.generation += 1

    def remove(self, name: str) -> None:
        """Takes a body out of the world for good."""
        body = self[name]
        self._remove_parts(body)
        del self._bodies[name]

    def reset(self, seed: int | None = None) -> None:
        """Puts every body back where its description says, on a space built anew.

        Args:
            seed: of the coming episode; left out, it follows from the last one.
        """
        self.seeds = self.seeds.next() if seed is None else Seeds(seed)
        self.rebuild()

    def rebuild(self) -> None:
        """Builds the physics anew: one that is only put back remembers old contacts."""
        let_go(self.space)
        self.space = pymunk.Space()
        self.space.damping = self.settings.damping
        self.space.collision_slop, self.space.collision_bias = SLOP, BIAS
        self.ticks = 0
        self.owners = {}
        self.contacts.attach(self.space, self.owners)
        self._groups = 0
        for body in self._bodies.values():
            self._embody(body)
        self._rest_all()

    def tick(self) -> None:
        """Moves the world by one tick."""
        self.ticks = self.contacts.tick = self.ticks + 1
        self.space.step(self._dt)
        if self._height.movers:
            self._height.step(self._dt)
        if self.contacts.error is not None:
            error, self.contacts.error = self.contacts.error, None
            raise error
        if self.ticks % self.settings.ticks_per_second == 0:
            self._check_finite()

    def ground(self, x: float, y: float) -> float | None:
        """The height of the highest floor at a place; None over the void."""
        return self._height.ground(x, y)

    def bounds(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """A rectangle ((x0, y0), (x1, y1)), metres, around all floors and bodies as described."""
        corners = [_extent(floor) for floor in self.floors]
        corners += [_extent(body.description) for body in self._bodies.values()]
        if not corners:
            return (-5.0, -5.0), (5.0, 5.0)
        left, low, right, high = zip(*corners, strict=True)
        return (min(left), min(low)), (max(right), max(high))

    def filter_for(self, body: BodyView | None, mask: int) -> pymunk.ShapeFilter:
        """A filter that lets through what the mask names, but not the body itself."""
        group = 0 if body is None or not body._shapes else body._shapes[0].filter.group
        return pymunk.ShapeFilter(group=group, mask=mask)

    def _floor_regions(self) -> Iterator[tuple[FloorDescription, Region]]:
        yield from self._floors.values()

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
        tear_off(self, body)
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
        """Takes a body that fell below the threshold out of the physics."""
        body.fallen = True
        tear_off(self, body)
        self.space.remove(body._pm, *body._shapes)
        self.contacts.forget(body)
        body._pm.velocity, body._pm.angular_velocity, body.vz = (0.0, 0.0), 0.0, 0.0
        del self._height.movers[body]

    def _remove_parts(self, body: Body) -> None:
        tear_off(self, body)
        if not body.fallen:
            self.space.remove(body._pm, *body._shapes)
        self.contacts.forget(body)
        for shape in body._shapes:
            del self.owners[shape]
        self._height.movers.pop(body, None)
        self.generation += 1

    def _taken_by(self, body: Body) -> Body | None:
        for shape in body._shapes:
            for hit in self.space.shape_query(shape):
                other = self.owners.get(hit.shape)
                if other is None or other is body or not (body.moves or other.moves):
                    continue
                level = body.z < other.z + other.height and other.z < body.z + body.height
                if level and _overlap(shape, body._pm, hit, other._pm):
                    return other
        return None

    def _check_name(self, name: str) -> None:
        for kind, known in (
            ("body", self._bodies),
            ("floor", self._floors),
            ("area", self._areas),
        ):
            if name in known:
                raise WorldError(f"{name!r} is already the name of a {kind}; names are unique")

    def _check_finite(self) -> None:
        for body in self._bodies.values():
            x, y = body._pm.position
            if not math.isfinite(x + y + body._pm.angle):
                raise WorldError(
                    f"body {body.name!r} is at ({x}, {y}): the physics went out of range; "
                    "are masses or speeds extreme?"
                )


def _overlap(
    shape: pymunk.Shape, pm: pymunk.Body, hit: pymunk.ShapeQueryInfo, other: pymunk.Body
) -> bool:
    # for some pairs of shapes the distance comes with the wrong sign, and as 0 for two that lie
    # exactly upon each other
    deepest = max(abs(point.distance) for point in hit.contact_point_set.points)
    return (
        deepest > OVERLAP
        or _depth(hit.shape, pm.local_to_world(shape.center_of_gravity)) > OVERLAP
        or _depth(shape, other.local_to_world(hit.shape.center_of_gravity)) > OVERLAP
    )


def _depth(shape: pymunk.Shape, place: tuple[float, float]) -> float:
    return -shape.point_query(place).distance


def _extent(
    description: BodyDescription | RegionDescription,
) -> tuple[float, float, float, float]:
    x, y = description.position
    angle = math.radians(description.heading_deg)
    cos, sin = math.cos(angle), math.sin(angle)
    points = description.shape.outline()
    xs = [x + cos * px - sin * py for px, py in points]
    ys = [y + sin * px + cos * py for px, py in points]
    return min(xs), min(ys), max(xs), max(ys)
