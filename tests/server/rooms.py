"""Rooms that really listen, and pages that really connect to them."""

import json
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Self
from urllib.parse import urlsplit

from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Receive, Scope, Send
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from ai4u_edu import ControlRequestor, WASDRBMoveController
from ai4u_edu.blocks.brains.controllers.keyboard import Keyboard
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server import ServerThread, room_app
from tests.builders import small_sim
from tests.waiting import LIMIT_S, Deadline

NOWHERE = 9
"""Port at which no viser listens."""


@dataclass
class Room:
    """Room that is served."""

    runner: Runner
    url: str

    @property
    def sim(self) -> ControlRequestor:
        return self.runner.sim

    @property
    def held(self) -> list[str]:
        """Keys that the first agent's keyboard holds now."""
        return sorted(self.sim.agents[0].keyboard.held())

    def page(self, query: str = "") -> "Page":
        return Page(self.url + "ws/input" + query)


@contextmanager
def served(
    sim: ControlRequestor | None = None,
    *,
    viser_port: int = NOWHERE,
    title: str | Callable[[], str] = "A room",
    wrap: Callable[[ASGIApp], ASGIApp] = lambda app: app,
    wait_for_key: bool = False,
    server: "SharedServer | None" = None,
    key_clock: Callable[[], float] = lambda: 0.0,
    **options: Any,
) -> Iterator[Room]:
    """Serve a room at a free port, or at that of a server that is there.

    Args:
        wrap: may wrap the room's app.
        key_clock: clock of the keyboards; default, it stands still, and keys are held until they
            are released, although a page on a busy machine is silent for too long.
        options: more of :func:`room_app`.
    """
    sim = sim or small_sim(controller=WASDRBMoveController())
    for agent in sim.agents:
        agent.keyboard = Keyboard(clock=key_clock)
    runner = Runner(sim, seed=1, wait_for_key=wait_for_key)
    app = room_app(runner, viser_port=viser_port, title=title, **options)
    runner.start()
    try:
        if server is not None:
            server.app = wrap(app)
            yield Room(runner, server.url)
        else:
            with ServerThread(wrap(app)) as own:
                yield Room(runner, own.url)
    finally:
        runner.stop()


class SharedServer:
    """Server of rooms, one after the other, at one address.

    A browser keeps what it loaded from there, and no test waits for a server to end.
    """

    def __init__(self) -> None:
        self.app: ASGIApp = PlainTextResponse("no room is here yet", 404)
        self._thread = ServerThread(self)
        self.url = self._thread.url

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        await self.app(scope, receive, send)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._thread.stop()


class Page:
    """Client of the input socket."""

    def __init__(self, url: str, **options: Any) -> None:
        self.socket = connect(url.replace("http", "ws", 1), proxy=None, **options)
        self.last: dict[str, dict[str, Any]] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.socket.close()

    def send(self, kind: str, **rest: Any) -> None:
        self.socket.send(json.dumps({"type": kind, **rest}))

    def hold(self, *codes: str) -> None:
        self.send("keys", held=list(codes))

    @contextmanager
    def holding(self, *codes: str) -> Iterator[None]:
        """Hold keys as pages do: they repeat them, since the server soon forgets a silent page."""
        over = threading.Event()

        def repeat() -> None:
            while not over.wait(0.1):
                self.hold(*codes)

        self.hold(*codes)
        thread = threading.Thread(target=repeat)
        thread.start()
        try:
            yield
        finally:
            over.set()
            thread.join()

    def receive(self, kind: str, **wanted: Any) -> dict[str, Any]:
        """Return the next event of a type with the given fields; skip others."""
        deadline = Deadline()
        while True:
            frame = json.loads(self.socket.recv(deadline.left()))
            self.last[frame["type"]] = frame
            if frame["type"] == kind and wanted.items() <= frame.items():
                return dict(frame)

    def end(self) -> tuple[int, str]:
        """Wait for the close, and return its code and reason."""
        deadline = Deadline()
        while True:
            try:
                self.socket.recv(deadline.left())
            except ConnectionClosed as closed:
                return (closed.rcvd.code, closed.rcvd.reason) if closed.rcvd else (1006, "")


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


def raw_request(url: str, *lines: str) -> socket.socket:
    """Return a connection after a request with exactly these headers."""
    parts = urlsplit(url)
    connection = socket.create_connection((parts.hostname, parts.port or 80), timeout=LIMIT_S)
    connection.sendall("\r\n".join([f"GET {parts.path} HTTP/1.1", *lines, "", ""]).encode())
    return connection


UPGRADE = (
    "Connection: Upgrade",
    "Upgrade: websocket",
    "Sec-WebSocket-Version: 13",
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
)


def raw_answer(url: str, *lines: str) -> tuple[int, str]:
    """Return the status and the text of the answer to such a request."""
    with raw_request(url, *lines) as connection:
        answer = b""
        while b"\r\n\r\n" not in answer:
            answer += connection.recv(65536)
        head, _, body = answer.partition(b"\r\n\r\n")
        return int(head.split()[1]), body.decode(errors="replace")
