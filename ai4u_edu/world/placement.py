"""Places of things: free ones by chance, and those that a generated field has for them."""

import math
from collections.abc import Collection, Iterable, Sequence
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
import pymunk

from ai4u_edu.base.errors import WorldError, suggest
from ai4u_edu.base.parameters import Point
from ai4u_edu.base.seeding import Seeds
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.world.build import FastBody, core, make_shape, set_material
from ai4u_edu.world.descriptions import (
    AreaDescription,
    BodyDescription,
    FloorDescription,
    Variation,
)
from ai4u_edu.world.fields import AnyField, FieldBase
from ai4u_edu.world.native import contact_distances
from ai4u_edu.world.region import Ground, Region
from ai4u_edu.world.shapes import BodyShape, CircleShape, RingShape

_MAX_SAMPLES = 1000
"""Samples for each thing: where 1 in 50 is free, one episode in 10^8 fails."""

MAX_OVERLAP_M = 1e-3
"""Depth (metres) to which bodies may be put into each other: touching is no overlap."""

_RECTANGLE_MARGIN_M = 1e-6
"""Margin of a rectangle around a form, metres: more than any rounding error."""

Thing = BodyDescription | FloorDescription | AreaDescription
ThingT = TypeVar("ThingT", bound=Thing)


class _Form:
    """The space that a thing occupies.

    Args:
        thing: its description.
        shape: its shape; the whole disc for a ring, whose middle is occupied too.
        more: metres that are added on all sides.
        heights: lowest and highest point.
        rectangle: (left, bottom, right, top) around it, parallel to the axes, maybe a bit large.
    """

    def __init__(
        self,
        thing: BodyDescription | AreaDescription,
        shape: BodyShape,
        more: float,
        heights: tuple[float, float],
        rectangle: tuple[float, float, float, float],
    ) -> None:
        self._thing, self._shape, self._more = thing, shape, more
        self.low, self.high = heights
        self.left, self.bottom, self.right, self.top = rectangle

    def grown(self, more: float) -> "_Form":
        """Return the form grown by ``more`` metres on all sides, in the plane."""
        if not more:
            return self
        rectangle = self.left - more, self.bottom - more, self.right + more, self.top + more
        return _Form(self._thing, self._shape, more, (self.low, self.high), rectangle)

    def near(self, other: "_Form") -> bool:
        """Return False if rectangles or heights show that two forms don't overlap."""
        return (
            self.left <= other.right
            and other.left <= self.right
            and self.bottom <= other.top
            and other.bottom <= self.top
            and self.low < other.high
            and other.low < self.high
        )

    def overlaps(self, other: "_Form") -> bool:
        """Return True if two forms overlap in the plane and their layers collide."""
        (pm, shape), (other_pm, other_shape) = self.solid, other.solid
        return not shape.filter.rejects_collision(other_shape.filter) and is_overlap(
            shape, pm, other_shape, other_pm, contact_distances(shape, other_shape, other_pm)
        )

    @cached_property
    def solid(self) -> tuple[pymunk.Body, pymunk.Shape]:
        """Body and shape for pymunk; made only for forms that another one comes near."""
        thing = self._thing
        pm = FastBody(body_type=pymunk.Body.STATIC)
        pm.position = thing.position
        pm.angle = math.radians(thing.heading_deg)
        shape = make_shape(self._shape, pm, self._more)
        if isinstance(thing, BodyDescription):
            set_material(shape, thing, group=0)
        shape.cache_bb()  # updates its position, though it is in no space
        return pm, shape


class _OccupiedForms:
    """Forms of placed things, each with a name for messages."""

    def __init__(self) -> None:
        self._forms: list[tuple[_Form, str]] = []

    def keep(self, form: _Form, words: str) -> None:
        """Add a form."""
        self._forms.append((form, words))

    def met_by(self, form: _Form) -> str:
        """Return the name of a form that another one overlaps; empty if there is none."""
        for kept, words in self._forms:
            if form.near(kept) and form.overlaps(kept):
                return words
        return ""


