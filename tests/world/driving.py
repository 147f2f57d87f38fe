"""Driving a robot in tests."""

from ai4u_edu.world import Body, CircleShape, World

LOOSE = 1.0
"""No friction on the ground, so that a speed can be followed."""


def drive(world: World, body: Body, ticks: int, speed: float) -> float:
    """Drives a body along x; returns how high it got."""
    top = body.z
    for _ in range(ticks):
        body.set_velocity(speed, 0.0)
        world.tick()
        top = max(top, body.z)
    return top


def land(world: World, body: Body) -> None:
    while not body.on_ground:
        world.tick()


def walk_off(world: World, body: Body, speed: float) -> None:
    while body.on_ground:
        body.set_velocity(speed, 0.0)
        world.tick()


def robot_in(world: World, **fields: float) -> Body:
    return world.add_body("robot", CircleShape(radius=0.3), height=1.0, **fields)
