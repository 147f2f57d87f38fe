"""A hundred clients that never read do not affect the others."""

import json
import socket
import struct
from urllib.request import urlopen

import psutil
import pytest
import viser

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server import ServerThread, room_app
from ai4u_edu.server.scripts import Rules
from ai4u_edu.viewer import Viewer
from ai4u_edu.wire import native
from tests.load.clients import CAMERA
from tests.load.world import crowd
from tests.server.rooms import UPGRADE, raw_request
from tests.waiting import until

pytestmark = pytest.mark.alone

BRAINS, VIEWERS = 20, 80


def masked(frame: bytes) -> bytes:
    """Return a frame as a client sends it over a WebSocket."""
    size = len(frame)
    head = bytes((0x80 | size,)) if size < 126 else b"\xfe" + struct.pack(">H", size)
    return b"\x82" + head + bytes(4) + frame


def hello(number: int) -> bytes:
    """Return a script's first message."""
    return native.encode(
        native.Hello(native.VERSION, str(number), "", "realtime", (), "", "s" * 20)
    )


def opened(url: str, subprotocol: str, first: bytes) -> socket.socket:
    """Open a connection that completes the handshake, sends one message, and never reads."""
    lines = (*UPGRADE, "Host: localhost", f"Sec-WebSocket-Protocol: {subprotocol}")
    connection = raw_request(url, *lines)
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    assert connection.recv(12) == b"HTTP/1.1 101"
    connection.sendall(masked(first))
    return connection


def test_a_hundred_clients_that_never_read_stop_no_other() -> None:
    process = psutil.Process()
    before = process.num_fds(), process.num_threads()
    runner = Runner(crowd(BRAINS), seed=1)
    viewer = Viewer(runner)
    app = room_app(runner, viser_port=viewer.port, title="Load", rules=Rules(grace=0.1))
    runner.start()
    viewer.start()
    connections: list[socket.socket] = []
    try:
        with ServerThread(app) as server:
            scripts = server.url + "ws/remote", native.SUBPROTOCOL
            connections += [opened(*scripts, hello(number)) for number in range(BRAINS)]
            pages = server.url, f"viser-v{viser.__version__}", CAMERA
            connections += [opened(*pages) for _ in range(VIEWERS)]
            until(lambda: all(agent.remote for agent in runner.latest.agents))
            until(lambda: len(viewer.server.get_clients()) == VIEWERS)
            tick = runner.latest.tick
            until(lambda: runner.latest.tick > tick + 30)
            with urlopen(server.url + "api/snapshot") as answer:  # noqa: S310 - our own server
                assert len(json.load(answer)["agents"]) == BRAINS
            for connection in connections:
                connection.close()
            # who is gone leaves nothing behind: the seats are free, and viser has forgotten them
            until(lambda: not any(agent.remote for agent in runner.latest.agents))
            until(lambda: not viewer.server.get_clients())
            assert runner.error == ""
    finally:
        for connection in connections:
            connection.close()
        viewer.stop()
        runner.stop()
    until(lambda: process.num_fds() <= before[0] + 8 and process.num_threads() <= before[1] + 40)
