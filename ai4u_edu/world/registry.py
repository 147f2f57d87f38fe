"""The things in a world by name: descriptions, bodies, floors and areas."""

import math
from collections.abc import Callable, Iterable
from itertools import product

from ai4u_edu.base.errors import WorldError
from ai4u_edu.locale import Text
from ai4u_edu.locale import gettext as _
from ai4u_edu.world.body import Body
from ai4u_edu.world.descriptions import (
    AreaDescription,
    BodyDescription,
    FloorDescription,
    RegionDescription,
)
from ai4u_edu.world.fields import AnyField
from ai4u_edu.world.placement import Thing
from ai4u_edu.world.region import Region

MAX_BODIES = 500

Rectangle = tuple[tuple[float, float], tuple[float, float]]
_EMPTY_WORLD: Rectangle = (-5.0, -5.0), (5.0, 5.0)

_TAKEN = {
    BodyDescription: _("{name!r} is already the name of a body; names are unique"),
    FloorDescription: _("{name!r} is already the name of a floor; names are unique"),
    AreaDescription: _("{name!r} is already the name of an area; names are unique"),
}


class Registry:
    """All things of a world; bodies, floors and areas share one set of names.

    Attributes:
        described: everything as described, in the order of addition.
        bodies: by name, in the order of addition.
        floors: description and region, as sampled for this episode.
        areas: regions, as sampled for this episode.
        has_random: True if something is sampled at each reset.
        field: description of the field that is generated at each reset; None for none.
        placed: things that the field has put somewhere in this episode, by name.
    """

    def __init__(self) -> None:
        self.described: dict[str, Thing] = {}
        self.bodies: dict[str, Body] = {}
        self.floors: dict[str, tuple[FloorDescription, Region]] = {}
        self.areas: dict[str, Region] = {}
        self.has_random = False
        self.field: AnyField | None = None
        self.placed: dict[str, Thing] = {}
        self._pieces: list[str] = []

    def register(self, thing: Thing) -> None:
        """Enter a description under its name."""
        self.described[thing.name] = thing
        self.has_random = self.has_random or thing.random is not None

    def replace(self, thing: Thing) -> None:
        """Replace the description of the same name."""
        self.described[thing.name] = thing
        self._update_has_random()

    def forget(self, name: str) -> None:
        """Remove everything of a name."""
        for things in (self.described, self.bodies, self.floors, self.areas, self.placed):
            things.pop(name, None)
        self._update_has_random()

    def set_field(self, field: AnyField | None) -> None:
        """Set the field of the episodes from the next reset on."""
        self.field = field
        if field is None:
            for name in self._pieces:
                self.bodies.pop(name, None)
                self.areas.pop(name, None)
            self.placed, self._pieces = {}, []
        self._update_has_random()

    def put_pieces(
        self,
        pieces: Iterable[Thing],
        placed: dict[str, Thing],
        make_body: Callable[[BodyDescription], Body],
    ) -> None:
        """Replace the pieces of the last episode's field by those of this one.

        Args:
            pieces: things that no scene file names.
            placed: things of the scene, where the field has put them, by name.
            make_body: returns a body of this world.

        Raises:
            WorldError: there would be too many bodies, or a name is taken.
        """
        pieces = list(pieces)
        others = len(self.bodies) - sum(name in self.bodies for name in self._pieces)
        if others + sum(isinstance(each, BodyDescription) for each in pieces) > MAX_BODIES:
            raise WorldError(
                _(
                    "expected at most {max_bodies} bodies with the walls; make the field smaller",
                    max_bodies=MAX_BODIES,
                ),
                thing="generate",
            )
        for piece in pieces:
            if piece.name in self.described:
                raise WorldError(
                    _(
                        "{name!r} is the name of a piece of the field; choose another one",
                        name=piece.name,
                    ),
                    thing=piece.name,
                )
        for name in self._pieces:
            self.bodies.pop(name, None)
            self.areas.pop(name, None)
        for piece in pieces:
            if isinstance(piece, BodyDescription):
                self.bodies[piece.name] = make_body(piece)
        self.placed, self._pieces = placed, [piece.name for piece in pieces]

    def put_region(self, sampled: FloorDescription | AreaDescription) -> None:
        """Enter a floor or an area as sampled for this episode."""
        if isinstance(sampled, FloorDescription):
            self.floors[sampled.name] = sampled, Region(sampled)
        else:
            self.areas[sampled.name] = Region(sampled)

    def reorder(self, names: Iterable[str]) -> None:
        """Put all things into the order of these names; others come last."""
        order = {name: index for index, name in enumerate(names)}
        for things in (self.described, self.bodies, self.floors, self.areas):
            in_order = sorted(things.items(), key=lambda item: order.get(item[0], len(order)))
            things.clear()
            things.update(in_order)  # type: ignore[arg-type]  # each keeps its own kind of thing

    def check_name(self, thing: Thing) -> None:
        """Raise a WorldError if a thing's name is taken or the world is full of bodies."""
        known = self.described.get(thing.name)
        problem: str = ""
        if known is not None:
            problem = Text(_TAKEN[type(known)].msgid, {"name": thing.name})
        elif isinstance(thing, BodyDescription) and len(self.bodies) >= MAX_BODIES:
            problem = _(
                "body {name!r}: the world is full; expected at most {max_bodies} bodies; remove "
                "some, or build walls from longer segments",
                name=thing.name,
                max_bodies=MAX_BODIES,
            )
        if problem:
            raise WorldError(problem, thing=thing.name)

    def bounds(self) -> Rectangle:
        """Return ((x0, y0), (x1, y1)), metres, around all bodies and floors in any episode."""
        things = [each for each in self.described.values() if not isinstance(each, AreaDescription)]
        corners = [corner for thing in things for corner in _corners(thing)]
        corners += [] if self.field is None else self.field.bounds()
        if not corners:
            return _EMPTY_WORLD
        xs, ys = zip(*corners, strict=True)
        return (min(xs), min(ys)), (max(xs), max(ys))

    def _update_has_random(self) -> None:
        is_sampled = any(thing.random for thing in self.described.values())
        self.has_random = is_sampled or self.field is not None


def _corners(thing: BodyDescription | RegionDescription) -> list[tuple[float, float]]:
    return [(x + dx, y + dy) for x, y in _places(thing) for dx, dy in _outline(thing)]


def _places(thing: BodyDescription | RegionDescription) -> Iterable[tuple[float, float]]:
    x, y = thing.position
    vary = thing.random
    if vary is None:
        return [(x, y)]
    return vary.places or product(vary.x or (x,), vary.y or (y,))


def _outline(thing: BodyDescription | RegionDescription) -> list[tuple[float, float]]:
    """Return corners around a thing's place, of its smallest and largest scale and any heading."""
    vary = thing.random
    scales = (vary and vary.scale) or (1.0,)
    if vary is not None and vary.heading_deg is not None:
        reach = thing.shape.reach * max(scales)
        return [(-reach, -reach), (reach, reach)]
    angle = math.radians(thing.heading_deg)
    cos, sin = math.cos(angle), math.sin(angle)
    points = [point for scale in scales for point in thing.shape.scaled(scale).outline()]
    return [(cos * x - sin * y, sin * x + cos * y) for x, y in points]
