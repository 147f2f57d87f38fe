"""Rooms that really listen, and pages that really connect to them."""

import json
import math
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import Any, Self
from unittest.mock import patch
from urllib.parse import urlsplit

from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Receive, Scope, Send
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from ai4u_edu import ControlRequestor, WASDRBMoveController
from ai4u_edu.base.log_limit import LOG_INTERVAL_S
from ai4u_edu.blocks.keyboard import KEY_TIMEOUT_S, Keyboard
from ai4u_edu.page.server import ServerThread, Timeouts, room_app
from ai4u_edu.runtime import tick_monitor
from ai4u_edu.runtime.runner import Runner
from tests.builders import small_sim
from tests.evidence import Messages
from tests.waiting import LIMIT_S, Deadline

NOWHERE = 9
"""Port at which no viser listens."""
PATIENT = Timeouts(
    request=LIMIT_S,
    linger=LIMIT_S,
    stall=LIMIT_S,
    handshake=LIMIT_S,
    ping=LIMIT_S,
    close=LIMIT_S,
    viser=LIMIT_S,
    open_scene=LIMIT_S,
    frame=LIMIT_S,
    upload=LIMIT_S,
)
"""Time limits that only a fault reaches. Those of a server that ends are as usual, so that no test
waits for pages that it has left open."""


@dataclass
class Clock:
    """Seconds that a test sets."""

    now: float = 0.0

    def __call__(self) -> float:
        return self.now


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

    @property
    def move(self) -> tuple[float, ...]:
        """Latest action "move" of the first agent; empty before its first decision."""
        return tuple(self.runner.latest.agents[0].action.get("move", ()))

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
    port: int = 0,
    timeouts: Timeouts = PATIENT,
    key_clock: Callable[[], float] | None = None,
    stall_s: float = LIMIT_S,
    **options: Any,
) -> Iterator[Room]:
    """Serve a room at a free port, or at that of a server that is there.

    Args:
        port: to listen at, such as a ``kept_port()``; 0 for any free one.
        wrap: may wrap the room's app.
        timeouts: of the room and its own server.
        key_clock: clock of the keyboards, by which keys of a silent page are forgotten; default:
            they are not, in no world, since a page on a busy machine is silent for too long.
        stall_s: time (s) after which the room says that a block does not return.
        options: more of :func:`room_app`.
    """
    sim = sim or small_sim(controller=WASDRBMoveController())
    if key_clock is not None:
        for agent in sim.agents:
            agent.keyboard.clock = key_clock
    key_timeout = math.inf if key_clock is None else KEY_TIMEOUT_S
    runner = Runner(sim, seed=1, wait_for_key=wait_for_key)
    app = room_app(runner, viser_port=viser_port, title=title, timeouts=timeouts, **options)
    with (
        patch.object(Keyboard, "timeout_s", key_timeout),
        patch.object(tick_monitor, "STALL_S", stall_s),
    ):
        runner.start()
        try:
            if server is not None:
                server.app = wrap(app)
                yield Room(runner, server.url)
            else:
                with ServerThread(wrap(app), port=port, timeouts=timeouts) as own:
                    yield Room(runner, own.url)
        finally:
            runner.stop(LIMIT_S)


class SharedServer:
    """Server of rooms, one at a time, at one address.

    A browser keeps what it loaded from there, and no test waits for a server to end.
    """

    def __init__(self) -> None:
        self.app: ASGIApp = PlainTextResponse("no room is here yet", 404)
        self._thread = ServerThread(self, timeouts=PATIENT)
        self.url = self._thread.url

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        await self.app(scope, receive, send)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._thread.stop()


def open_socket(url: str, **options: Any) -> ClientConnection:
    """Connect to a WebSocket, whose other end may be silent for as long as it likes.

    Args:
        url: with the scheme http or ws.
        options: more of ``websockets.sync.client.connect``.
    """
    return connect(
        url.replace("http", "ws", 1),
        create_connection=_NotedConnection,
        open_timeout=LIMIT_S,
        ping_interval=None,
        proxy=None,
        **options,
    )


class _NotedConnection(ClientConnection):
    """Connection whose last messages are kept if a test fails."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self._messages = Messages("socket")

    def send(self, message: Any, text: bool | None = None) -> None:
        self._messages.sent(message)
        super().send(message, text)

    def recv(self, timeout: float | None = None, decode: bool | None = None) -> Any:
        message = super().recv(timeout, decode)
        self._messages.received(message)
        return message


class Page:
    """Client of the input socket."""

    def __init__(self, url: str, **options: Any) -> None:
        self.socket = open_socket(url, **options)
        self.last: dict[str, dict[str, Any]] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.socket.close()

    def send(self, kind: str, **rest: Any) -> None:
        self.socket.send(json.dumps({"type": kind, **rest}))

    def do(self, command: str, **arguments: Any) -> None:
        """Send a command; it gets no answer."""
        self.send("do", id=0, command=command, **arguments)

    def hold(self, *codes: str) -> None:
        self.send("keys", held=list(codes))

    @contextmanager
    def holding(self, *codes: str) -> Iterator[None]:
        """Hold keys as pages do: they repeat them, since the server soon forgets a silent page."""
        over = threading.Event()

        def repeat() -> None:
            # real time: period of a page's messages; a longer one changes nothing that tests see
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

    def settle(self) -> None:
        """Wait until the server has handled everything that this page has sent.

        Its answer to a malformed message comes after that.
        """
        self.send("settle")
        while "unknown type 'settle'" not in self.receive("error")["text"]:
            pass

    def end(self) -> tuple[int, str]:
        """Wait for the close, and return its code and reason."""
        deadline = Deadline()
        while True:
            try:
                self.socket.recv(deadline.left())
            except ConnectionClosed as closed:
                return (closed.rcvd.code, closed.rcvd.reason) if closed.rcvd else (1006, "")


def log_intervals(began: float) -> int:
    """Return how many lines of one kind a limited log may have.

    Args:
        began: earliest time (s, of time.monotonic) of the first one.
    """
    # real time: the log's limit is one line every so often; a test that takes longer may write more
    return 1 + math.ceil((time.monotonic() - began) / LOG_INTERVAL_S)


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


def connected(url: str, receive_buffer: int | None = None) -> socket.socket:
    """Return a connection with a server.

    Args:
        receive_buffer: size (bytes) of the buffer of what has not been read here. Made smaller
            after connecting, it may stop the other direction, too: Linux drops acknowledgments
            with what does not fit.
    """
    parts = urlsplit(url)
    with ExitStack() as stack:
        connection = stack.enter_context(socket.socket())
        connection.settimeout(LIMIT_S)
        if receive_buffer is not None:
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        connection.connect((parts.hostname, parts.port or 80))
        stack.pop_all()
    return connection


def raw_request(url: str, *lines: str, receive_buffer: int | None = None) -> socket.socket:
    """Return a connection after a request with exactly these headers."""
    parts = urlsplit(url)
    connection = connected(url, receive_buffer)
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
            part = connection.recv(65536)
            assert part, f"the connection was closed after {answer!r}"
            answer += part
        head, _, body = answer.partition(b"\r\n\r\n")
        return int(head.split()[1]), body.decode(errors="replace")
