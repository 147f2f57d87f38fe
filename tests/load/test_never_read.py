"""A hundred clients that never read do not affect the others."""

import json
import socket
import struct
from urllib.request import urlopen

import psutil
import pytest
import viser

from ai4u_edu.page.server import ServerThread, room_app
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire import native
from tests.load.clients import CAMERA
from tests.load.world import crowd
from tests.page.server.rooms import PATIENT, UPGRADE, raw_request
from tests.remote.rooms import patient_rules
from tests.waiting import LIMIT_S, until

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
    connection = raw_request(url, *lines, receive_buffer=4096)
    assert connection.recv(12, socket.MSG_WAITALL) == b"HTTP/1.1 101"
    connection.sendall(masked(first))
    return connection


def test_a_hundred_clients_that_never_read_stop_no_other() -> None:
    process = psutil.Process()
    before = process.num_fds(), process.num_threads()
    runner = Runner(crowd(BRAINS), seed=1)
    viewer = Viewer(runner)
    # real time: the seats must be free once the grace time has passed after the end of a script
    rules = patient_rules(grace=0.1)
    app = room_app(runner, viser_port=viewer.port, title="Load", rules=rules, timeouts=PATIENT)
    met: set[int] = set()  # viser itself closes pages that answer no ping for a while
    viewer.server.on_client_connect(lambda client: met.add(client.client_id))
    runner.start()
    viewer.start()
    connections: list[socket.socket] = []
    try:
        with ServerThread(app, timeouts=PATIENT) as server:
            scripts = server.url + "ws/remote", native.SUBPROTOCOL
            connections += [opened(*scripts, hello(number)) for number in range(BRAINS)]
            pages = server.url, f"viser-v{viser.__version__}", CAMERA
            connections += [opened(*pages) for _ in range(VIEWERS)]
            until(lambda: all(agent.remote for agent in runner.latest.agents))
            until(lambda: len(met) == VIEWERS)
            tick = runner.latest.tick
            until(lambda: runner.latest.tick > tick + 30)
            with urlopen(server.url + "api/snapshot", timeout=LIMIT_S) as answer:  # noqa: S310 - our own
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
        runner.stop(LIMIT_S)
    until(lambda: process.num_fds() <= before[0] + 8 and process.num_threads() <= before[1] + 40)
