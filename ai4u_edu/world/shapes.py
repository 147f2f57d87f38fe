"""Descriptions of shapes: bodies, floors and areas seen from above.

All lengths are metres, in the frame of the body or region (x forward, y left). ``contains`` of
shapes that a region may have is plain arithmetic, so it works for arrays as well as for numbers.
"""

import itertools
import math
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from ai4u_edu.base.errors import ParameterError, shown
from ai4u_edu.base.parameters import MIN_LENGTH_M, Point, PositiveMetres, explain, format_problems
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join

OUTLINE_CORNERS = 48


class Description(BaseModel):
    """The base of everything in a scene file: frozen, no unknown fields, finite numbers only."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, use_attribute_docstrings=True
    )

    def __init__(self, *values: Any, **fields: Any) -> None:
        if values:
            example = next((name for name in type(self).model_fields if name != "type"), "name")
            raise ParameterError(
                _(
                    "{type}: parameters are given by name, as in {example}=..., got {names}",
                    type=type(self).__name__,
                    example=example,
                    names=", ".join(map(shown, values)),
                )
            )
        try:
            super().__init__(**fields)
        except ValidationError as error:
            problems = format_problems(explain(error.errors(), type(self)))
            problem = ParameterError(join([type(self).__name__, problems], ": "))
            problem.details = error
            raise problem from None

    # a nested description is made without the constructor; its errors are reported with a path
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]


class Shape(Description):
    """The base of all shapes."""

    def scaled(self, times: float) -> Self:
        """Return the shape scaled by a factor."""
        # all fields of a shape except its type are lengths
        lengths = {name: _times(value, times) for name, value in self if name != "type"}
        return self if times == 1.0 else self.model_copy(update=lengths)


class CircleShape(Shape):
    """A disc around the origin."""

    type: Literal["circle"] = "circle"
    radius: PositiveMetres = 0.5

    @property
    def reach(self) -> float:
        """Distance from the origin to the farthest point."""
        return self.radius

    def contains(self, x: float, y: float) -> bool:
        """Return True if a point of the shape's own frame lies in it."""
        return x * x + y * y <= self.radius * self.radius

    def outline(self) -> list[tuple[float, float]]:
        """Return the corners of a polygon that approximates the shape, counter-clockwise."""
        return _arc(self.radius, 0, 2 * math.pi, OUTLINE_CORNERS)


class BoxShape(Shape):
    """A rectangle around the origin: ``size`` is (along x, along y)."""

    type: Literal["box"] = "box"
    size: tuple[PositiveMetres, PositiveMetres] = (1.0, 1.0)

    @property
    def reach(self) -> float:
        """Distance from the origin to the farthest point."""
        return math.hypot(*self.size) / 2

    def contains(self, x: float, y: float) -> bool:
        """Return True if a point of the shape's own frame lies in it."""
        return (2 * abs(x) <= self.size[0]) & (2 * abs(y) <= self.size[1])

    def outline(self) -> list[tuple[float, float]]:
        """Return the four corners, counter-clockwise."""
        a, b = self.size[0] / 2, self.size[1] / 2
        return [(a, b), (-a, b), (-a, -b), (a, -b)]


