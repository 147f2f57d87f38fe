"""Values of a thing that are sampled anew for each episode."""

from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from ai4u_edu.base.parameters import Degrees, Metres, NonNegativeMetres, Point, not_below, quantity
from ai4u_edu.world.shapes import Description

Pair = tuple[float, float]


def _in_order(ends: Pair) -> Pair:
    if ends[0] > ends[1]:
        raise ValueError(f"expected the smaller number first, got {list(ends)}")
    return ends


Ordered = AfterValidator(_in_order)
Times = Annotated[float, quantity("1", gt=0, le=100), not_below(1e-3)]


class Variation(Description):
    """Ranges for a thing's place, heading and scale; what is left out is as described.

    Every number is sampled uniformly from its range, by the world's seed and the thing's name. A
    body is sampled again while it would overlap another one, or not stand wholly on a floor (where
    there are floors).

    >>> Variation(x=(-4, 4), heading_deg=(-180, 180))
    Variation(x -4..4, heading_deg -180..180)
    >>> Variation(x=(4, -4))
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.ParameterError: Variation: x: expected the smaller number first, \
got [4.0, -4.0]
    """

    x: Annotated[tuple[Metres, Metres], Ordered] | None = None
    """From, to: metres, in the world's frame."""
    y: Annotated[tuple[Metres, Metres], Ordered] | None = None
    """From, to: metres, in the world's frame."""
    places: Annotated[tuple[Point, ...], Field(min_length=1, max_length=1000)] | None = None
    """One of these (x, y), in place of the ranges x and y."""
    heading_deg: Annotated[tuple[Degrees, Degrees], Ordered] | None = None
    """From, to: degrees, counter-clockwise."""
    scale: Annotated[tuple[Times, Times], Ordered] | None = None
    """From, to: so many times as large as described is its shape, but not its height."""
    clearance: NonNegativeMetres = 0.0
    """Metres around it in which no other body is; an area without any may have bodies in it."""

    @model_validator(mode="after")
    def _has_one_meaning(self) -> Self:
        if self.places and (self.x or self.y):
            raise ValueError("expected either ranges (x, y) or places, got both; leave one out")
        if not (self.x or self.y or self.places or self.heading_deg or self.scale):
            raise ValueError(
                "nothing is drawn; expected at least one of x, y, places, heading_deg, scale"
            )
        return self

    def __str__(self) -> str:
        """Return the ranges in a few words, for messages."""
        words = [
            f"{name} {ends[0]:g}..{ends[1]:g}"
            for name in ("x", "y", "heading_deg", "scale")
            if (ends := getattr(self, name))
        ]
        if self.places:
            words.insert(0, "places " + ", ".join(f"({x:g}, {y:g})" for x, y in self.places[:8]))
            words[0] += ", ..." if len(self.places) > 8 else ""
        if self.clearance:
            words.append(f"clearance {self.clearance:g}")
        return ", ".join(words)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self})"