class Places:
    """The occupied places of a world; finds a free one for another thing.

    Args:
        seed: seed of the samples.
    """

    def __init__(self, seed: int) -> None:
        self._seeds = Seeds(seed)
        self._ground = Ground()
        self._bodies, self._kept_free = _OccupiedForms(), _OccupiedForms()

    def occupy(self, thing: Thing, clearance: float = 0.0) -> None:
        """Mark a thing's place as occupied, and ``clearance`` metres around it as kept free."""
        if isinstance(thing, FloorDescription):
            self._ground = Ground([*self._ground.floors, (thing.top, Region(thing))])
        else:
            form = self._form(thing)
            self._keep(thing, form, form.grown(clearance))

    def find(self, described: ThingT) -> ThingT:
        """Sample a thing until its place is free, occupy that and return the thing.

        Raises:
            WorldError: no free place was found.
        """
        vary = described.random
        if vary is None:
            self.occupy(described)
            return described
        rng = self._seeds.child(f"random/{described.name}")
        obstacles: dict[str, int] = {}
        for _draw in range(_MAX_SAMPLES):
            sampled = _sample(described, vary, rng)
            if isinstance(sampled, FloorDescription):
                self.occupy(sampled)
                return sampled
            form = self._form(sampled)
            wide = form.grown(vary.clearance)
            words = self._find_obstacle(sampled, form, wide)
            if not words:
                self._keep(sampled, form, wide)
                return sampled
            obstacles[words] = obstacles.get(words, 0) + 1
        raise self._no_place_error(described, vary, obstacles)

    def _find_obstacle(
        self, thing: BodyDescription | AreaDescription, form: _Form, wide: _Form
    ) -> str:
        """Return what keeps a thing from its described place; empty if nothing does.

        Args:
            thing: the thing to place.
            form: its form.
            wide: the form with its clearance; ``form`` itself without one.
        """
        if isinstance(thing, AreaDescription):
            return self._bodies.met_by(wide) if wide is not form else ""
        return (
            self._bodies.met_by(wide)
            or self._kept_free.met_by(form)
            or ("" if self._stands(thing, form) else _("the end of the floor"))
        )

    def _keep(self, thing: BodyDescription | AreaDescription, form: _Form, wide: _Form) -> None:
        if isinstance(thing, BodyDescription):
            self._bodies.keep(form, _("body {name!r}", name=thing.name))
        if wide is not form:
            self._kept_free.keep(wide, _("the clearance of {name!r}", name=thing.name))

    def _stands(self, body: BodyDescription, form: _Form) -> bool:
        """Return True if one floor is under a body's centre and all its corners."""
        if not self._ground.floors:
            return True
        top = self._ground.at(*body.position, math.inf if body.z is None else body.z)
        corners = map(form.solid[0].local_to_world, body.shape.outline())
        return top is not None and all(self._ground.at(*each, top) == top for each in corners)

    def _form(self, thing: BodyDescription | AreaDescription) -> _Form:
        heights, outline = (-math.inf, math.inf), thing.shape
        if isinstance(thing, BodyDescription):
            z = (self._ground.at(*thing.position) or 0.0) if thing.z is None else thing.z
            heights = z, z + thing.height
        shape = CircleShape(radius=outline.outer) if isinstance(outline, RingShape) else outline
        return _Form(thing, shape, 0.0, heights, _around(thing, shape))

    def _no_place_error(self, thing: Thing, vary: Variation, found: dict[str, int]) -> WorldError:
        most = sorted(found.items(), key=lambda each: -each[1])[:3]
        reasons = [_("{thing} ({count} times)", thing=words, count=count) for words, count in most]
        is_body = isinstance(thing, BodyDescription)
        body, area = _("body {name!r}", name=thing.name), _("area {name!r}", name=thing.name)
        return WorldError(
            _(
                "{thing}: found no free place in {max_samples} draws ({vary}; seed "
                "{seed}); in the way: {reasons}; give it wider ranges or less clearance, or make "
                "it smaller",
                thing=body if is_body else area,
                max_samples=_MAX_SAMPLES,
                vary=str(vary),
                seed=self._seeds.seed,
                reasons=join(reasons, ", "),
            ),
            thing=thing.name,
        )


def _around(thing: Thing, shape: BodyShape) -> tuple[float, float, float, float]:
    """Return a rectangle around a thing's shape, parallel to the axes and a bit too large."""
    corners, radius = core(shape)
    (x, y), heading, more = (
        thing.position,
        math.radians(thing.heading_deg),
        radius + _RECTANGLE_MARGIN_M,
    )
    cos, sin = math.cos(heading), math.sin(heading)
    xs = [cos * cx - sin * cy for cx, cy in corners]
    ys = [sin * cx + cos * cy for cx, cy in corners]
    return x + min(xs) - more, y + min(ys) - more, x + max(xs) + more, y + max(ys) + more


def _sample(described: ThingT, vary: Variation, rng: np.random.Generator) -> ThingT:
    """Return a thing with its random values sampled once."""
    x, y = described.position
    if vary.places:
        x, y = vary.places[int(rng.integers(len(vary.places)))]
    if vary.x:
        x = _uniform(vary.x, rng)
    if vary.y:
        y = _uniform(vary.y, rng)
    fresh: dict[str, Any] = {"position": (x, y), "random": None, "curriculum": None}
    if vary.heading_deg:
        fresh["heading_deg"] = _uniform(vary.heading_deg, rng)
    if vary.scale:
        fresh["shape"] = described.shape.scaled(_uniform(vary.scale, rng))
    sampled: Any = described.model_copy(update=fresh)  # of the same kind, which mypy can't follow
    found: ThingT = sampled
    return found


def _uniform(limits: tuple[float, float], rng: np.random.Generator) -> float:
    # the same numbers as Generator.uniform, which takes three times as long
    low, high = limits
    return low + (high - low) * rng.random()


