"""The same ticks twice: one by one, and as many at one go as there can be."""

import struct
from collections.abc import Callable

from ai4u_edu.blocks.actuators.ground_motion import set_body_velocity
from ai4u_edu.world import Body, Drive, World


def tell(body: Body, drive: Drive) -> None:
    """What an actuator tells a body, by the public way."""
    if not body.on_ground:
        return
    if drive.pushed:
        body.apply_force(drive.forward, drive.left)
        body.set_angular_velocity(drive.turning)
    else:
        set_body_velocity(body, *drive[:3])


def one_by_one(world: World, body: Body, drive: Drive, ticks: int) -> int:
    """Ticks without the compiled part; as many as wanted pass at one go: none."""
    for _ in range(ticks):
        tell(body, drive)
        world.tick()
    return 0


def at_one_go(world: World, body: Body, drive: Drive, ticks: int) -> int:
    """The same, as a decision does it; how many passed at one go."""
    gone = world.drive(body, drive, ticks)
    one_by_one(world, body, drive, ticks - gone)
    return gone


Way = Callable[[World, Body, Drive, int], int]


def state(world: World) -> bytes:
    """All that can be told of a world."""
    # whose touch ends in the same tick, ends in no certain order
    contacts, ended = world.contacts, sorted(world.contacts._last.items())
    told = [str((world.ticks, contacts._touching, ended)).encode()]
    for body in world.bodies.values():
        numbers = *body.pose, *body.velocity, body.angular_velocity, body.vz
        told.append(struct.pack("<8d??", *numbers, body.on_ground, body.fallen))
        told.append(",".join(other.name for other in world.contacts.passes(body)).encode())
    return b"|".join(told)
