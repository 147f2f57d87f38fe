"""Descriptions of a world's settings, bodies, floors and areas.

Angles are degrees here, and radians inside the world.
"""

from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, ValidationInfo, field_validator, model_validator

from ai4u_edu.base.colors import Colour
from ai4u_edu.base.parameters import (
    Bits,
    Degrees,
    Metres,
    Name,
    NonNegativeMetres,
    Point,
    PositiveMetres,
    not_below,
    quantity,
)
from ai4u_edu.locale import gettext as _
from ai4u_edu.world.pictures import PictureData
from ai4u_edu.world.shapes import BodyShape, BoxShape, CircleShape, Description, RegionShape

Tags = tuple[Name, ...]


def _in_order(ends: tuple[float, float]) -> tuple[float, float]:
    if ends[0] > ends[1]:
        raise ValueError(_("expected the smaller number first, got {ends}", ends=str(list(ends))))
    return ends


_Ordered = AfterValidator(_in_order)
RANGES = ("x", "y", "heading_deg", "scale")
"""Fields of a :class:`Variation` that are ranges."""
_Times = Annotated[float, quantity("1", gt=0, le=100), not_below(1e-3)]


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

    x: Annotated[tuple[Metres, Metres], _Ordered] | None = None
    """From, to: metres, in the world's frame."""
    y: Annotated[tuple[Metres, Metres], _Ordered] | None = None
    """From, to: metres, in the world's frame."""
    places: Annotated[tuple[Point, ...], Field(min_length=1, max_length=1000)] | None = None
    """One of these (x, y), in place of the ranges x and y."""
    heading_deg: Annotated[tuple[Degrees, Degrees], _Ordered] | None = None
    """From, to: degrees, counter-clockwise."""
    scale: Annotated[tuple[_Times, _Times], _Ordered] | None = None
    """From, to: so many times as large as described is its shape, but not its height."""
    clearance: NonNegativeMetres = 0.0
    """Metres around it in which no other body is; an area without any may have bodies in it."""

    @model_validator(mode="after")
    def _has_one_meaning(self) -> Self:
        if self.places and (self.x or self.y):
            raise ValueError(_("expected either ranges (x, y) or places, got both; leave one out"))
        if not (self.x or self.y or self.places or self.heading_deg or self.scale):
            raise ValueError(
                _("nothing is drawn; expected at least one of x, y, places, heading_deg, scale")
            )
        return self

    def __str__(self) -> str:
        """Return the ranges in a few words, for messages."""
        words = [
            f"{name} {ends[0]:g}..{ends[1]:g}" for name in RANGES if (ends := getattr(self, name))
        ]
        if self.places:
            words.insert(0, "places " + ", ".join(f"({x:g}, {y:g})" for x, y in self.places[:8]))
            words[0] += ", ..." if len(self.places) > 8 else ""
        if self.clearance:
            words.append(f"clearance {self.clearance:g}")
        return ", ".join(words)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self})"


class EasyRanges(Description):
    """Ranges of easy starts of a thing, within those of its ``random``, which learning widens.

    Only what learns by rewards begins with them; in play and in tests ``random`` counts.

    >>> EasyRanges(x=(1, 2)).widened(Variation(x=(-4, 4)), 0.5)
    {'x': (-1.5, 3.0)}
    """

    x: Annotated[tuple[Metres, Metres], _Ordered] | None = None
    y: Annotated[tuple[Metres, Metres], _Ordered] | None = None
    heading_deg: Annotated[tuple[Degrees, Degrees], _Ordered] | None = None
    scale: Annotated[tuple[_Times, _Times], _Ordered] | None = None

    @model_validator(mode="after")
    def _has_a_range(self) -> Self:
        if not self.given:
            raise ValueError(
                _("no start is easier; expected at least one of {names}", names=", ".join(RANGES))
            )
        return self

    @property
    def given(self) -> dict[str, tuple[float, float]]:
        """The ranges, by the name of their field in ``random``."""
        return {name: ends for name in RANGES if (ends := getattr(self, name)) is not None}

    def widened(self, random: Variation, share: float) -> dict[str, tuple[float, float]]:
        """Return the ranges on their way to those of ``random``.

        Args:
            random: ranges of all starts.
            share: 0 for these ranges, 1 for those of ``random``.
        """
        ranges = {}
        for name, (low, high) in self.given.items():
            full_low, full_high = getattr(random, name)
            ranges[name] = low + share * (full_low - low), high + share * (full_high - high)
        return ranges

    def check(self, random: Variation | None) -> None:
        """Check that these are parts of the ranges of all starts.

        Raises:
            ValueError: one is not.
        """
        for name, (low, high) in self.given.items():
            full = None if random is None else getattr(random, name)
            if full is None:
                raise ValueError(
                    _(
                        "{name} has an easy range, and none in random; expected it in both",
                        name=name,
                    )
                )
            if not full[0] <= low <= high <= full[1]:
                raise ValueError(
                    _(
                        "{name}: expected a part of random's range {full}, got {ends}",
                        name=name,
                        full=str(list(full)),
                        ends=str([low, high]),
                    )
                )


