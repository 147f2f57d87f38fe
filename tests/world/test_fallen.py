"""A body that falls below the threshold leaves the physics until it is put back."""

import pytest

from ai4u_edu.world import Body, BoxShape, CircleShape, World, WorldView


def fall(world: World, body: Body) -> None:
    for _ in range(300):
        if body.fallen:
            return
        world.tick()
    raise AssertionError("it did not fall")


@pytest.fixture
def world() -> World:
    """A table with a robot on it, and a box right beside the table."""
    world = World(fall_threshold=-2.0)
    world.add_floor("table", BoxShape(size=(4, 4)))
    world.add_body("robot", CircleShape(radius=0.3))
    world.add_body("box", BoxShape(), position=(2.7, 0))
    return world


def test_below_the_threshold_it_is_out(world: World) -> None:
    box = world["box"]
    fall(world, box)
    assert -2.5 < box.z < -2.0, "in the tick in which it gets there"
    assert (box.vz, box.velocity, box.on_ground) == (0.0, (0.0, 0.0), False)
    pose = box.pose
    robot = world["robot"]
    for _ in range(100):
        robot.set_velocity(3.0, 0.0)
        world.tick()
    assert box.pose == pose
    assert robot.fallen, "nothing held it back"


def test_the_threshold_is_a_setting() -> None:
    world = World(fall_threshold=-0.5)
    world.add_floor("table", BoxShape(size=(1, 1)))
    robot = world.add_body("robot", CircleShape(), position=(5, 0))
    ticks = 0
    while not robot.fallen:
        world.tick()
        ticks += 1
    assert ticks == 20, "the root of 2 * 0.5 m / 9.81 is 0.319 s, that is 19.2 ticks"


def test_its_contacts_are_forgotten(world: World) -> None:
    robot, box = world["robot"], world["box"]
    view = WorldView(world)
    world.contacts.watch(robot)
    world.contacts.watch(box)
    # both on the brink and into each other
    robot.move_to(1.95, 0)
    box.move_to(2.7, 0)
    world.tick()
    world.tick()
    assert view.touching(robot, "box")
    assert view.touching(box, "robot")
    fall(world, box)
    assert view.contacts(robot) == ()
    assert view.contacts(box) == ()
    assert view.touched_after(robot, "box", 0)


def test_it_can_be_put_back(world: World) -> None:
    robot, box = world["robot"], world["box"]
    fall(world, box)
    for _ in range(100):
        box.apply_force(10.0, 0.0)
        box.set_velocity(5.0, 0.0)
    box.jump(5.0)
    assert box.vz == 0.0, "who is out can't jump"
    box.move_to(1.4, 0)
    assert (box.fallen, box.z, box.on_ground) == (False, 0.0, True)
    world.tick()
    assert box.velocity == (0.0, 0.0), "what pushed it while it was out is forgotten"
    for _ in range(60):
        robot.set_velocity(1.0, 0.0)
        world.tick()
    assert box.position[0] > 1.5, "it is there again"
    fall(world, box)
    assert box.fallen, "and can fall again"


def test_a_reset_puts_it_back(world: World) -> None:
    robot, box = world["robot"], world["box"]
    robot.move_to(3, 3)
    fall(world, robot)
    fall(world, box)
    world.reset()
    assert robot.pose == (0.0, 0.0, 0.0, 0.0)
    assert (robot.fallen, robot.on_ground) == (False, True)
    assert (box.fallen, box.on_ground, box.z) == (False, False, 0.0)
    fall(world, box)


def test_it_can_be_removed(world: World) -> None:
    fall(world, world["box"])
    world.remove("box")
    assert list(world.bodies) == ["robot"]
    world.tick()
    world.add_body("box", BoxShape(), position=(1, 1))


def test_a_new_floor_does_not_bring_it_back(world: World) -> None:
    robot, box = world["robot"], world["box"]
    robot.jump(6.0)
    fall(world, box)
    height = robot.z
    assert height > 0.5
    world.add_floor("late", BoxShape(size=(20, 20)), top=-1.0)
    assert (robot.z, box.fallen) == (height, True), "nor does it touch who is in the air"
    for _ in range(120):
        world.tick()
    assert (robot.z, box.fallen) == (0.0, True)
