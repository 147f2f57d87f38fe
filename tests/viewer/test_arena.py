import numpy as np
import pytest

from ai4u_edu import BoxShape, CircleShape, World
from ai4u_edu.viewer.scene.arena import (
    arena_size,
    camera_bounds,
    region_outlines,
)
from tests.viewer.worlds import busy_world, static_scene_of


def test_the_floor_under_a_place() -> None:
    static_scene = static_scene_of(busy_world())
    assert static_scene.floor_under(0.0, 0.0) == 0.0
    assert static_scene.floor_under(0.0, 3.4) == 0.5
    assert static_scene.floor_under(0.0, 3.4, below=0.4) == 0.0
    assert (
        static_scene.floor_under(0.0, -6.5) == 0.0
    )  # the pier's end, which points down the screen
    assert static_scene.floor_under(9.0, 0.0) == 0.0
    assert static_scene.floor_under(7.5, 0.0) is None  # the ring's hole
    assert static_scene.floor_under(0.0, 20.0) is None
    assert static_scene.lowest_floor == 0.0


def test_a_ring_is_placed_with_its_hole() -> None:
    outline, hole = region_outlines(static_scene_of(busy_world()).floors[1])
    assert hole is not None
    assert outline.mean(axis=0) == pytest.approx([7.5, 0.0])
    assert np.ptp(hole, axis=0) == pytest.approx([2.0, 2.0])


def test_endless_ground_is_everywhere_and_seen_with_space_around() -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    static_scene = static_scene_of(world)
    assert static_scene.floor_under(1e4, -1e4) == 0.0
    assert arena_size(static_scene) == 4.0
    (left, low), (right, high) = camera_bounds(static_scene)
    assert min(right - left, high - low) >= 6.0


def test_an_arena_is_seen_as_it_is() -> None:
    world = World()
    world.add_floor("plate", BoxShape(size=(10, 6)))
    world.add_body("robot", CircleShape(radius=0.5))
    assert camera_bounds(static_scene_of(world)) == ((-5.0, -3.0), (5.0, 3.0))
