"""Frames by the short way are those that came, however the stream was cut to pieces."""

import os
import random
import time
from collections.abc import Callable

from hypothesis import given
from hypothesis import strategies as st
from starlette.types import Receive, Scope, Send
from websockets.frames import Frame, Opcode

from ai4u_edu.server import ServerThread
from ai4u_edu.server.boundary import Boundary
from ai4u_edu.server.frames import EXTENSION, FramesProtocol
from tests.server.rooms import UPGRADE, raw_request, until

SIZES = st.sampled_from([0, 1, 5, 125, 126, 127, 300, 65535, 65536])


def framed(data: bytes, opcode: Opcode = Opcode.BINARY, fin: bool = True) -> bytes:
    """A frame as a client sends it."""
    return Frame(opcode, data, fin).serialize(mask=True)


@given(st.lists(SIZES, max_size=5), st.integers(0, 2**32))
def test_the_boundary_is_where_a_frame_ends(sizes: list[int], seed: int) -> None:
    chance = random.Random(seed)
    whole = [framed(bytes(size)) for size in sizes]
    stream = b"".join(whole)
    ends = {sum(map(len, whole[:number])) for number in range(len(whole) + 1)}
    boundary, place = Boundary(), 0
    while place < len(stream):
        size = chance.randint(1, chance.choice((1, 9, len(stream))))
        boundary.feed(stream[place : place + size])
        place = min(place + size, len(stream))
        assert boundary.is_reached == (place in ends)


class Listening:
    """An app that takes some frames by the short way, and the others by the long one."""

    def __init__(self, takes: Callable[[bytes], bool]) -> None:
        self.takes = takes
        self.heard: list[bytes] = []
        self.short = 0

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "websocket":
            return
        await receive()
        frames: FramesProtocol = scope["extensions"][EXTENSION]
        frames.listener = self.listen
        await send({"type": "websocket.accept"})
        while (message := await receive())["type"] == "websocket.receive":
            self.heard.append(message.get("bytes") or message["text"].encode())

    def listen(self, frame: bytes) -> bool:
        if not self.takes(frame):
            return False
        self.heard.append(frame)
        self.short += 1
        return True


def poured(chunks: list[bytes], expected: list[bytes], app: Listening) -> None:
    with ServerThread(app) as server:
        connection = raw_request(server.url, "Host: localhost", *UPGRADE)
        assert connection.recv(12) == b"HTTP/1.1 101"
        for chunk in chunks:
            connection.sendall(chunk)
            time.sleep(0.002)  # so that it comes alone
        until(lambda: len(app.heard) >= len(expected))
        assert app.heard == expected
        connection.close()


def test_frames_alone_together_and_in_pieces_come_in_their_order() -> None:
    frames = [os.urandom(size) or b"" for size in (1, 125, 126, 300, 5, 7, 65535, 70_000, 9)]
    wire = [framed(frame) for frame in frames]
    pieces = [framed(b"in ", fin=False), framed(b"pie", Opcode.CONT, False)]
    chunks = [
        *wire[:3],
        wire[3][:1],  # a frame byte by byte at first
        wire[3][1:2],
        wire[3][2:],
        wire[4] + wire[5],
        *wire[6:8],
        pieces[0],
        framed(b"ping", Opcode.PING),
        pieces[1],
        framed(b"ces", Opcode.CONT),
        framed(b"text", Opcode.TEXT),
        wire[8],
    ]
    expected = [*frames[:8], b"in pieces", b"text", frames[8]]
    poured(chunks, expected, Listening(lambda frame: True))
    app = Listening(lambda frame: False)
    poured(chunks, expected, app)
    assert app.short == 0
    poured(chunks, expected, Listening(lambda frame: len(frame) % 2 == 1))


def test_a_piece_that_looks_like_a_frame_is_none() -> None:
    inner = framed(b"not a frame of its own")
    outer = framed(inner)
    # masked with zeros the inner one stands in the stream as it is
    outer = outer[:2] + bytes(4) + inner
    poured([outer[:6], outer[6:]], [inner], Listening(lambda frame: True))
    first, rest = framed(b"a", fin=False), framed(b"b", Opcode.CONT)
    poured([first, rest, framed(b"c")], [b"ab", b"c"], Listening(lambda frame: True))


def test_a_message_in_the_middle_of_another_ends_the_connection() -> None:
    app = Listening(lambda frame: True)
    with ServerThread(app) as server:
        connection = raw_request(server.url, "Host: localhost", *UPGRADE)
        assert connection.recv(12) == b"HTTP/1.1 101"
        connection.sendall(framed(b"a", fin=False))
        time.sleep(0.05)
        connection.sendall(framed(b"b"))
        said = b""
        while b"\x88" not in said:  # a close, with 1002
            said += connection.recv(4096)
        assert said[said.index(b"\x88") + 2 :][:2] == (1002).to_bytes(2, "big")
        connection.close()
    assert app.heard == []
