"""Standing on obstacles and on higher floors."""

import pytest

from ai4u_edu.world import BoxShape, CircleShape, PolygonShape, World
from tests.world.driving import LOOSE, drive, land, robot_in, walk_off


@pytest.mark.parametrize("kind", ["static", "dynamic", "kinematic"])
def test_landing_on_an_obstacle_and_walking_off_again(kind: str) -> None:
    world = World(damping=LOOSE)
    box = world.add_body(
        "box", BoxShape(size=(2, 2)), kind=kind, height=0.8, position=(3, 0), mass=5.0
    )
    robot = robot_in(world)
    robot.set_velocity(3.0, 0.0)
    robot.jump(6.0)
    land(world, robot)
    assert (robot.z, robot.vz) == (0.8, 0.0)
    assert robot.velocity == (3.0, 0.0), "the box did not stop it"
    assert box.position == (3.0, 0.0), "and was not pushed"
    walk_off(world, robot, 3.0)
    edge = box.position[0] + 1.0
    assert edge < robot.position[0] < edge + 3.0 * world.dt + 1e-9
    for _ in range(120):
        world.tick()
    assert (robot.z, robot.on_ground) == (0.0, True)
    assert robot.position[0] - box.position[0] > 1.0 + 0.3 - 0.02, "beside it, not in it"


def test_body_falls_when_its_support_is_removed() -> None:
    world = World()
    world.add_body("crate", BoxShape(), kind="static", height=0.5)
    lower = world.add_body("lower", CircleShape(radius=0.3), z=0.5)
    upper = world.add_body("upper", CircleShape(radius=0.3), z=1.5)
    assert lower.on_ground
    assert upper.on_ground, "at once, before any tick"
    world.remove("crate")
    for _ in range(60):
        world.tick()
    assert (lower.z, upper.z) == (0.0, 1.0)
    lower.move_to(4, 0)
    for _ in range(60):
        world.tick()
    assert (upper.z, upper.on_ground) == (0.0, True)


def test_noncolliding_bodies_do_not_support() -> None:
    world = World()
    world.add_body("ghost", BoxShape(), kind="static", height=0.5, collision_mask=2)
    world.add_body("other", BoxShape(), kind="static", height=0.5, collision_layer=2)
    robot = world.add_body("robot", CircleShape(), z=1.0, collision_layer=1, collision_mask=1)
    for _ in range(60):
        world.tick()
    assert robot.z == 0.0


def test_body_that_carries_another_cannot_jump() -> None:
    world = World()
    robot = robot_in(world)
    rider = world.add_body("rider", CircleShape(radius=0.2), z=1.0)
    world.tick()
    robot.jump(5.0)
    for _ in range(30):
        world.tick()
    assert (robot.z, rider.z, robot.on_ground, rider.on_ground) == (0.0, 1.0, True, True)


def test_bodies_on_a_higher_floor_collide() -> None:
    world = World(damping=LOOSE)
    world.add_floor("deck", BoxShape(size=(20, 4)), top=3.0)
    robot = robot_in(world)
    ball = world.add_body("ball", CircleShape(radius=0.3), position=(2, 0))
    drive(world, robot, 90, 3.0)
    assert (robot.z, ball.z) == (3.0, 3.0)
    assert ball.position[0] - robot.position[0] > 0.5
    assert ball.position[0] > 3.0


def test_a_step_up_needs_a_jump() -> None:
    world = World(damping=LOOSE)
    world.add_floor("ground", BoxShape(size=(20, 4)))
    world.add_body("step", BoxShape(size=(2, 4)), kind="static", height=0.3, position=(3, 0))
    robot = robot_in(world)
    drive(world, robot, 60, 2.0)
    assert robot.position[0] < 2.0
    robot.jump(3.5)
    drive(world, robot, 60, 2.0)
    assert (robot.z, robot.on_ground) == (0.3, True)


@pytest.mark.parametrize("speed", [(3.0, 1.0), (-3.0, 0.1), (0.5, -3.0)])
def test_a_box_of_floor_carries_like_the_same_polygon(speed: tuple[float, float]) -> None:
    polygon = PolygonShape(vertices=((-2.0, -1.5), (2.0, -1.5), (2.0, 1.5), (-2.0, 1.5)))
    ways = [_way_over(BoxShape(size=(4, 3)), speed), _way_over(polygon, speed)]
    assert ways[0] == ways[1], "a box is looked up faster, and nothing else"
    assert ways[0][-1][2] < 0.0, "it went over the edge"


def _way_over(
    shape: BoxShape | PolygonShape, speed: tuple[float, float]
) -> list[tuple[float, ...]]:
    """Return the poses of a robot that rolls over a floor's edge, tick by tick."""
    world = World(damping=LOOSE)
    world.add_floor("floor", shape)
    robot = robot_in(world)
    robot.set_velocity(*speed)
    way: list[tuple[float, ...]] = []
    while robot.z > -1.0:
        world.tick()
        way.append(robot.pose)
    return way
