"""The decoders: native frames in both directions, AI4U's requests and replies, page messages."""

import json
import random
from typing import Any

import msgpack
import numpy as np

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.page.server.input_messages import INPUT_READER
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.wire import native
from ai4u_edu.wire.ai4u import (
    Field,
    Kind,
    ReplyCommand,
    decode_reply,
    decode_request,
    encode_reply,
    encode_request,
    number,
)
from ai4u_edu.wire.validation import WireError
from tests.fuzz.messages import KINDS, example
from tests.fuzz.mutate import bent, bent_and_packed, mangled
from tests.fuzz.target import MANY, Target

SAMPLES = tuple(example(kind, random.Random(number)) for kind in KINDS for number in range(4))
"""Valid messages: every kind that a script or a world sends."""

PACKED = (
    b"\xc0", b"\xc1", b"\xc2", b"\x80", b"\x90", b"\x91" * 1018 + b"\xc0",
    b"\x81\xa1x" * 1018 + b"\xc0",
    b"\xdd\xff\xff\xff\xff", b"\xdf\x00\x01\x00\x00", b"\xdc\x04\x01", b"\xc6\xff\xff\xff\xff",
    b"\xdb\x7f\xff\xff\xff", b"\xc7\x00\x05", b"\xd6\xff\x00\x00\x00\x00", b"\xcf" + b"\xff" * 8,
    b"\xcb\x7f\xf8" + bytes(6), b"\xa3bye", b"\xa5hello", b"\xa2\xff\xfe", b"\xed\xa0\x80",
)  # fmt: skip


FRAMES = tuple(map(native.encode, SAMPLES))


def make_frame(rng: random.Random) -> bytes:
    """Return a frame of the native protocol with a fault in it."""
    frame = rng.choice(FRAMES)
    if rng.random() < 0.5:
        return mangled(frame, rng, PACKED)
    if rng.random() < 0.1:
        # one field is what no packer writes, and all around it is right
        fields = [msgpack.packb(field) for field in msgpack.unpackb(frame)]
        fields[rng.randrange(len(fields))] = rng.choice(PACKED)
        head: bytes = msgpack.Packer().pack_array_header(len(fields))
        return head + b"".join(fields)
    return bent_and_packed(msgpack.unpackb(frame), rng)


def _read_frame(largest: int) -> Any:
    def read(frame: bytes) -> None:
        message = native.decode(frame, largest)
        again = native.encode(message)
        assert native.encode(native.decode(again, 2 * largest)) == again

    return read


def make_percept(rng: random.Random) -> bytes:
    """Return a welcome and a percept, one frame each, which need not match."""
    parts = []
    for kind in (native.Welcome, native.Percept):
        tree = msgpack.unpackb(native.encode(example(kind, rng)))
        if rng.random() < 0.7:
            # most other places only have it refused as a frame
            at = tree.index(next((part for part in tree[::-1] if isinstance(part, list)), tree[-1]))
            tree[at] = bent(tree[at], rng)
        try:
            parts.append(msgpack.packb(tree, unicode_errors="replace"))
        except (OverflowError, ValueError):
            parts.append(b"")
    return b"%8d" % len(parts[0]) + b"".join(parts)


def read_percept(data: bytes) -> None:
    """Read a welcome and a percept as a script does: every reading, and the spaces."""
    size = int(data[:8])
    welcome = native.decode(data[8 : 8 + size], native.MAX_WORLD_FRAME_BYTES)
    percept = native.decode(data[8 + size :], native.MAX_WORLD_FRAME_BYTES)
    if not isinstance(welcome, native.Welcome) or not isinstance(percept, native.Percept):
        return
    readings = {reading.key: reading for reading in welcome.readings}
    seen = RemotePercept(readings, percept)
    for key in seen:
        try:
            seen[key]
        except AI4UError:
            continue


