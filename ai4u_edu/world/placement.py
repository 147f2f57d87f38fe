"""Where things are, and where there is room for one more."""

import math
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
import pymunk

from ai4u_edu.base.errors import WorldError
from ai4u_edu.base.seeding import Seeds
from ai4u_edu.world.build import core, dress, make_shape
from ai4u_edu.world.descriptions import AreaDescription, BodyDescription, FloorDescription
from ai4u_edu.world.ground import Ground
from ai4u_edu.world.native import FastBody, contact_distances
from ai4u_edu.world.overlap import overlap
from ai4u_edu.world.region import Region
from ai4u_edu.world.shapes import BodyShape, CircleShape, RingShape
from ai4u_edu.world.variation import Variation

TRIES = 1000
"""So many draws a thing gets: where a fiftieth of them is free, one episode in 10^8 fails."""

SLACK = 1e-6
"""What a rectangle around a form is wider than the form itself, metres: more than any rounding."""

Thing = BodyDescription | FloorDescription | AreaDescription
Some = TypeVar("Some", bound=Thing)


class _Form:
    """What something takes up in its place.

    Args:
        thing: as it is described.
        shape: its own; of a ring, the disc: what is in its middle is taken up too.
        more: so many metres are added all around that.
        heights: from which one it reaches to which.
        rectangle: (left, bottom, right, top) around it all, upright; it may be a bit too large.
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
        """The same with so many metres more all around it, in the plane."""
        if not more:
            return self
        rectangle = self.left - more, self.bottom - more, self.right + more, self.top + more
        return _Form(self._thing, self._shape, more, (self.low, self.high), rectangle)

    def near(self, other: "_Form") -> bool:
        """Whether the two may meet: whether the rectangles around them do, and their heights."""
        return (
            self.left <= other.right
            and other.left <= self.right
            and self.bottom <= other.top
            and other.bottom <= self.top
            and self.low < other.high
            and other.low < self.high
        )

    def overlaps(self, other: "_Form") -> bool:
        """Whether the two are in each other in the plane, and would collide there."""
        (pm, shape), (its_pm, its_shape) = self.solid, other.solid
        return not shape.filter.rejects_collision(its_shape.filter) and overlap(
            shape, pm, its_shape, its_pm, contact_distances(shape, its_shape, its_pm)
        )

    @cached_property
    def solid(self) -> tuple[pymunk.Body, pymunk.Shape]:
        """The same for pymunk; made only for what something comes near to, which is seldom."""
        thing = self._thing
        pm = FastBody(body_type=pymunk.Body.STATIC)
        pm.position = thing.position
        pm.angle = math.radians(thing.heading_deg)
        shape = make_shape(self._shape, pm, self._more)
        if isinstance(thing, BodyDescription):
            dress(shape, thing, group=0)
        shape.cache_bb()  # now it knows where it is, though it is in no space
        return pm, shape


class _Taken:
    """Forms that have their place, each with a few words for it."""

    def __init__(self) -> None:
        self._forms: list[tuple[_Form, str]] = []

    def keep(self, form: _Form, words: str) -> None:
        """Adds one."""
        self._forms.append((form, words))

    def met_by(self, form: _Form) -> str:
        """The words for one that another form overlaps; empty if there is none."""
        for kept, words in self._forms:
            if form.near(kept) and form.overlaps(kept):
                return words
        return ""


class Places:
    """What is where, and finds a place for one thing more.

    Args:
        seed: of what is drawn; from the same one the same comes, however often it is asked.
    """

    def __init__(self, seed: int) -> None:
        self._seeds = Seeds(seed)
        self._ground = Ground()
        self._bodies, self._kept_free = _Taken(), _Taken()

    def take(self, thing: Thing, clearance: float = 0.0) -> None:
        """From now on something is where its description says, and keeps so much around it free."""
        if isinstance(thing, FloorDescription):
            self._ground = Ground([*self._ground.floors, (thing.top, Region(thing))])
        else:
            form = self._form(thing)
            self._keep(thing, form, form.grown(clearance))

    def find(self, described: Some) -> Some:
        """Draws something until it has a free place, and takes that.

        Raises:
            WorldError: none is found.
        """
        vary = described.random
        if vary is None:
            self.take(described)
            return described
        chance = self._seeds.child(f"random/{described.name}")
        in_the_way: dict[str, int] = {}
        for _ in range(TRIES):
            drawn = draw(described, vary, chance)
            if isinstance(drawn, FloorDescription):
                self.take(drawn)
                return drawn
            form = self._form(drawn)
            wide = form.grown(vary.clearance)
            words = self._in_the_way(drawn, form, wide)
            if not words:
                self._keep(drawn, form, wide)
                return drawn
            in_the_way[words] = in_the_way.get(words, 0) + 1
        raise self._no_place(described, vary, in_the_way)

    def _in_the_way(
        self, thing: BodyDescription | AreaDescription, form: _Form, wide: _Form
    ) -> str:
        """Why something can't be where it is described, in a few words; empty if it can.

        Args:
            thing: what.
            form: of it.
            wide: the same with what is to be free around it; the form itself if nothing is.
        """
        if isinstance(thing, AreaDescription):
            return self._bodies.met_by(wide) if wide is not form else ""
        return (
            self._bodies.met_by(wide)
            or self._kept_free.met_by(form)
            or ("" if self._stands(thing, form) else "the end of the floor")
        )

    def _keep(self, thing: BodyDescription | AreaDescription, form: _Form, wide: _Form) -> None:
        if isinstance(thing, BodyDescription):
            self._bodies.keep(form, f"body {thing.name!r}")
        if wide is not form:
            self._kept_free.keep(wide, f"the clearance of {thing.name!r}")

    def _stands(self, body: BodyDescription, form: _Form) -> bool:
        """Whether a floor bears a body's centre, and reaches as far as the body does."""
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

    def _no_place(self, thing: Thing, vary: Variation, found: dict[str, int]) -> WorldError:
        most = sorted(found.items(), key=lambda each: -each[1])[:3]
        reasons = ", ".join(f"{words} ({count} times)" for words, count in most)
        kind = "body" if isinstance(thing, BodyDescription) else "area"
        return WorldError(
            f"{kind} {thing.name!r}: found no free place in {TRIES} draws ({vary}; seed "
            f"{self._seeds.seed}); in the way: {reasons}; give it wider ranges or less clearance, "
            "or make it smaller",
            thing=thing.name,
        )


