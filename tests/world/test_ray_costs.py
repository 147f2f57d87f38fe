"""Rays make no more queries than necessary."""

import math
from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import pymunk
import pytest

from ai4u_edu.world import BoxShape, CircleShape, RayFan, RayGrid, World, rays
from ai4u_edu.world.native import segments as _segments
from tests.processes import is_own_thread


class Queries:
    """Counts of queries in the test's own thread, by kind."""

    first = every = point = 0


@pytest.fixture
def queries(monkeypatch: pytest.MonkeyPatch) -> Queries:
    counted = Queries()
    every, point = pymunk.Space.segment_query, pymunk.Space.point_query

    def counting_first(*args: Any) -> Any:
        counted.first += is_own_thread()
        return real.cpSpaceSegmentQueryFirst(*args)

    def counting_every(*args: Any) -> Any:
        counted.every += is_own_thread()
        return every(*args)

    def counting_point(*args: Any) -> Any:
        counted.point += is_own_thread()
        return point(*args)

    real = vars(_segments)["lib"]
    functions = {name: getattr(real, name) for name in dir(real) if name.startswith("cp")}
    counting = functions | {"cpSpaceSegmentQueryFirst": counting_first}
    monkeypatch.setattr(_segments, "lib", SimpleNamespace(**counting))
    monkeypatch.setattr(rays, "make_segments", _segments.CffiSegments)
    monkeypatch.setattr(pymunk.Space, "segment_query", counting_every)
    monkeypatch.setattr(pymunk.Space, "point_query", counting_point)
    return counted


def code_of(tags: Sequence[str]) -> float:
    return float(len(tags))


def flat_world(*heights: float) -> World:
    """A robot with balls all around it."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.3), tags=("robot",))
    for i, height in enumerate(heights):
        angle = 2 * math.pi * i / len(heights)
        place = 3 * math.cos(angle), 3 * math.sin(angle)
        world.add_body(f"ball {i}", CircleShape(), position=place, height=height, tags=("ball",))
    return world


def test_a_flat_scene_takes_one_first_hit_query_a_column(queries: Queries) -> None:
    world = flat_world(*[1.0] * 8)
    angles = [2 * math.pi * i / 24 for i in range(24)]
    pitches = [0.4 - 0.1 * i for i in range(12)]
    fan = RayFan(world, angles, 10.0, code_of)
    grid = RayGrid(world, angles, pitches, 10.0, code_of)
    world.tick()
    for caster in (fan, grid):
        queries.first = queries.every = queries.point = 0
        caster.cast(world["robot"])
        assert (queries.first, queries.every, queries.point) == (24, 0, 0)
    # the balls are met, and some rays pass above them
    balls = (grid.codes == 1.0) & (grid.distances > 2.4)
    assert balls[4].any()
    assert not balls[0].any()


def test_flat_floors_cost_no_query_either(queries: Queries) -> None:
    world = flat_world(*[1.0] * 8)
    world.add_floor("table", BoxShape(size=(20, 20)))
    grid = RayGrid(world, [0.0, 0.1, 0.5], [0.3, 0.0, -0.3], 10.0, code_of)
    world.tick()
    queries.first = queries.every = queries.point = 0
    grid.cast(world["robot"])
    assert (queries.first, queries.every, queries.point) == (3, 0, 0)


def test_only_rays_above_the_first_obstacle_ask_what_is_behind(queries: Queries) -> None:
    world = flat_world(1.0, 1.0, 1.0, 1.0)
    world.add_body("tower", BoxShape(), kind="static", height=9.0, position=(6, 0), tags=("a", "b"))
    # the first column looks at a ball with the tower behind, the second between two balls
    grid = RayGrid(world, [0.0, math.pi / 4], [0.4, 0.0, -0.4], 10.0, code_of)
    world.tick()
    queries.first = queries.every = 0
    grid.cast(world["robot"])
    assert (queries.first, queries.every) == (2, 1)
    assert grid.codes.tolist() == [[2.0, 0.0], [1.0, 0.0], [1.0, 1.0]]
