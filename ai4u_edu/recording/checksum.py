"""A world's state, and a percept, each as one number: equal ones were equal, bit for bit."""

import struct
from zlib import crc32

from ai4u_edu.blocks import Percept
from ai4u_edu.world import Body, World

_NUMBERS = struct.Struct("<9d").pack


def percept_checksum(percept: Percept) -> int:
    """The checksum of a percept's bytes and texts."""
    number = crc32(percept.data)
    for reading in percept.texts:
        texts = reading if isinstance(reading, tuple) else (reading,)
        for text in texts:
            number = crc32(text.encode() + b"\0", number)
        if texts is reading:  # how many they are counts too: one list ends where the next begins
            number = crc32(b"%d\0" % len(texts), number)
    return number


def world_checksum(world: World) -> int:
    """The checksum of where all bodies are, and how they move; what can't move is left out."""
    return crc32(
        b"".join(
            [_state(body) for body in world.bodies.values() if body.description.kind != "static"]
        )
    )


def everything(world: World) -> tuple[object, ...]:
    """All of a world that a person may change by hand, to be compared."""
    return (
        world.generation,
        world.described,
        [(body.name, _state(body)) for body in world.bodies.values()],
    )


def _state(body: Body) -> bytes:
    return _NUMBERS(*body.pose, *body.velocity, body.angular_velocity, body.vz, float(body.fallen))
