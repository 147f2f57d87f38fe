"""Random values of a scene: sampled at each reset, from the seed alone, on free floor."""

import math
import subprocess
import sys
from itertools import combinations
from typing import Any

import pytest

from ai4u_edu.world import (
    BodyDescription,
    BoxShape,
    CircleShape,
    PolygonShape,
    RayFan,
    RingShape,
    SegmentShape,
    Variation,
    World,
)
from tests.world.random_scene import SEEDS, crowded, digest, gap, outline, state


def test_each_episode_is_another_one_and_stays_in_its_ranges() -> None:
    world = crowded()
    seen = []
    for seed in SEEDS:
        world.reset(seed)
        seen.append(repr(state(world)))
        robot, first = world["robot"], world["obstacle 0"]
        assert robot.position != world["robot"].description.position
        assert max(map(abs, robot.position)) <= 5
        assert isinstance(first.sampled.shape, CircleShape)
        assert 0.6 * 0.4 <= first.sampled.shape.radius <= 1.4 * 0.4
        assert math.degrees(first.heading) == pytest.approx(first.sampled.heading_deg)
        assert world["pillar"].position == (0.0, 0.0)
        goal = world.areas["goal"]
        assert (goal.x, goal.y) in {(-4, -4), (4, 4)}
        assert world.floors[1].position[0] == 20
    assert len(set(seen)) == len(SEEDS)


def test_ranges_and_places_are_drawn_whole() -> None:
    world = World()
    places = [(index, 2) for index in range(4)]
    world.add_body("x", CircleShape(), position=(9, -3), random={"x": (-2, 6)})
    world.add_body("p", CircleShape(), random={"places": places, "heading_deg": (0, 90)})
    found, xs, turns = set(), [], []
    for seed in range(200):
        world.reset(seed)
        assert world["x"].position[1] == -3, "what is not random is as described"
        found.add(world["p"].position)
        xs.append(world["x"].position[0])
        turns.append(math.degrees(world["p"].heading))
    assert found == set(places)
    assert -2 <= min(xs) < -1.7
    assert 5.7 < max(xs) <= 6
    assert 0 <= min(turns) < 5
    assert 85 < max(turns) <= 90


def test_sampled_values_leave_the_description_unchanged() -> None:
    world = World()
    vary = {"x": (2, 3), "heading_deg": (90, 90), "scale": (2, 2)}
    box = world.add_body("box", BoxShape(size=(1, 2)), position=(0, 1), random=vary)
    assert box.description.position == (0.0, 1.0)
    assert box.description.shape == BoxShape(size=(1, 2))
    assert box.sampled.shape == BoxShape(size=(2, 4))
    assert box.sampled.random is None
    assert box.position == box.sampled.position
    assert 2 <= box.position[0] <= 3
    fan = RayFan(world, [0.0], 20, lambda tags: 1.0, exclude_self=False)
    eye = world.add_body("eye", CircleShape(radius=0.1), position=(-5, 1), collision_layer=2)
    for seed in range(5):
        world.reset(seed)
        fan._mask = 1
        fan.cast(eye)
        near = fan.distances[0]
        assert near == pytest.approx(box.position[0] + 5 - 2), "turned, its half length is ahead"


@pytest.mark.parametrize(
    ("shape", "twice"),
    [
        (CircleShape(radius=1), CircleShape(radius=2)),
        (BoxShape(size=(1, 2)), BoxShape(size=(2, 4))),
        (
            PolygonShape(vertices=((1, 0), (0, 1), (-1, 0))),
            PolygonShape(vertices=((2, 0), (0, 2), (-2, 0))),
        ),
        (
            SegmentShape(a=(0, 1), b=(2, 3), thickness=0.5),
            SegmentShape(a=(0, 2), b=(4, 6), thickness=1),
        ),
        (RingShape(inner=1, outer=2), RingShape(inner=2, outer=4)),
    ],
)
def test_all_lengths_of_a_shape_are_scaled(shape: Any, twice: Any) -> None:
    assert shape.scaled(2.0) == twice
    assert shape.scaled(1.0) is shape


def test_nothing_overlaps_and_what_is_to_be_free_around_it_is_free() -> None:
    world = crowded()
    for seed in SEEDS:
        world.reset(seed)
        goal = world.areas["goal"]
        radius = goal.description.shape.reach
        for body in world.bodies.values():
            nearest = min(math.hypot(x - goal.x, y - goal.y) for x, y in outline(body))
            assert nearest - radius >= 1 - 0.01, (seed, body)
        for one, other in combinations(world.bodies.values(), 2):
            # both directions: also of one that is put after the one that has the clearance
            apart = 0.2 if "obstacle" in one.name + other.name else 0.0
            assert gap(one, other) >= apart - 0.01, (seed, one, other)


