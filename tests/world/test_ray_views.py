"""Readings of a fan and a grid in small worlds."""

import math
from collections.abc import Sequence

import numpy as np
import pytest

from ai4u_edu.world import Body, BoxShape, CircleShape, RayFan, RayGrid, World, WorldView

CODES = {"wall": 1.0, "ball": 2.0, "floor": 3.0, "robot": 4.0}


def code_of(tags: Sequence[str]) -> float:
    return CODES[tags[0]] if tags else 0.0


def robot_in(world: World, **fields: float) -> Body:
    return world.add_body("robot", CircleShape(radius=0.3), tags=("robot",), **fields)


def add_wall(world: World, x: float, *, height: float = 1.0, z: float | None = None) -> Body:
    """A wall 0.2 m thick, its near side at x."""
    shape = BoxShape(size=(0.2, 4.0))
    return world.add_body(
        f"wall {x}", shape, kind="static", position=(x + 0.1, 0), height=height, z=z, tags=("wall",)
    )


def ahead(world: World, robot: Body, up: float = 0.5, reach: float = 10.0) -> tuple[float, float]:
    """Code and distance of what a level ray straight ahead meets."""
    fan = RayFan(world, [0.0], reach, code_of, eye=(0.0, 0.0, up))
    fan.cast(robot)
    return float(fan.codes[0]), round(float(fan.distances[0]), 9)


def test_a_level_ray_looks_over_what_is_low_and_under_what_is_high() -> None:
    world = World()
    robot = robot_in(world)
    add_wall(world, 2.0, height=0.4)
    add_wall(world, 3.0, z=0.6)
    add_wall(world, 4.0)
    assert ahead(world, robot, 0.5) == (1.0, 4.0)
    assert ahead(world, robot, 0.3) == (1.0, 2.0)
    assert ahead(world, robot, 0.8) == (1.0, 3.0)
    assert ahead(world, robot, 1.8) == (0.0, 0.0)
    assert ahead(world, robot, -0.1) == (0.0, 0.0), "below the ground is nothing"


def test_the_eye_rises_and_sinks_with_the_body() -> None:
    world = World()
    robot = robot_in(world)
    add_wall(world, 2.0)
    fan = RayFan(world, [0.0], 10.0, code_of)
    seen = []
    robot.jump(5.0)
    for _ in range(70):
        world.tick()
        fan.cast(robot)
        seen.append(bool(fan.codes[0]))
        assert seen[-1] == (robot.z + 0.5 <= 1.0)
    assert seen[0], "it begins below the top of the wall"
    assert not all(seen), "it saw over the wall"
    assert seen[-1]


def test_rays_see_a_moving_body_at_its_height() -> None:
    world = World()
    robot, lift = robot_in(world), add_wall(world, 2.0)
    fan = RayFan(world, [0.0], 10.0, code_of)
    for z, code in ((0.0, 1.0), (0.6, 0.0), (0.4, 1.0)):
        lift.move_to(2.1, 0, z=z)
        fan.cast(robot)
        assert fan.codes[0] == code


def test_a_wall_on_a_higher_floor_is_above_the_eye() -> None:
    world = World()
    world.add_floor("ground", BoxShape(size=(20, 20)))
    world.add_floor("deck", BoxShape(size=(2, 4)), position=(4, 0), top=1.0)
    robot = robot_in(world)
    add_wall(world, 3.5)
    assert ahead(world, robot) == (0.0, 0.0)
    robot.move_to(0, 0, z=1.0)
    assert ahead(world, robot) == (1.0, 3.5)


def test_directions_turn_with_the_body_counter_clockwise() -> None:
    world = World()
    robot = robot_in(world, heading_deg=90.0)
    world.add_body("ball", CircleShape(radius=0.5), position=(-3, 0), tags=("ball",))
    fan = RayFan(world, [-math.pi / 2, 0.0, math.pi / 2], 10.0, code_of)
    fan.cast(robot)
    assert fan.codes.tolist() == [0.0, 0.0, 2.0]
    assert fan.distances == pytest.approx([0.0, 0.0, 2.5])
    assert fan.directions == pytest.approx(np.array([(1, 0), (0, 1), (-1, 0)]), abs=1e-12)
    assert fan.origin == (0.0, 0.0, 0.5)


