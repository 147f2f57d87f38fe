"""Where things are, and where there is room for one more."""

import math
from typing import Any, NamedTuple, TypeVar

import numpy as np
import pymunk

from ai4u_edu.errors import WorldError
from ai4u_edu.seeding import Seeds
from ai4u_edu.world.build import dress, make_shape
from ai4u_edu.world.descriptions import AreaDescription, BodyDescription, FloorDescription
from ai4u_edu.world.ground import Ground
from ai4u_edu.world.overlap import overlap
from ai4u_edu.world.region import Region
from ai4u_edu.world.shapes import CircleShape, RingShape
from ai4u_edu.world.variation import Variation

TRIES = 1000
"""So many draws a thing gets: where a fiftieth of them is free, one episode in 10^8 fails."""

Thing = BodyDescription | FloorDescription | AreaDescription
Some = TypeVar("Some", bound=Thing)


class _Form(NamedTuple):
    """A thing's shape in its place, and from which height to which it reaches."""

    pm: pymunk.Body
    shape: pymunk.Shape
    low: float
    high: float


class Places:
    """What is where, and finds a place for one thing more.

    Args:
        seed: of what is drawn; from the same one the same comes, however often it is asked.
    """

    def __init__(self, seed: int) -> None:
        self._seeds = Seeds(seed)
        self._ground = Ground()
        self._bodies = pymunk.Space()
        self._kept_free = pymunk.Space()
        self._taken: dict[pymunk.Shape, tuple[_Form, str]] = {}

    def take(self, thing: Thing, clearance: float = 0.0) -> None:
        """From now on something is where its description says, and keeps so much around it free."""
        if isinstance(thing, FloorDescription):
            self._ground = Ground([*self._ground.floors, (thing.top, Region(thing))])
            return
        if isinstance(thing, BodyDescription):
            self._keep(self._bodies, self._form(thing), f"body {thing.name!r}")
        if clearance:
            words = f"the clearance of {thing.name!r}"
            self._keep(self._kept_free, self._form(thing, clearance), words)

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
            words = self._in_the_way(drawn, vary.clearance)
            if not words:
                self.take(drawn, vary.clearance)
                return drawn
            in_the_way[words] = in_the_way.get(words, 0) + 1
        raise self._no_place(described, vary, in_the_way)

    def _in_the_way(self, thing: Thing, clearance: float) -> str:
        """Why something can't be where it is described, in a few words; empty if it can."""
        if isinstance(thing, FloorDescription):
            return ""
        if isinstance(thing, AreaDescription):
            return self._met(self._bodies, self._form(thing, clearance)) if clearance else ""
        form = self._form(thing)
        return (
            self._met(self._bodies, self._form(thing, clearance) if clearance else form)
            or self._met(self._kept_free, form)
            or ("" if self._stands(thing, form) else "the end of the floor")
        )

    def _met(self, space: pymunk.Space, form: _Form) -> str:
        for hit in space.shape_query(form.shape):
            other, words = self._taken[hit.shape]
            level = form.low < other.high and other.low < form.high
            if level and overlap(form.shape, form.pm, hit, other.pm):
                return words
        return ""

    def _stands(self, body: BodyDescription, form: _Form) -> bool:
        """Whether a floor bears a body's centre, and reaches as far as the body does."""
        if not self._ground.floors:
            return True
        top = self._ground.at(*body.position, math.inf if body.z is None else body.z)
        corners = map(form.pm.local_to_world, body.shape.outline())
        return top is not None and all(self._ground.at(*each, top) == top for each in corners)

    def _form(self, thing: BodyDescription | AreaDescription, more: float = 0.0) -> _Form:
        """What something takes up, with so many metres more all around it."""
        pm = pymunk.Body(body_type=pymunk.Body.STATIC)
        pm.position = thing.position
        pm.angle = math.radians(thing.heading_deg)
        outline = thing.shape
        if isinstance(outline, RingShape):  # what is in its middle is kept free too
            outline = CircleShape(radius=outline.outer)
        shape = make_shape(outline, pm, more)
        if isinstance(thing, AreaDescription):
            return _Form(pm, shape, -math.inf, math.inf)
        dress(shape, thing, group=0)
        z = (self._ground.at(*thing.position) or 0.0) if thing.z is None else thing.z
        return _Form(pm, shape, z, z + thing.height)

    def _keep(self, space: pymunk.Space, form: _Form, words: str) -> None:
        space.add(form.pm, form.shape)
        self._taken[form.shape] = form, words

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


def draw(described: Some, vary: Variation, chance: np.random.Generator) -> Some:
    """A thing with what is random in it drawn once."""
    x, y = described.position
    if vary.places:
        x, y = vary.places[int(chance.integers(len(vary.places)))]
    if vary.x:
        x = float(chance.uniform(*vary.x))
    if vary.y:
        y = float(chance.uniform(*vary.y))
    fresh: dict[str, Any] = {"position": (x, y), "random": None}
    if vary.heading_deg:
        fresh["heading_deg"] = float(chance.uniform(*vary.heading_deg))
    if vary.scale:
        fresh["shape"] = described.shape.scaled(float(chance.uniform(*vary.scale)))
    drawn: Any = described.model_copy(update=fresh)  # of the same kind, which mypy can't follow
    found: Some = drawn
    return found