def randomize(seed: int, things: Iterable[Thing]) -> dict[str, Thing]:
    """Return everything as sampled for an episode, by name.

    Args:
        seed: the episode's seed; the same seed gives the same result.
        things: everything in the world, in its order; without ``random`` a thing stays as it is.

    Raises:
        WorldError: there is no room for something.
    """
    places = Places(seed)
    return {thing.name: places.find(thing) for thing in sorted(things, key=_placing_order)}


def _placing_order(thing: Thing) -> int:
    """Return the rank of placing: floors first, then things with a fixed place."""
    if isinstance(thing, FloorDescription):
        return 0
    if isinstance(thing, AreaDescription):
        return 2
    return 1 if thing.random is None else 3


def is_overlap(
    shape: pymunk.Shape,
    pm: pymunk.Body,
    other: pymunk.Shape,
    other_pm: pymunk.Body,
    found: Sequence[float],
) -> bool:
    """Return True if two shapes overlap by more than :data:`MAX_OVERLAP_M`.

    Args:
        shape: a shape.
        pm: its body.
        other: another shape.
        other_pm: its body.
        found: distances at pymunk's contact points of the two.
    """
    if not found:
        return False
    # for some pairs of shapes pymunk's distance has the wrong sign, and it is 0 for two shapes in
    # exactly the same place
    return (
        max(map(abs, found)) > MAX_OVERLAP_M
        or _depth(other, pm.local_to_world(shape.center_of_gravity)) > MAX_OVERLAP_M
        or _depth(shape, other_pm.local_to_world(other.center_of_gravity)) > MAX_OVERLAP_M
    )


def _depth(shape: pymunk.Shape, place: tuple[float, float]) -> float:
    return -shape.point_query(place).distance


def place_field(
    field: AnyField, things: Sequence[Thing], seed: int
) -> tuple[dict[str, Thing], list[Thing]]:
    """Generate a field, and put the things of a scene into it.

    Bodies that can move and have no random place stand in the middle of a cell, so that no wall
    goes through them; start, goal and marks where the field has them.

    Args:
        field: its description.
        things: everything in the scene, as described.
        seed: the episode's seed.

    Returns:
        The things of the scene that are put somewhere, by name, and the new pieces.

    Raises:
        WorldError: something that the field places is not there or too large.
    """
    check_field(field, things)
    generated = field.generate(Seeds(seed).child("field"))
    taken = {*generated.blocked, *(place for place, _ in generated.places.values())}
    placed: dict[str, Thing] = {}
    for thing in things:
        put = generated.places.get(thing.name)
        if put is None and field.room() is not None and _stands_in(thing, field):
            put = _nearest_free(field, thing.position, taken), None
            taken.add(put[0])
        if put is not None:
            placed[thing.name] = _put(thing, *put)
    return placed, list(generated.pieces)


def check_field(field: AnyField, things: Sequence[Thing]) -> None:
    """Check that a scene has the things that a field places, and that they fit.

    Raises:
        WorldError: one is missing or does not fit; it names the thing.
    """
    known = {thing.name: thing for thing in things}
    for name, parameter in field.names().items():
        if name not in known:
            raise WorldError(
                _(
                    "{parameter}: nothing is named {name!r}; {hint}",
                    parameter=parameter,
                    name=name,
                    hint=suggest(name, known),
                ),
                thing="generate",
            )
    room = field.room()
    if room is not None:
        for thing in things:
            is_placed = thing.name in field.names() or _stands_in(thing, field)
            if is_placed and isinstance(thing, BodyDescription) and thing.shape.reach > room:
                raise WorldError(
                    _(
                        "body {name!r} reaches {reach:g} m, and a cell has room for {room:g} m; "
                        "make the cells larger",
                        name=thing.name,
                        reach=thing.shape.reach,
                        room=room,
                    ),
                    thing=thing.name,
                )


def _put(thing: Thing, place: Point, heading: float | None) -> Thing:
    """Return a thing at the place that a field gives it; chance has no part in it."""
    fresh: dict[str, object] = {"position": place, "random": None}
    if heading is not None:
        fresh["heading_deg"] = heading
    return thing.model_copy(update=fresh)


def _stands_in(thing: Thing, field: FieldBase) -> bool:
    """Return True for a body that can move and has a fixed place inside a field."""
    (left, low), (right, high) = field.bounds()
    x, y = thing.position
    is_mover = isinstance(thing, BodyDescription) and thing.kind != "static"
    return is_mover and thing.random is None and left <= x <= right and low <= y <= high


def _nearest_free(field: FieldBase, place: Point, taken: Collection[Point]) -> Point:
    cells = [field.centre((x, y)) for y in range(field.height) for x in range(field.width)]
    free = [each for each in cells if each not in taken]
    if not free:
        raise WorldError(
            _("expected a cell for each body that can move; make more cells"), thing="generate"
        )
    return min(free, key=lambda each: math.dist(each, place))
