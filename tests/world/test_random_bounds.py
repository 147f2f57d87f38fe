"""Bounds, areas and floors of a scene with random values."""

from typing import Any

import pytest

from ai4u_edu.world import (
    BoxShape,
    CircleShape,
    SegmentShape,
    World,
    WorldView,
)
from tests.world.random_scene import SEEDS, crowded, outline


def test_bounds_are_the_same_in_each_episode_and_hold_everything() -> None:
    world = crowded()
    bounds = world.bounds()
    assert bounds[1][0] == 22, "as far as the island ever is"
    assert bounds[1][1] == 7
    for seed in SEEDS:
        world.reset(seed)
        assert world.bounds() == bounds
        (left, low), (right, high) = bounds
        for body in world.bodies.values():
            for x, y in outline(body):
                assert left <= x <= right
                assert low <= y <= high


@pytest.mark.parametrize(
    ("vary", "expected"),
    [
        ({"x": (-4, 2)}, ((-5, -1), (3, 3))),
        ({"places": [(7, 0), (0, -7)]}, ((-1, -9), (8, 2))),
        ({"scale": (0.5, 3)}, ((-3, -5), (3, 7))),
        ({"heading_deg": (0, 1)}, ((-5**0.5, 1 - 5**0.5), (5**0.5, 1 + 5**0.5))),
        ({"y": (3, 4), "heading_deg": (0, 1), "scale": (1, 2)},
         ((-2 * 5**0.5, 3 - 2 * 5**0.5), (2 * 5**0.5, 4 + 2 * 5**0.5))),
    ],
)  # fmt: skip
def test_bounds_reach_as_far_as_the_ranges(vary: dict[str, Any], expected: Any) -> None:
    world = World()
    world.add_body("box", BoxShape(size=(2, 4)), position=(0, 1), random=vary)
    for corner, there in zip(world.bounds(), expected, strict=True):
        assert corner == pytest.approx(there)


def test_a_wall_beside_its_own_origin_is_in_the_bounds_at_its_smallest() -> None:
    world = World()
    wall = SegmentShape(a=(2, 0), b=(4, 0), thickness=0.2)
    world.add_body("wall", wall, kind="static", random={"scale": (0.5, 2)})
    assert world.bounds()[0][0] == pytest.approx(0.95, abs=0.01)
    assert world.bounds()[1][0] == pytest.approx(8.2, abs=0.01)


def test_view_returns_the_present_areas_and_floors() -> None:
    world = World()
    world.add_floor("raft", BoxShape(size=(2, 2)), random={"x": (-9, 9)})
    world.add_area("goal", CircleShape(radius=0.5), random={"x": (-9, 9)})
    view = WorldView(world)
    seen = []
    for seed in range(5):
        generation = view.generation
        world.reset(seed)
        assert view.generation > generation, "what was learnt of them is old"
        (raft,) = view.floors
        goal = view.areas["goal"]
        seen.append((raft.position[0], goal.x))
        assert goal.contains(goal.x, 0.4)
        assert view.ground(raft.position[0] + 0.9, 0) == 0.0
        assert view.ground(raft.position[0] + 1.1, 0) is None
    assert len(set(seen)) == 5