def _around(thing: Thing, shape: BodyShape) -> tuple[float, float, float, float]:
    """The upright rectangle around a shape in a thing's place, a bit too large."""
    corners, radius = core(shape)
    (x, y), heading, more = thing.position, math.radians(thing.heading_deg), radius + SLACK
    cos, sin = math.cos(heading), math.sin(heading)
    xs = [cos * cx - sin * cy for cx, cy in corners]
    ys = [sin * cx + cos * cy for cx, cy in corners]
    return x + min(xs) - more, y + min(ys) - more, x + max(xs) + more, y + max(ys) + more


def draw(described: Some, vary: Variation, chance: np.random.Generator) -> Some:
    """A thing with what is random in it drawn once."""
    x, y = described.position
    if vary.places:
        x, y = vary.places[int(chance.integers(len(vary.places)))]
    if vary.x:
        x = _between(vary.x, chance)
    if vary.y:
        y = _between(vary.y, chance)
    fresh: dict[str, Any] = {"position": (x, y), "random": None}
    if vary.heading_deg:
        fresh["heading_deg"] = _between(vary.heading_deg, chance)
    if vary.scale:
        fresh["shape"] = described.shape.scaled(_between(vary.scale, chance))
    drawn: Any = described.model_copy(update=fresh)  # of the same kind, which mypy can't follow
    found: Some = drawn
    return found


def _between(limits: tuple[float, float], chance: np.random.Generator) -> float:
    # the numbers of Generator.uniform, which takes three times as long
    low, high = limits
    return low + (high - low) * chance.random()
