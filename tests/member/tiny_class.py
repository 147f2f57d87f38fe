"""A class that knows one secret, remembers what it got, and breaks off when a test says so."""

import os
import socket
import threading
import weakref
from typing import Self

from websockets.exceptions import ConnectionClosed
from websockets.sync.server import Server, ServerConnection, serve
from websockets.typing import Subprotocol

from ai4u_edu.member import LinkTimeouts
from ai4u_edu.wire.class_link import (
    MAX_FRAME_BYTES,
    SUBPROTOCOL,
    VERSION,
    Ack,
    Delivery,
    FromClass,
    FromRoom,
    LinkHello,
    LinkProblem,
    LinkWelcome,
    Result,
    State,
    decode_from_room,
    encode_from_class,
)
from tests.waiting import LIMIT_S

SECRET = "seat-token"
PATIENT = LinkTimeouts(*[LIMIT_S] * 7)
"""Time limits of a client that only a fault reaches."""


class TinyClass:
    """A server of links at one port, which nobody else gets before its start or after its end."""

    def __init__(self) -> None:
        self.got: list[FromRoom] = []
        """All messages except hellos, of all connections."""
        self.hellos: list[LinkHello] = []
        self.is_acknowledging = True
        self.is_welcoming = True
        self.refusal = ""
        """Reason with which every connection is closed."""
        self._socket = self._bound(0)
        self.port: int = self._socket.getsockname()[1]
        self._connections: list[ServerConnection] = []
        self._server: Server | None = None
        self._thread: threading.Thread | None = None

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()
        self._socket.close()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}/"

    @property
    def results(self) -> list[str]:
        """Keys of the results, each time that they came."""
        return [each.key for each in self.got if isinstance(each, Result)]

    @property
    def states(self) -> list[State]:
        return [each for each in self.got if isinstance(each, State)]

    def of(self, kind: type) -> list[FromRoom]:
        return [each for each in self.got if isinstance(each, kind)]

    def start(self) -> None:
        if self._socket.getsockname()[1] != self.port:
            self._socket.close()
            self._socket = self._bound(self.port)
        self._socket.listen()
        self._server = serve(
            self._talk,
            sock=self._socket,
            subprotocols=[Subprotocol(SUBPROTOCOL)],
            max_size=MAX_FRAME_BYTES,
            open_timeout=LIMIT_S,
            ping_interval=None,
        )
        self._thread = threading.Thread(target=self._server.serve_forever)
        self._thread.start()

    def stop(self) -> None:
        """End the server, which may start again."""
        if self._server is not None and self._thread is not None:
            self._server.shutdown()
            self._socket = self._bound(self.port)
            self._thread.join()
            self.drop()
            self._server = None

    def drop(self) -> None:
        """Break off all connections, without a goodbye."""
        connections, self._connections = self._connections, []
        for each in connections:
            each.close_socket()

    def send(self, message: FromClass) -> None:
        for each in self._connections:
            each.send(encode_from_class(message))

    def _talk(self, connection: ServerConnection) -> None:
        def send(said: FromClass) -> None:
            connection.send(encode_from_class(said))

        try:
            hello = decode_from_room(connection.recv(decode=False))
            assert isinstance(hello, LinkHello)
            self.hellos.append(hello)
            if self.refusal:
                connection.close(1008, self.refusal)
                return
            if hello.secret != SECRET:
                send(LinkProblem("secret", "This seat is not known. Join again."))
                return
            self._connections.append(connection)  # first: who is welcome may be sent more at once
            if self.is_welcoming:
                send(LinkWelcome(VERSION, "Red Fox", "#d55e00"))
            while True:
                message = decode_from_room(connection.recv(decode=False))
                self.got.append(message)
                if isinstance(message, Delivery) and self.is_acknowledging:
                    send(Ack(message.key))
        except ConnectionClosed:
            pass

    def _bound(self, port: int) -> socket.socket:
        """Return a socket at a port, or at any free one for 0; nobody listens there yet."""
        made = socket.socket()
        weakref.finalize(self, made.close)  # also if nobody ends this class
        if os.name == "posix":  # else the port of a server that has ended is taken for a minute
            made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        made.bind(("127.0.0.1", port))
        return made
