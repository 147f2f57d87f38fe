"""Collisions, and passing over or under."""

import pytest

from ai4u_edu.world import BoxShape, CircleShape, World
from tests.world.driving import LOOSE, drive, land, robot_in


@pytest.mark.parametrize("kind", ["static", "dynamic"])
def test_a_low_wall_is_jumped_over_and_stops_who_does_not_jump(kind: str) -> None:
    for jump in (True, False):
        world = World(damping=LOOSE)
        wall = world.add_body(
            "wall", BoxShape(size=(0.2, 4)), kind=kind, height=0.4, position=(2, 0), mass=1e5
        )
        robot = robot_in(world)
        robot.set_velocity(3.0, 0.0)
        if jump:
            robot.jump(6.0)
        for _ in range(75):
            world.tick()
        assert wall.position == pytest.approx((2.0, 0.0), abs=1e-3)
        if jump:
            assert robot.velocity == (3.0, 0.0)
            assert robot.pose[:3] == pytest.approx((3.0 * 75 / 60, 0.0, 0.0))
        else:
            assert robot.position[0] < 2.0 - 0.1 - 0.3 + 0.06


def test_a_bridge_is_passed_under_if_there_is_room() -> None:
    for room, comes_through in ((1.0, True), (1.5, True), (0.9, False)):
        world = World(damping=LOOSE)
        world.add_body(
            "bridge", BoxShape(size=(1, 4)), kind="static", z=room, height=0.2, position=(2, 0)
        )
        robot = robot_in(world)
        robot.set_velocity(3.0, 0.0)
        for _ in range(75):
            world.tick()
        assert (robot.position[0] > 3.0) == comes_through
        assert (robot.velocity == (3.0, 0.0)) == comes_through


def test_a_floor_sheet_is_passed_under_and_reached_from_above() -> None:
    world = World(damping=LOOSE)
    world.add_floor("ground", BoxShape(size=(20, 4)))
    world.add_floor("deck", BoxShape(size=(2, 4)), position=(3, 0), top=1.2)
    robot = robot_in(world)
    assert drive(world, robot, 120, 3.0) == 0.0
    assert robot.position[0] > 4.0
    robot.move_to(3, 0, z=0.0)
    robot.jump(6.0)
    land(world, robot)
    assert robot.z == 1.2, "a sheet lets through from below, and bears from above"
    drive(world, robot, 60, 3.0)
    assert (robot.z, robot.on_ground) == (0.0, True)


def test_a_ceiling_stops_a_jump() -> None:
    world = World(gravity=9.81)
    world.add_body("ceiling", BoxShape(size=(4, 4)), kind="static", z=1.5, height=0.5)
    robot = robot_in(world)
    robot.jump(8.0)
    heights = []
    while not robot.on_ground:
        world.tick()
        heights.append(robot.z)
    assert max(heights) == 0.5
    bump = heights.index(0.5)
    falling = heights[bump + 1 : -1]
    for ticks, z in enumerate(falling, start=1):
        assert z == pytest.approx(0.5 - 0.5 * 9.81 * (ticks * world.dt) ** 2)
    assert robot.z == 0.0
    assert robot.position == (0.0, 0.0)


def test_body_that_passed_above_collides_again_at_once() -> None:
    """Within the few ticks for which the physics remembers that the two let each other pass."""
    world = World()
    ball = world.add_body("ball", CircleShape(radius=0.3), position=(2, 0))
    robot = robot_in(world)
    robot.move_to(1.8, 0, z=2.0)
    world.tick()
    assert world.contacts.passes(robot) == (ball,)
    robot.move_to(0, 0)
    world.tick()
    robot.move_to(1.8, 0)
    for _ in range(30):
        world.tick()
    assert ball.position[0] - robot.position[0] > 0.58


def test_body_that_landed_half_above_another_collides() -> None:
    world = World(damping=LOOSE)
    low = world.add_body("low", CircleShape(), height=0.02, position=(3.4, 0))
    robot = world.add_body("robot", CircleShape(), height=1.0)
    robot.set_velocity(3.0, 0.0)
    robot.jump(4.55)
    land(world, robot)
    assert 0.5 < low.position[0] - robot.position[0] < 0.9, "half above it when it lands"
    assert world.contacts.passes(robot) == (low,)
    for _ in range(60):
        world.tick()
    assert low.position[0] - robot.position[0] > 0.98
    low.move_to(robot.position[0] + 1.5, 0)
    before = low.position[0]
    drive(world, robot, 60, 3.0)
    assert low.position[0] > before + 2.0, "and is pushed along"
