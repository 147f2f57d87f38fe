"""Run the web server, in this thread or another one, and shut it down cleanly."""

import asyncio
import math
import signal
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Self

import uvicorn
from starlette.types import ASGIApp

from ai4u_edu.base.log_limit import limited_logs
from ai4u_edu.page.server.address import listen, url_of
from ai4u_edu.page.server.limits.connections import (
    MAX_PER_ADDRESS,
    Connections,
    raise_descriptor_limit,
)
from ai4u_edu.page.server.limits.frames import FramesProtocol
from ai4u_edu.page.server.limits.listener import Listener
from ai4u_edu.page.server.limits.request_target import PathsOnly
from ai4u_edu.page.server.limits.requests import RequestProtocol, ServerConfig
from ai4u_edu.page.server.limits.timeouts import DEFAULT_TIMEOUTS, Timeouts

if TYPE_CHECKING:  # uvicorn has the type for checkers alone
    from uvicorn.server import Protocols

MAX_MESSAGE_BYTES = 2**20
"""Usual size of a WebSocket message; a larger one is not read and ends the connection.

The largest one is a part of a file for viser, of 512 KiB.
"""


def serve(
    app: ASGIApp,
    host: str,
    port: int,
    on_ready: Callable[[str], object] | None = None,
    *,
    per_address: int = MAX_PER_ADDRESS,
    max_message_bytes: int = MAX_MESSAGE_BYTES,
    timeouts: Timeouts = DEFAULT_TIMEOUTS,
) -> None:
    """Serve an app in this thread until Ctrl-C or SIGTERM.

    Args:
        app: the ASGI app.
        host: address to listen at.
        port: 0 for a free one.
        on_ready: called with the page's address when the server accepts connections.
        per_address: limit of connections from one address, except from this machine.
        max_message_bytes: size of a WebSocket message to the server.
        timeouts: time limits of its connections.

    Raises:
        PortTakenError: another program listens there.
        AddressError: the server can't listen there, for another reason.
    """
    listener = listen(host, port)
    raise_descriptor_limit()
    server = _Server(
        app, url_of(host, listener), on_ready, per_address, timeouts, max_message_bytes
    )
    server.run([listener])


class ServerThread:
    """Server in a thread of its own, for tests and notebooks.

    ``with ServerThread(app) as server: ... server.url``

    Clients may connect as soon as it is made; they are answered when it is started.

    Args:
        app: the ASGI app.
        host: address to listen at.
        port: 0 for a free one.
        per_address: limit of connections from one address, except from this machine.
        timeouts: time limits of its connections.

    Raises:
        PortTakenError: another program listens there.
        AddressError: the server can't listen there, for another reason.
    """

    def __init__(
        self,
        app: ASGIApp,
        host: str = "127.0.0.1",
        port: int = 0,
        *,
        per_address: int = MAX_PER_ADDRESS,
        timeouts: Timeouts = DEFAULT_TIMEOUTS,
    ) -> None:
        self._listener = listen(host, port)
        self.url = url_of(host, self._listener)
        """The page's address, with a slash at the end."""
        self._ready = threading.Event()
        self._server = _Server(app, self.url, lambda _: self._ready.set(), per_address, timeouts)
        self._thread = threading.Thread(
            target=self._server.run, args=([self._listener],), name="server", daemon=True
        )

    def start(self) -> Self:
        """Start the thread, and return when the server accepts connections."""
        self._thread.start()
        while not self._ready.wait(0.1) and self._thread.is_alive():
            pass
        return self

    def stop(self) -> None:
        """Shut the server down, and return when its thread has ended."""
        self._server.should_exit = True
        self._thread.join()

    def __enter__(self) -> Self:
        return self.start()

    def __exit__(self, *_: object) -> None:
        self.stop()


class _Server(uvicorn.Server):
    def __init__(
        self,
        app: ASGIApp,
        url: str,
        on_ready: Callable[[str], object] | None,
        per_address: int,
        timeouts: Timeouts,
        max_message_bytes: int = MAX_MESSAGE_BYTES,
    ) -> None:
        config = ServerConfig(
            PathsOnly(app),
            loop="asyncio",
            http=RequestProtocol,
            ws=FramesProtocol,
            ws_max_size=max_message_bytes,
            ws_per_message_deflate=False,
            ws_ping_interval=timeouts.ping,
            ws_ping_timeout=timeouts.ping,
            lifespan="off",
            log_config=None,
            log_level="warning",
            access_log=False,
            server_header=False,
            timeout_keep_alive=math.ceil(timeouts.request),  # RequestProtocol has its own
            timeout_graceful_shutdown=math.ceil(timeouts.shutdown),
        )
        super().__init__(config)
        self._connections = config.connections = Connections(per_address=per_address)
        self._timeouts = config.timeouts = timeouts
        self._on_ready = on_ready
        self._url = url

    def run(self, sockets: list[socket.socket] | None = None) -> None:
        with limited_logs():
            super().run(sockets)

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup([Listener(each, self._connections) for each in sockets or ()])
        if self._on_ready is not None:
            self._on_ready(self._url)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        loop = asyncio.get_running_loop()
        self._connections.is_closing = True
        for connection in self.server_state.connections:
            # a connection that does not read can't be closed cleanly; uvicorn would wait and log
            if connection.transport.get_write_buffer_size():
                connection.transport.abort()
            else:
                loop.call_later(self._timeouts.abort, self._abort, connection)
        await asyncio.sleep(0)  # asyncio makes transports of what it accepted
        await super().shutdown(sockets)

    def _abort(self, connection: "Protocols") -> None:
        # a transport that closed after it sent its last bytes raises an error in abort()
        if connection in self.server_state.connections:
            connection.transport.abort()

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        # uvicorn's own version raises the signal again at the end; here the command returns
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        signals = (signal.SIGINT, signal.SIGTERM)
        before = {each: signal.signal(each, self.handle_exit) for each in signals}
        try:
            yield
        finally:
            for each, handler in before.items():
                signal.signal(each, handler)
