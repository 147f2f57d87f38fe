"""A class that knows one secret, remembers what it got, and breaks off when a test says so."""

import threading
from typing import Self

from websockets.exceptions import ConnectionClosed
from websockets.sync.server import Server, ServerConnection, serve
from websockets.typing import Subprotocol

from ai4u_edu.wire.class_link import (
    MAX_FRAME_BYTES,
    SUBPROTOCOL,
    VERSION,
    Ack,
    EpisodeResult,
    ExerciseResult,
    FromClass,
    FromRoom,
    Hello,
    Network,
    Problem,
    State,
    Welcome,
    decode_from_room,
    encode_from_class,
)

SECRET = "seat-token"


class TinyClass:
    """A server of links at one port, also after a restart."""

    def __init__(self) -> None:
        self.got: list[FromRoom] = []
        """All messages except hellos, of all connections."""
        self.hellos: list[Hello] = []
        self.is_acknowledging = True
        self.is_welcoming = True
        self.refusal = ""
        """Reason with which every connection is closed."""
        self.port = 0
        self._connections: list[ServerConnection] = []
        self._server: Server | None = None
        self._thread: threading.Thread | None = None

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}/"

    @property
    def results(self) -> list[str]:
        """Keys of the results, each time that they came."""
        return [each.key for each in self.got if isinstance(each, EpisodeResult | ExerciseResult)]

    @property
    def states(self) -> list[State]:
        return [each for each in self.got if isinstance(each, State)]

    def of(self, kind: type) -> list[FromRoom]:
        return [each for each in self.got if isinstance(each, kind)]

    def start(self) -> None:
        self._server = serve(
            self._talk,
            "127.0.0.1",
            self.port,
            subprotocols=[Subprotocol(SUBPROTOCOL)],
            max_size=MAX_FRAME_BYTES,
        )
        self.port = self._server.socket.getsockname()[1]
        self._thread = threading.Thread(target=self._server.serve_forever)
        self._thread.start()

    def stop(self) -> None:
        """End the server; its port is free for :meth:`start`."""
        if self._server is not None and self._thread is not None:
            self._server.shutdown()
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
            assert isinstance(hello, Hello)
            self.hellos.append(hello)
            if self.refusal:
                connection.close(1008, self.refusal)
                return
            if hello.secret != SECRET:
                send(Problem("secret", "This seat is not known. Join again."))
                return
            if self.is_welcoming:
                send(Welcome(VERSION, "Red Fox", "#d55e00"))
            self._connections.append(connection)
            while True:
                message = decode_from_room(connection.recv(decode=False))
                self.got.append(message)
                if (
                    isinstance(message, EpisodeResult | ExerciseResult | Network)
                    and self.is_acknowledging
                ):
                    send(Ack(message.key))
        except ConnectionClosed:
            pass
