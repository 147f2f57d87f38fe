"""Checksums of a world's state and of percepts, to compare them bit for bit."""

import struct
from zlib import crc32

from ai4u_edu.blocks import Percept
from ai4u_edu.world import Body, World

_NUMBERS = struct.Struct("<9d").pack


def percept_checksum(percept: Percept) -> int:
    """Return the checksum of a percept's bytes and texts."""
    number = crc32(percept.data)
    for reading in percept.texts:
        texts = reading if isinstance(reading, tuple) else (reading,)
        for text in texts:
            number = crc32(text.encode() + b"\0", number)
        if texts is reading:  # the count tells where one list of texts ends
            number = crc32(b"%d\0" % len(texts), number)
    return number


def world_checksum(world: World) -> int:
    """Return the checksum of what moves: poses and velocities of bodies, and ink."""
    number = crc32(
        b"".join(
            [_state(body) for body in world.bodies.values() if body.description.kind != "static"]
        )
    )
    # without ink it is what it was before there were pens
    return crc32(b"%d" % world.ink.digest, number) if world.ink.digest else number


def editable_state(world: World) -> tuple[object, ...]:
    """Return everything in a world that a person can edit, for comparison."""
    return (
        world.generation,
        world.described,
        world.field,
        [(body.name, _state(body)) for body in world.bodies.values()],
    )


def _state(body: Body) -> bytes:
    return _NUMBERS(*body.pose, *body.velocity, body.angular_velocity, body.vz, float(body.fallen))
