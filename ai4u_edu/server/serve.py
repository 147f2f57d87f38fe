"""Serving until somebody ends it, and ending cleanly."""

import asyncio
import signal
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Self

import uvicorn
from starlette.types import ASGIApp

from ai4u_edu.base.log_limit import limited_logs
from ai4u_edu.server.address import listen, url_of
from ai4u_edu.server.connections import MAX_PER_ADDRESS, Connections, raise_descriptor_limit
from ai4u_edu.server.frames import FramesProtocol
from ai4u_edu.server.listener import Listener
from ai4u_edu.server.requests import RequestProtocol, ServerConfig

MAX_MESSAGE_BYTES = 2**20
"""Size of a WebSocket message to the server; a larger one is not read and ends the connection.

The largest one is a part of a file for viser, of 512 KiB.
"""
_GRACE = 1  # seconds that open connections have when the server ends
_UNFINISHED = 0.3  # seconds after which those that still wait for an answer are cut off


def serve(
    app: ASGIApp,
    host: str,
    port: int,
    on_ready: Callable[[str], object] | None = None,
    *,
    per_address: int = MAX_PER_ADDRESS,
) -> None:
    """Serves until Ctrl-C or SIGTERM, in this thread; returns when all is closed.

    Args:
        app: what answers.
        host: where to listen.
        port: 0 for a free one.
        on_ready: called with the page's address as soon as it answers.
        per_address: connections that one address may have, other than this machine's own.

    Raises:
        PortTakenError: another program listens there.
        AddressError: there is no listening there, for another reason.
    """
    listener = listen(host, port)
    raise_descriptor_limit()
    _Server(app, url_of(host, listener), on_ready, per_address).run([listener])


class ServerThread:
    """A server in a thread of its own, for tests and notebooks.

    ``with ServerThread(app) as server: ... server.url``
    """

    def __init__(
        self,
        app: ASGIApp,
        host: str = "127.0.0.1",
        port: int = 0,
        *,
        per_address: int = MAX_PER_ADDRESS,
    ) -> None:
        self._listener = listen(host, port)
        self.url = url_of(host, self._listener)
        """The page's address, with a slash at the end."""
        self._ready = threading.Event()
        self._server = _Server(app, self.url, lambda _: self._ready.set(), per_address)
        self._thread = threading.Thread(
            target=self._server.run, args=([self._listener],), name="server", daemon=True
        )

    def start(self) -> Self:
        """Begins to answer."""
        self._thread.start()
        while not self._ready.wait(0.1) and self._thread.is_alive():
            pass
        return self

    def stop(self) -> None:
        """Closes everything, and returns when that's done."""
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
    ) -> None:
        config = ServerConfig(
            app,
            loop="asyncio",
            http=RequestProtocol,
            ws=FramesProtocol,
            ws_max_size=MAX_MESSAGE_BYTES,
            ws_per_message_deflate=False,
            lifespan="off",
            log_config=None,
            log_level="warning",
            access_log=False,
            server_header=False,
            timeout_graceful_shutdown=_GRACE,
        )
        super().__init__(config)
        self._connections = config.connections = Connections(per_address=per_address)
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
        for connection in self.server_state.connections:
            # who takes nothing now takes no farewell either, and uvicorn would wait, and complain
            if connection.transport.get_write_buffer_size():
                connection.transport.abort()
            else:
                loop.call_later(_UNFINISHED, connection.transport.abort)
        await asyncio.sleep(0)
        await super().shutdown(sockets)

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        # uvicorn's own raises the signal once more at the end: a traceback where we want a return
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