def test_without_a_clearance_bodies_may_be_put_side_by_side() -> None:
    def nearest(clearance: float) -> float:
        world = World()
        world.add_body("wall", BoxShape(), kind="static")
        vary = {"x": (-1.6, 1.6), "y": (-0.2, 0.2), "clearance": clearance}
        ball = world.add_body("ball", CircleShape(radius=0.3), random=vary)
        found = []
        for seed in range(60):
            world.reset(seed)
            found.append(abs(ball.position[0]) - 0.5 - 0.3)
        return min(found)

    assert -0.002 < nearest(0) < 0.05
    assert 0.4 - 0.002 < nearest(0.4) < 0.45


def test_everything_stands_wholly_on_floor() -> None:
    world = World()
    world.add_floor("plate", BoxShape(size=(6, 6)))
    world.add_floor("step", BoxShape(size=(2, 2)), top=0.5)
    vary = {"x": (-5, 5), "y": (-5, 5), "heading_deg": (0, 360)}
    box = world.add_body("box", BoxShape(size=(1.8, 0.4)), random=vary)
    heights = set()
    for seed in range(100):
        world.reset(seed)
        heights.add(box.z)
        assert all(world.ground(x, y) == box.z for x, y in outline(box)) or box.z == 0.0
        assert all(world.ground(x, y) is not None for x, y in outline(box))
        assert box.on_ground
    assert heights == {0.0, 0.5}


def test_a_body_finds_its_floor_where_chance_has_put_that() -> None:
    world = World()
    world.add_floor("raft", BoxShape(size=(2, 2)), top=1.0, random={"x": (-50, 50)})
    vary = {"x": (-50, 50)}
    ball = world.add_body("ball", CircleShape(radius=0.2), random=vary)
    for seed in range(20):
        world.reset(seed)
        (raft,) = world.floors
        assert abs(ball.position[0] - raft.position[0]) <= 0.8
        assert ball.z == 1.0
        assert world.ground(*ball.position) == 1.0
        world.tick()
        assert ball.on_ground


def test_bodies_at_other_heights_do_not_block_a_place() -> None:
    world = World()
    world.add_body("roof", BoxShape(size=(4, 4)), kind="static", z=1.5)
    world.add_body("ghost", BoxShape(size=(4, 4)), kind="static", collision_mask=0)
    ball = world.add_body("ball", CircleShape(), random={"x": (-1, 1)})
    assert abs(ball.position[0]) <= 1


def test_the_same_seed_gives_the_same_world_however_it_came_about() -> None:
    fresh = state(crowded(seed=7))
    world = crowded(seed=2)
    world.tick()
    world.reset(7)
    assert state(world) == fresh, "added one by one, or reset"
    world.rebuild()
    assert state(world) == fresh, "and built again in the same episode"
    world.reset()
    later = state(world)
    assert later != fresh
    other = crowded()
    other.reset(world.seeds.seed)
    assert state(other) == later, "any episode comes back from its own seed"


def test_random_place_depends_on_seed_and_name_only() -> None:
    def place(*names: str) -> tuple[float, float]:
        world = World(seed=5)
        for name in names:
            world.add_body(name, CircleShape(radius=0.01), random={"x": (-90, 90), "y": (0, 90)})
        return world["a"].position

    assert place("a") == place("b", "a") == place("a", "c", "d")


def test_in_another_process() -> None:
    code = "from tests.world.random_scene import digest; print(digest(11))"
    here = digest(11)
    for hash_seed in ("1", "2"):
        there = subprocess.run(
            [sys.executable, "-c", code],
            env={"PYTHONHASHSEED": hash_seed},
            capture_output=True,
            text=True,
            check=True,
        )
        assert there.stdout.strip() == here
    assert digest(12) != here


def test_fixed_bodies_are_placed_before_random_ones() -> None:
    vary = Variation(x=(-1.2, 1.2))
    robot = BodyDescription(name="robot", shape=CircleShape(radius=0.4), random=vary)
    wall = BodyDescription(name="wall", shape=BoxShape(size=(0.5, 9)), kind="static")
    world = World()
    world.add_all([robot, wall])
    one_by_one = World()
    one_by_one.add(robot)
    one_by_one.add(wall)
    for seed in SEEDS:
        world.reset(seed)
        assert abs(world["robot"].position[0]) >= 0.25 + 0.4 - 0.001
        assert list(world.bodies) == ["robot", "wall"]
    one_by_one.reset(SEEDS[-1])
    assert state(one_by_one) == state(world)
