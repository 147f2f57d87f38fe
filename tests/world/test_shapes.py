"""Random shapes and regions: containment, outline and placing."""

import cmath
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from ai4u_edu.world import (
    AreaDescription,
    BoxShape,
    CapsuleShape,
    CircleShape,
    PolygonShape,
    Region,
    RingShape,
    SegmentShape,
)
from ai4u_edu.world.shapes import BodyShape, RegionShape

Point = tuple[float, float]
Outline = list[Point]


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False)


@st.composite
def polygons(draw: st.DrawFn) -> PolygonShape:
    """Corners on an ellipse, one in each of as many sectors, well apart."""
    count = draw(st.integers(3, 8))
    wide, long, turn = draw(numbers(0.3, 5)), draw(numbers(0.3, 5)), draw(numbers(0, 6))
    x, y = draw(numbers(-3, 3)), draw(numbers(-3, 3))
    angles = [2 * math.pi * (i + draw(numbers(0, 0.7))) / count + turn for i in range(count)]
    corners = tuple((x + wide * math.cos(a), y + long * math.sin(a)) for a in angles)
    return PolygonShape(vertices=corners)


lengths = numbers(0.1, 5)
points = st.tuples(numbers(-7, 7), numbers(-7, 7))
discs = st.builds(CircleShape, radius=lengths)
boxes = st.builds(BoxShape, size=st.tuples(lengths, lengths))
capsules = st.builds(CapsuleShape, length=lengths, radius=lengths)
segments = st.builds(
    SegmentShape,
    a=st.tuples(numbers(-5, -1), numbers(-3, 3)),
    b=st.tuples(numbers(1, 5), numbers(-3, 3)),
    thickness=lengths,
)
rings = st.builds(
    lambda inner, width: RingShape(inner=inner, outer=inner + width), lengths, numbers(0.3, 3)
)
regions = st.one_of(discs, boxes, polygons(), capsules, rings)
shapes = st.one_of(regions, segments)


def area(outline: Outline) -> float:
    """Twice the area inside, positive if the corners run counter-clockwise."""
    pairs = zip(outline, outline[1:] + outline[:1], strict=True)
    return sum(ax * by - bx * ay for (ax, ay), (bx, by) in pairs)


def is_inside(outline: Outline, x: float, y: float) -> bool:
    """Return True if a ray to the right crosses the outline an odd number of times."""
    inside = False
    for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1], strict=True):
        if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
            inside = not inside
    return inside


def to_rim(outline: Outline, x: float, y: float) -> float:
    """Return the distance of a point to the outline."""
    nearest = math.inf
    for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1], strict=True):
        dx, dy = bx - ax, by - ay
        share = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)
        share = min(1.0, max(0.0, share))
        nearest = min(nearest, math.hypot(x - ax - share * dx, y - ay - share * dy))
    return nearest


def sagitta(shape: BodyShape | RegionShape) -> float:
    """Return the tolerance between a round shape's outline and its rim."""
    match shape:
        case CircleShape(radius=radius) | CapsuleShape(radius=radius):
            return 0.003 * radius
        case SegmentShape(thickness=thickness):
            return 0.03 * thickness
        case RingShape(outer=outer):
            return 0.001 * outer
    return 1e-9


@given(shapes, points)
def test_a_shape_contains_what_its_outline_surrounds(
    shape: BodyShape | RegionShape, point: Point
) -> None:
    outline = shape.outline()
    rims = [outline, shape.hole()] if isinstance(shape, RingShape) else [outline]
    assume(all(to_rim(rim, *point) > sagitta(shape) for rim in rims))
    expected = sum(is_inside(rim, *point) for rim in rims) == 1
    assert shape.contains(*point) is expected


@given(shapes)
def test_an_outline_is_counter_clockwise_and_on_the_rim(shape: BodyShape | RegionShape) -> None:
    outline = shape.outline()
    assert area(outline) > 0
    if isinstance(shape, RingShape):
        assert 0 < area(shape.hole()) < area(outline)
    assert len(set(outline)) == len(outline)
    farthest = max(math.hypot(*corner) for corner in outline)
    assert farthest <= shape.reach + 1e-9
    assert farthest >= shape.reach - sagitta(shape) - 1e-9
    middle = np.mean(outline, axis=0).tolist()
    for x, y in outline:
        # the middle of a ring is not in it; any other shape is convex
        x1, y1 = (0, 0) if isinstance(shape, RingShape) else middle
        assert not shape.contains(x1 + 1.001 * (x - x1), y1 + 1.001 * (y - y1))
        assert shape.contains(x1 + 0.999 * (x - x1), y1 + 0.999 * (y - y1))


@given(regions, points, numbers(-720, 720), points)
def test_a_region_is_its_shape_put_somewhere_and_turned(
    shape: RegionShape, place: Point, heading: float, point: Point
) -> None:
    region = Region(AreaDescription(name="area", shape=shape, position=place, heading_deg=heading))
    rims = [shape.outline(), *([shape.hole()] if isinstance(shape, RingShape) else [])]
    assume(all(to_rim(rim, *point) > 1e-6 for rim in rims))
    turned = complex(*point) * cmath.rect(1.0, math.radians(heading))
    x, y = place[0] + turned.real, place[1] + turned.imag
    assert region.contains(x, y) is shape.contains(*point)
    [(px, py)] = region.placed([point])
    assert (px, py) == pytest.approx((x, y))


@given(regions, points, st.sampled_from([0.0, 30.0]), st.lists(points, min_size=1, max_size=9))
def test_many_points_at_once_are_as_one_by_one(
    shape: RegionShape, place: Point, heading: float, asked: list[Point]
) -> None:
    region = Region(AreaDescription(name="area", shape=shape, position=place, heading_deg=heading))
    asked += region.outline()
    x, y = np.array(asked).T
    each = region.contains_each(x.reshape(1, -1), y.reshape(1, -1))
    assert each.dtype == np.bool_
    assert each.shape == (1, len(asked))
    on_rim = len(asked) - len(region.outline())
    assert each[0, :on_rim].tolist() == [region.contains(*point) for point in asked[:on_rim]]


def test_the_rim_belongs_to_a_region() -> None:
    for shape, x in (
        (CircleShape(radius=2), 2.0),
        (BoxShape(size=(4, 1)), 2.0),
        (CapsuleShape(length=2, radius=1), 2.0),
        (RingShape(inner=2, outer=3), 2.0),
        (RingShape(inner=1, outer=2), 2.0),
        (PolygonShape(vertices=((-1, 0), (2, -1), (2, 1))), 2.0),
    ):
        region = Region(AreaDescription(name="area", shape=shape, position=(1, 1)))
        assert region.contains(1 + x, 1.0)