REQUESTS = tuple(
    encode_request(fields)
    for fields in (
        (
            Field("vision", Kind.FLOATS, np.linspace(0, 1, 9)),
            Field("seen", Kind.INTS, np.arange(5)),
            Field("names", Kind.TEXTS, ["a", "b c"]),
            Field("image", Kind.BYTES, b"\x00\x01\xff"),
            Field("done", Kind.BOOL, False),
            Field("reward", Kind.FLOAT, -0.25),
            Field("steps", Kind.INT, 12),
            Field("id", Kind.TEXT, "0"),
        ),
        (
            Field("__target__", Kind.TEXT, "envcontrol"),
            Field("wait_command", Kind.TEXT, "restart"),
            Field("id", Kind.TEXT, "röbot"),
        ),
    )
)
REPLIES = tuple(
    encode_reply(orders)
    for orders in (
        (ReplyCommand("move", ("1.0", "0.5", "0", "0")), ReplyCommand("speed", ("2",))),
        (ReplyCommand("__reset__", ("0",)),),
        (ReplyCommand("max_steps", ("1000",)), ReplyCommand("id", ("0",))),
        (ReplyCommand("halt"),),
        (ReplyCommand("jump"),),
    )
)
TEXT = (
    b";", b"@", b"0", b"-1", b"99999", b"   9", b"        ", b"9" * 9000, b"nan", b"inf", b"1e999",
    b"1_0", b"\xd9\xa3", b"\x00", b"\xff", b"\xc2\xa0", b"\r\n", b"halt", b"__noop__", b" " * 4000,
    b"1.5 " * 2000, b"." * 3000, b"\xf0\x9f\xa4\x96", b"+", b"e", b"1" * 20_000 + b"x",
)  # fmt: skip


def _make_request(rng: random.Random) -> bytes:
    if rng.random() < 0.7:
        return mangled(rng.choice(REQUESTS), rng, TEXT)
    # right lengths around wrong contents, so that the decoder gets as far as the values
    parts = []
    for _ in range(rng.randrange(5)):
        name = mangled(b"eyes", rng, TEXT)[:9999]
        text = mangled(rng.choice((b"1 2.5 -3e4", b"7", b"AAEC", b"true")), rng, TEXT)
        kind = rng.randrange(10)
        parts.append(b"%4d%s%d%8d%s" % (len(name), name, kind, len(text), text))
    return b"%4d%s" % (len(parts), b"".join(parts))


def _read_request(data: bytes) -> None:
    fields = decode_request(data)
    decode_request(encode_request(fields))


def _make_reply(rng: random.Random) -> bytes:
    if rng.random() < 0.7:
        return mangled(rng.choice(REPLIES), rng, TEXT)
    orders = []
    for _ in range(rng.randrange(1, 4)):
        args = [mangled(b"0.5", rng, TEXT) for _ in range(rng.randrange(4))]
        orders.append(b";".join((b"move", b"%d" % len(args), *args)))
    return b"@".join(orders)


def _read_reply(data: bytes) -> None:
    for _, args in decode_reply(data):
        for arg in args[:50]:
            try:
                number(arg)
            except WireError:
                continue


WORDS: tuple[Any, ...] = (
    {"type": "keys", "held": ["KeyW", "Space"]},
    {"type": "take"},
    {"type": "do", "id": 0, "command": "seed", "seed": "7"},
    {"type": "do", "id": 0, "command": "pause"},
)


def make_words(rng: random.Random) -> bytes:
    """Return a message of a page with a fault in it."""
    words = rng.choice(WORDS)
    if rng.random() < 0.5:
        return mangled(json.dumps(words).encode(), rng, (b"[" * 900, b'"', b"\\ud800", *TEXT))
    return json.dumps(bent(words, rng), default=repr).encode()


WIRE = ("ai4u_edu.wire",)

NATIVE_SAID = Target(
    "native-said",
    make_frame,
    _read_frame(native.MAX_SCRIPT_FRAME_BYTES),
    (WireError,),
    packages=WIRE,
    seeds=FRAMES,
)
NATIVE_HEARD = Target(
    "native-heard",
    make_frame,
    _read_frame(native.MAX_WORLD_FRAME_BYTES),
    (WireError,),
    packages=WIRE,
    seeds=FRAMES,
)
AI4U_REQUEST = Target(
    "ai4u-request", _make_request, _read_request, (WireError,), packages=WIRE, seeds=REQUESTS
)
AI4U_REPLY = Target(
    "ai4u-reply", _make_reply, _read_reply, (WireError,), packages=WIRE, seeds=REPLIES
)
PERCEPT = Target("percept", make_percept, read_percept, (AI4UError,), count=MANY)
PAGE = Target("page-words", make_words, INPUT_READER.read, (ValueError,), count=MANY)