def test_the_eye_may_sit_off_the_centre() -> None:
    world = World()
    robot = robot_in(world, heading_deg=90.0)
    world.add_body("ball", CircleShape(radius=0.5), position=(-1, 5), tags=("ball",))
    fan = WorldView(world).ray_fan([0.0], 10.0, code_of, eye=(0.5, 1.0, 0.2))
    fan.cast(robot)
    assert fan.origin == pytest.approx((-1.0, 0.5, 0.2))
    assert fan.distances == pytest.approx([4.0])


def test_the_body_itself_is_seen_only_if_asked_for() -> None:
    world = World()
    robot = robot_in(world)
    other = world.add_body("other", CircleShape(), position=(0, 5), tags=("ball",))
    eye = (2.0, 0.0, 0.5)
    for exclude, code, distance in ((True, 0.0, 0.0), (False, 4.0, 1.7)):
        fan = RayFan(world, [math.pi], 10.0, code_of, eye=eye, exclude_self=exclude)
        grid = RayGrid(world, [math.pi], [0.0], 10.0, code_of, eye=eye, exclude_self=exclude)
        fan.cast(robot)
        grid.cast(robot)
        assert (fan.codes.item(), grid.codes.item()) == (code, code)
        assert fan.distances.item() == grid.distances.item() == pytest.approx(distance)
    # the same fan on another body excludes that one
    fan = RayFan(world, [math.pi / 2], 10.0, code_of)
    fan.cast(robot)
    assert fan.codes.item() == 2.0
    fan.cast(other)
    assert fan.codes.item() == 0.0


def test_a_mask_chooses_layers() -> None:
    world = World()
    robot = robot_in(world)
    for x, layer, tag in ((2, 1, "ball"), (4, 2, "wall")):
        world.add_body(
            tag, CircleShape(), position=(x, 0), collision_layer=layer, tags=(tag,), kind="static"
        )
    for mask, code in ((1, 2.0), (2, 1.0), (3, 2.0), (4, 0.0)):
        fan = RayFan(world, [0.0], 10.0, code_of, mask=mask)
        grid = RayGrid(world, [0.0], [0.0], 10.0, code_of, mask=mask)
        fan.cast(robot)
        grid.cast(robot)
        assert (fan.codes.item(), grid.codes.item()) == (code, code)


def test_beyond_the_reach_there_is_nothing() -> None:
    world = World()
    robot = robot_in(world)
    add_wall(world, 4.0)
    assert ahead(world, robot, reach=3.99) == (0.0, 0.0)
    assert ahead(world, robot, reach=4.01) == (1.0, 4.0)
    # a steep ray reaches less far in the plane than a level one
    for reach, code in ((4.0 / math.cos(0.1) + 0.01, 1.0), (4.0 / math.cos(0.1) - 0.01, 0.0)):
        grid = RayGrid(world, [0.0], [0.0, 0.1], reach, code_of)
        grid.cast(robot)
        assert grid.codes[1, 0] == code


def test_a_grid_sees_the_ground_down_to_its_feet_and_the_void_behind_an_edge() -> None:
    world = World()
    world.add_floor("table", BoxShape(size=(4, 4)), top=1.0)
    world.add_floor("cellar", BoxShape(size=(40, 40)), top=-1.0)
    robot = robot_in(world)
    pitches = [-math.pi / 2, -1.0, -0.2, 0.0]
    grid = RayGrid(world, [0.0], pitches, 11.0, code_of)
    grid.cast(robot)
    assert grid.codes[:, 0].tolist() == [3.0, 3.0, 0.0, 0.0]
    down, slanted = 0.5, 0.5 / math.sin(1.0)
    assert grid.distances[:, 0] == pytest.approx([down, slanted, 0.0, 0.0])
    far = RayGrid(world, [0.0], pitches, 13.0, code_of)
    far.cast(robot)
    assert far.codes[2, 0] == 3.0, "over the edge, down to the cellar"
    assert far.distances[2, 0] == pytest.approx(2.5 / math.sin(0.2))


def test_a_grid_that_looks_straight_down_only() -> None:
    world = World()
    robot = robot_in(world)
    down = RayGrid(world, [0.0, 1.0], [-math.pi / 2], 5.0, code_of, eye=(2.0, 0.0, 0.5))
    for height, code in ((None, 3.0), (0.2, 1.0), (0.8, 1.0)):
        if height:
            add_wall(world, 1.9, height=height)
        down.cast(robot)
        assert down.codes.tolist() == [[code, code]]
        depth = max(0.0, 0.5 - (height or 0.0))
        assert down.distances == pytest.approx(np.array([(depth, depth)]))
        if height:
            world.remove("wall 1.9")