class PolygonShape(Shape):
    """A convex polygon by its corners, counter-clockwise."""

    type: Literal["polygon"] = "polygon"
    vertices: Annotated[tuple[Point, ...], Field(min_length=3, max_length=64)]

    @model_validator(mode="after")
    def _convex(self) -> Self:
        corners = self.vertices
        turns = []
        for i, (x, y) in enumerate(corners):
            (x1, y1), (x2, y2) = corners[(i + 1) % len(corners)], corners[(i + 2) % len(corners)]
            dx, dy, ex, ey = x1 - x, y1 - y, x2 - x1, y2 - y1
            turns.append(math.atan2(dx * ey - dy * ex, dx * ex + dy * ey))
        if all(turn < 0 for turn in turns):
            raise ValueError(
                _("expected the corners counter-clockwise, got them clockwise; reverse them")
            )
        for i, turn in enumerate(turns, start=1):
            if turn <= 0:
                raise ValueError(
                    _(
                        "expected the corners of a convex polygon, counter-clockwise; it turns "
                        "the other way (or not at all) at corner {number} {corner}; build a hollow "
                        "shape from several bodies",
                        number=i % len(corners),
                        corner=str(corners[i % len(corners)]),
                    )
                )
        if sum(turns) > 3 * math.pi:
            raise ValueError(_("expected corners that go round once; they cross themselves"))
        if _area(corners) < MIN_LENGTH_M**2:
            raise ValueError(_("expected an area of at least {area:g} m^2", area=MIN_LENGTH_M**2))
        return self

    @property
    def reach(self) -> float:
        """Distance from the origin to the farthest point."""
        return max(math.hypot(*corner) for corner in self.vertices)

    def contains(self, x: float, y: float) -> bool:
        """Return True if a point of the shape's own frame lies in it."""
        inside = True
        ax, ay = self.vertices[-1]
        for bx, by in self.vertices:
            inside &= (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0
            ax, ay = bx, by
        return inside

    def outline(self) -> list[tuple[float, float]]:
        """Return the corners, counter-clockwise."""
        return list(self.vertices)


class CapsuleShape(Shape):
    """A stick with round ends along x: ``length`` between the centres of the ends."""

    type: Literal["capsule"] = "capsule"
    length: PositiveMetres = 1.0
    radius: PositiveMetres = 0.25

    @property
    def reach(self) -> float:
        """Distance from the origin to the farthest point."""
        return self.length / 2 + self.radius

    def contains(self, x: float, y: float) -> bool:
        """Return True if a point of the shape's own frame lies in it."""
        past = abs(x) - self.length / 2
        past *= past > 0
        return past * past + y * y <= self.radius * self.radius

    def outline(self) -> list[tuple[float, float]]:
        """Return the corners of a polygon that approximates the shape, counter-clockwise."""
        half, n = self.length / 2, OUTLINE_CORNERS // 2
        right = _arc(self.radius, -math.pi / 2, math.pi / 2, n)
        left = _arc(self.radius, math.pi / 2, 3 * math.pi / 2, n)
        return [(x + half, y) for x, y in right] + [(x - half, y) for x, y in left]


class SegmentShape(Shape):
    """A straight wall from ``a`` to ``b`` with round ends."""

    type: Literal["segment"] = "segment"
    a: Point
    b: Point
    thickness: PositiveMetres = 0.2

    @model_validator(mode="after")
    def _has_length(self) -> Self:
        if self.a == self.b:
            raise ValueError(_("expected two different ends, got {end} twice", end=str(self.a)))
        if math.dist(self.a, self.b) < MIN_LENGTH_M:
            raise ValueError(_("expected ends at least {length:g} m apart", length=MIN_LENGTH_M))
        return self

    @property
    def reach(self) -> float:
        """Distance from the origin to the farthest point."""
        return max(math.hypot(*self.a), math.hypot(*self.b)) + self.thickness / 2

    def contains(self, x: float, y: float) -> bool:
        """Return True if a point of the shape's own frame lies in it."""
        (ax, ay), (bx, by) = self.a, self.b
        dx, dy = bx - ax, by - ay
        t = max(0.0, min(1.0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)))
        return math.hypot(x - ax - t * dx, y - ay - t * dy) <= self.thickness / 2

    def outline(self) -> list[tuple[float, float]]:
        """Return the corners of a polygon that approximates the shape, counter-clockwise."""
        (ax, ay), (bx, by) = self.a, self.b
        heading, radius, n = math.atan2(by - ay, bx - ax), self.thickness / 2, 8
        front = _arc(radius, heading - math.pi / 2, heading + math.pi / 2, n)
        back = _arc(radius, heading + math.pi / 2, heading + 3 * math.pi / 2, n)
        return [(x + bx, y + by) for x, y in front] + [(x + ax, y + ay) for x, y in back]


class RingShape(Shape):
    """The band between two circles around the origin. For floors and areas only."""

    type: Literal["ring"] = "ring"
    inner: PositiveMetres
    outer: PositiveMetres

    @model_validator(mode="after")
    def _has_width(self) -> Self:
        if self.outer <= self.inner:
            raise ValueError(
                _(
                    "outer: expected more than inner ({inner}), got {outer}",
                    inner=self.inner,
                    outer=self.outer,
                )
            )
        return self

    @property
    def reach(self) -> float:
        """Distance from the origin to the farthest point."""
        return self.outer

    def contains(self, x: float, y: float) -> bool:
        """Return True if a point of the shape's own frame lies in it."""
        far = x * x + y * y
        return (self.inner * self.inner <= far) & (far <= self.outer * self.outer)

    def outline(self) -> list[tuple[float, float]]:
        """Return the outer rim, counter-clockwise; the inner one is :meth:`hole`."""
        return _arc(self.outer, 0, 2 * math.pi, 2 * OUTLINE_CORNERS)

    def hole(self) -> list[tuple[float, float]]:
        """Return the inner rim, counter-clockwise."""
        return _arc(self.inner, 0, 2 * math.pi, 2 * OUTLINE_CORNERS)


def _times(value: Any, times: float) -> Any:
    if isinstance(value, tuple):
        return tuple(_times(each, times) for each in value)
    return value * times


def _arc(radius: float, start: float, stop: float, steps: int) -> list[tuple[float, float]]:
    full = math.isclose(stop - start, 2 * math.pi)
    angles = [start + (stop - start) * i / (steps if full else steps - 1) for i in range(steps)]
    return [(radius * math.cos(angle), radius * math.sin(angle)) for angle in angles]


BodyShape = Annotated[
    CircleShape | BoxShape | PolygonShape | CapsuleShape | SegmentShape,
    Field(discriminator="type"),
]
RegionShape = Annotated[
    CircleShape | BoxShape | PolygonShape | CapsuleShape | RingShape,
    Field(discriminator="type"),
]


def _area(corners: "tuple[Point, ...]") -> float:
    """Return the area of a polygon with counter-clockwise corners."""
    x0, y0 = corners[0]  # relative to a corner: far from the origin the products would be inexact
    area = 0.0
    for (x1, y1), (x2, y2) in itertools.pairwise(corners[1:]):
        area += ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) / 2
    return area
