"""A world's trajectory as bytes: ``python -m tests.world.trajectory`` writes them to stdout."""

import struct
import sys

from ai4u_edu.world import (
    BoxShape,
    CapsuleShape,
    CircleShape,
    PolygonShape,
    SegmentShape,
    World,
)


def make() -> World:
    """A pile of boxes between walls on a table, a low step, a robot, and things that fall off."""
    world = World(seed=3)
    world.add_floor("table", BoxShape(size=(12, 8)))
    world.add_floor("shelf", CircleShape(radius=1.0), position=(4, 3), top=0.5)
    world.add_body("north", SegmentShape(a=(-6, 4), b=(6, 4)), kind="static")
    world.add_body("south", SegmentShape(a=(-6, -4), b=(2, -4)), kind="static")
    world.add_body("step", BoxShape(), kind="static", height=0.3, position=(-2.5, 0))
    for i in range(12):
        world.add_body(f"box {i}", BoxShape(size=(0.6, 0.6)), position=(i % 3, i // 3 - 2))
    world.add_body("capsule", CapsuleShape(length=0.6), position=(4, 0.3), velocity=(-4, 0))
    corners = ((-0.4, -0.3), (0.4, -0.3), (0.0, 0.5))
    world.add_body("wedge", PolygonShape(vertices=corners), position=(4, 3), heading_deg=20)
    world.add_body("ball", CircleShape(radius=0.3), position=(5, -3), velocity=(3, 0))
    robot = world.add_body("robot", CircleShape(radius=0.4), position=(-5, 0), mass=4.0)
    world.contacts.watch(robot)
    return world


def run(world: World, ticks: int = 360) -> bytes:
    """Drives the robot over the step into the pile; poses, speeds and contacts of each tick."""
    written = []
    robot = world["robot"]
    for tick in range(ticks):
        if tick == 30:
            robot.jump(4.0)
        if robot.on_ground:
            robot.set_velocity(3.5, 0.2)
            robot.set_angular_velocity(float(world.seeds.generator.uniform(-3, 3)))
        world["wedge"].apply_force(4.0, 1.0)
        world.tick()
        for body in world.bodies.values():
            numbers = *body.pose, *body.velocity, body.angular_velocity, body.vz
            written.append(struct.pack("<8d??", *numbers, body.on_ground, body.fallen))
        written.append(",".join(world.contacts.of("robot")).encode())
    return b"".join(written)


if __name__ == "__main__":
    sys.stdout.buffer.write(run(make()))
