"""WebSocket servers without a world, and connections to them."""

import asyncio
import queue
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Literal, TypeVar

from websockets.http11 import Request
from websockets.server import ServerProtocol
from websockets.sync.server import ServerConnection, serve

from ai4u_edu.remote.address import Address
from ai4u_edu.remote.async_robot import AsyncConnection
from ai4u_edu.remote.steps import Close, ConnectionLostError, Flow, Open, Receive, Send
from ai4u_edu.remote.sync_connection import SyncConnection
from tests.waiting import LIMIT_S

Kind = Literal["sync", "async"]
T = TypeVar("T")


class Client:
    """A connection of either kind, whose steps are carried out one by one."""

    def __init__(self, kind: Kind, url: str) -> None:
        address = Address(url, "", is_loopback=True)
        self._sync = SyncConnection(address) if kind == "sync" else None
        self._async = AsyncConnection(address)
        self._runner = asyncio.Runner()

    def run(self, flow: Flow[T]) -> T:
        if self._sync is not None:
            return self._sync.run(flow)
        return self._runner.run(self._async.run(flow))

    def open(self, timeout: float = LIMIT_S) -> None:
        def flow() -> Flow[None]:
            yield Open(timeout)

        self.run(flow())

    def send(self, frame: bytes) -> None:
        def flow() -> Flow[None]:
            yield Send(frame)

        self.run(flow())

    def receive(self, timeout: float = LIMIT_S) -> bytes | None:
        def flow() -> Flow[bytes | None]:
            received: bytes | None = yield Receive(timeout)
            return received

        return self.run(flow())

    def close(self) -> None:
        def flow() -> Flow[None]:
            yield Close()

        self.run(flow())

    def end(self) -> None:
        self.close()
        self._runner.close()


@contextmanager
def client(kind: Kind, url: str) -> Iterator[Client]:
    """A connection that is open."""
    found = Client(kind, url)
    try:
        found.open()
        yield found
    finally:
        found.end()


@contextmanager
def serving(handler: Callable[[ServerConnection], None], **options: Any) -> Iterator[str]:
    """A server of websockets' own; its address."""
    limits = {"open_timeout": LIMIT_S, "close_timeout": LIMIT_S, "ping_interval": None}
    options = {"compression": None} | limits | options
    with serve(handler, "127.0.0.1", 0, **options) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"ws://127.0.0.1:{server.socket.getsockname()[1]}"
        finally:
            server.shutdown()
            thread.join()


@contextmanager
def raw_server(kind: Kind) -> Iterator[tuple[Client, socket.socket]]:
    """A client, and the server's socket, which does nothing by itself after the handshake."""
    accepted: queue.Queue[socket.socket] = queue.Queue()
    with socket.create_server(("127.0.0.1", 0)) as listener:
        listener.settimeout(LIMIT_S)
        thread = threading.Thread(target=lambda: accepted.put(_accept(listener)))
        thread.start()
        try:
            url = f"ws://127.0.0.1:{listener.getsockname()[1]}"
            with client(kind, url) as near, accepted.get(timeout=LIMIT_S) as far:
                yield near, far
        finally:
            thread.join()


def _accept(listener: socket.socket) -> socket.socket:
    far, _ = listener.accept()
    far.settimeout(LIMIT_S)
    protocol = ServerProtocol(subprotocols=None)
    while not (events := protocol.events_received()):
        protocol.receive_data(far.recv(2**12))
    assert isinstance(events[0], Request)
    protocol.send_response(protocol.accept(events[0]))
    far.sendall(b"".join(protocol.data_to_send()))
    return far


def loss_of(call: Callable[[], object]) -> ConnectionLostError:
    """Repeat a call until the connection is lost, and return that error."""
    while True:
        try:
            call()
        except ConnectionLostError as lost:
            return lost
