"""Errors of descriptions: one sentence with place, expected value and given value."""

import math
from collections.abc import Callable
from typing import Any

import pytest
from pydantic import ValidationError

from ai4u_edu.base.errors import ParameterError
from ai4u_edu.world import (
    BodyDescription,
    BoxShape,
    CapsuleShape,
    CircleShape,
    PolygonShape,
    RingShape,
    SegmentShape,
    World,
    WorldSettings,
)


def refused(make: Callable[..., object], **fields: Any) -> str:
    with pytest.raises(ParameterError) as info:
        make(**fields)
    return str(info.value)


@pytest.mark.parametrize(
    ("fields", "problem"),
    [
        ({"mass": -1}, "mass: expected more than 0, got -1"),
        ({"mass": 1e7}, "mass: expected at most 1e+06, got 10000000.0"),
        ({"height": 0.0}, "height: expected more than 0, got 0.0"),
        ({"friction": "a"}, "friction: expected a number, got 'a'"),
        ({"elasticity": 1.1}, "elasticity: expected at most 1, got 1.1"),
        ({"position": (0.0, math.nan)}, "position[1]: expected a finite number, got nan"),
        ({"position": (math.inf, 0)}, "position[0]: expected a finite number, got inf"),
        ({"z": math.nan}, "z: expected a finite number, got nan"),
        ({"z": 20000}, "z: expected at most 10000, got 20000"),
        ({"kind": "fluid"}, "kind: expected 'static', 'dynamic' or 'kinematic', got 'fluid'"),
        ({"collision_layer": -1}, "collision_layer: expected at least 0, got -1"),
        ({"colr": "red"}, "colr: unknown parameter; did you mean 'colour'?"),
        (
            {"mass": 0, "z": "up"},
            "z: expected a number, got 'up'; mass: expected more than 0, got 0",
        ),
    ],
)
def test_a_body(fields: dict[str, Any], problem: str) -> None:
    world = World()

    def add(**fields: Any) -> object:
        return world.add_body("box", BoxShape(), **fields)

    assert refused(add, **fields) == f"BodyDescription: {problem}"
    assert not world.bodies


def test_a_ring_is_no_body_and_a_segment_no_region() -> None:
    ring: Any = RingShape(inner=1, outer=2)
    segment: Any = SegmentShape(a=(0, 0), b=(1, 0))
    assert refused(lambda: World().add_body("ring", ring)) == (
        "BodyDescription: shape: unknown type 'ring'; "
        "known are 'box', 'capsule', 'circle', 'polygon', 'segment'"
    )
    for kind, add in (("Floor", World().add_floor), ("Area", World().add_area)):
        assert refused(lambda add=add: add("wall", segment)) == (
            f"{kind}Description: shape: unknown type 'segment'; "
            "known are 'box', 'capsule', 'circle', 'polygon', 'ring'"
        )


def test_a_world() -> None:
    assert refused(World, gravty=1.0) == (
        "WorldSettings: gravty: unknown parameter; did you mean 'gravity'?"
    )
    assert refused(World, ticks_per_second=0) == (
        "WorldSettings: ticks_per_second: expected at least 1, got 0"
    )
    assert refused(WorldSettings, damping=0.0) == (
        "WorldSettings: damping: expected more than 0, got 0.0"
    )


@pytest.mark.parametrize(
    ("make", "fields", "problem"),
    [
        (CircleShape, {"radius": 0}, "radius: expected more than 0, got 0"),
        (CircleShape, {"radius": math.inf}, "radius: expected a finite number, got inf"),
        (BoxShape, {"size": (1, -1)}, "size[1]: expected more than 0, got -1"),
        (CapsuleShape, {"length": 0}, "length: expected more than 0, got 0"),
        (RingShape, {"outer": 2}, "inner: is missing and has no default"),
        (RingShape, {"inner": 2, "outer": 2}, "outer: expected more than inner (2.0), got 2.0"),
        (RingShape, {"inner": 3, "outer": 2}, "outer: expected more than inner (3.0), got 2.0"),
        (
            SegmentShape,
            {"a": (1, 2), "b": (1, 2)},
            "expected two different ends, got (1.0, 2.0) twice",
        ),
    ],
)
def test_a_shape(make: Callable[..., object], fields: dict[str, Any], problem: str) -> None:
    assert refused(make, **fields) == f"{make.__name__}: {problem}"


SQUARE = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
STAR = tuple((math.cos(0.8 * math.pi * i), math.sin(0.8 * math.pi * i)) for i in range(5))


@pytest.mark.parametrize(
    ("corners", "problem"),
    [
        (SQUARE[::-1], "expected the corners counter-clockwise, got them clockwise; reverse them"),
        (
            (*SQUARE[:3], (0.9, 0.2)),
            "expected the corners of a convex polygon, counter-clockwise; it turns the other way "
            "(or not at all) at corner 3 (0.9, 0.2); build a hollow shape from several bodies",
        ),
        (
            ((0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)),
            "expected the corners of a convex polygon, counter-clockwise; it turns the other way "
            "(or not at all) at corner 1 (1.0, 1.0); build a hollow shape from several bodies",
        ),
        (
            ((0.0, 0.0), (0.5, 0.0), (1.0, 0.0), (1.0, 1.0)),
            "expected the corners of a convex polygon, counter-clockwise; it turns the other way "
            "(or not at all) at corner 1 (0.5, 0.0); build a hollow shape from several bodies",
        ),
        (
            (*SQUARE, (0.0, 1.0)),
            "expected the corners of a convex polygon, counter-clockwise; it turns the other way "
            "(or not at all) at corner 3 (0.0, 1.0); build a hollow shape from several bodies",
        ),
        (STAR, "expected corners that go round once; they cross themselves"),
    ],
)
def test_a_polygon(corners: tuple[tuple[float, float], ...], problem: str) -> None:
    assert refused(PolygonShape, vertices=corners) == f"PolygonShape: {problem}"


def test_a_polygon_needs_three_corners() -> None:
    assert refused(PolygonShape, vertices=SQUARE[:2]).startswith("PolygonShape: vertices: ")
    PolygonShape(vertices=SQUARE)


def test_inside_a_file_the_path_is_kept() -> None:
    """A scene file is checked as a whole, and its own errors need the place in it."""
    wrong = {"name": "box", "shape": {"type": "box", "size": (0, 1)}}
    with pytest.raises(ValidationError) as info:
        BodyDescription.model_validate(wrong)
    assert info.value.errors()[0]["loc"] == ("shape", "box", "size", 0)