def _is_within_random(easy: EasyRanges | None, info: ValidationInfo) -> EasyRanges | None:
    if easy is not None and "random" in info.data:  # else that is wrong itself
        easy.check(info.data["random"])
    return easy


_Curriculum = Annotated[EasyRanges | None, AfterValidator(_is_within_random)]


class WorldSettings(Description):
    """Settings of a whole world."""

    ticks_per_second: Annotated[int, quantity("1/s", ge=1, le=1000)] = 60
    damping: Annotated[float, quantity("1", gt=0, le=1)] = 0.05
    """The share of its speed that a body on the ground keeps for a second (pymunk's damping)."""
    gravity: Annotated[float, quantity("m/s^2", ge=0, le=1000)] = 9.81
    """Downwards, along -z; nothing pulls in the plane."""
    fall_threshold: Metres = -2.0
    """A body that falls below this height is out of the world."""


class BodyDescription(Description):
    """A thing in the world: an agent's body, a box, a wall.

    Seen from above it has a shape; upwards it reaches from ``z`` to ``z + height``.
    """

    name: Name
    shape: BodyShape = CircleShape()
    kind: Literal["static", "dynamic", "kinematic"] = "dynamic"
    position: Point = (0.0, 0.0)
    heading_deg: Degrees = 0.0
    random: Variation | None = None
    """Values sampled anew at each reset; without any, the body is as described here."""
    curriculum: _Curriculum = None
    """Easy starts, from which learning by rewards begins; without any, all starts at once."""
    z: Metres | None = None
    """Height of the underside; left out: it stands on the highest floor there."""
    height: PositiveMetres = 1.0
    mass: Annotated[float, quantity("kg", gt=0, le=1e6), not_below(1e-6)] = 1.0
    friction: Annotated[float, quantity("1", ge=0, le=10)] = 0.5
    elasticity: Annotated[float, quantity("1", ge=0, le=1)] = 0.0
    velocity: Point = (0.0, 0.0)
    angular_velocity_deg: Annotated[float, quantity("deg/s", ge=-1e5, le=1e5)] = 0.0
    colour: Colour | None = None
    label: Annotated[str, Field(max_length=40)] = ""
    tags: Tags = ()
    """The groups it belongs to."""
    collision_layer: Bits = 1
    collision_mask: Bits = 0xFFFFFFFF


class RegionDescription(Description):
    """A part of the plane, from above."""

    name: Name
    shape: RegionShape
    position: Point = (0.0, 0.0)
    heading_deg: Degrees = 0.0
    random: Variation | None = None
    """Values sampled anew at each reset; without any, it is as described here."""
    curriculum: _Curriculum = None
    """Easy starts, from which learning by rewards begins; without any, all starts at once."""
    tags: Tags = ()
    colour: Colour | None = None
    label: Annotated[str, Field(max_length=40)] = ""


class FloorDescription(RegionDescription):
    """Ground to stand on: a thin sheet at height ``top``.

    It bears what is on or above it; what is lower passes under it. For a step that stands in the
    way, use a static body with a height. A world without any floor has endless ground at height 0.
    """

    top: Metres = 0.0
    tags: Tags = ("floor",)

    @field_validator("random")
    @classmethod
    def _needs_no_clearance(cls, random: Variation | None) -> Variation | None:
        if random is not None and random.clearance:
            raise ValueError(_("a floor has bodies on it; expected no clearance, leave it out"))
        return random


class AreaDescription(RegionDescription):
    """A region that blocks can refer to (a goal, a trigger); nothing collides with it."""

    paint: bool = False
    """True draws it as paint on the ground, without outline and label: a line, a marking."""
    picture: PictureData | None = Field(default=None, repr=False)
    """A PNG or JPEG picture that lies on the ground, such as a printed mat: its data, or in a file
    the name of a picture beside it. The area is a box; its size is the picture's (along x, along
    y), upright for a heading of 0. Sensors of colours and lines see it."""

    @property
    def is_flat(self) -> bool:
        """True for paint and pictures: drawn in full colour, without outline and label."""
        return self.paint or self.picture is not None

    @model_validator(mode="after")
    def _is_a_box_with_a_picture(self) -> Self:
        if self.picture is not None and not isinstance(self.shape, BoxShape):
            raise ValueError(
                _(
                    "a picture lies on a box, got a {type}; expected shape: {{type: box, size: "
                    "[...]}}, its size in metres",
                    type=self.shape.type,
                )
            )
        return self
