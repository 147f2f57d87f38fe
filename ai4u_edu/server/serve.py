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

from ai4u_edu.server.address import listen, url_of
from ai4u_edu.server.frames import FramesProtocol

_LARGEST = 64 * 2**20  # bytes of a WebSocket message; viser itself takes 50 MB
_GRACE = 1  # seconds that open connections have when the server ends


def serve(
    app: ASGIApp, host: str, port: int, on_ready: Callable[[str], object] | None = None
) -> None:
    """Serves until Ctrl-C or SIGTERM, in this thread; returns when all is closed.

    Args:
        app: what answers.
        host: where to listen.
        port: 0 for a free one.
        on_ready: called with the page's address as soon as it answers.

    Raises:
        PortTakenError: another program listens there.
        AddressError: there is no listening there, for another reason.
    """
    listener = listen(host, port)
    _Server(app, url_of(host, listener), on_ready).run([listener])


class ServerThread:
    """A server in a thread of its own, for tests and notebooks.

    ``with ServerThread(app) as server: ... server.url``
    """

    def __init__(self, app: ASGIApp, host: str = "127.0.0.1", port: int = 0) -> None:
        self._listener = listen(host, port)
        self.url = url_of(host, self._listener)
        """The page's address, with a slash at the end."""
        self._ready = threading.Event()
        self._server = _Server(app, self.url, lambda _: self._ready.set())
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
    def __init__(self, app: ASGIApp, url: str, on_ready: Callable[[str], object] | None) -> None:
        super().__init__(
            uvicorn.Config(
                app,
                loop="ai4u_edu.server.eager:new_loop",
                ws=FramesProtocol,
                ws_max_size=_LARGEST,
                ws_per_message_deflate=False,
                lifespan="off",
                log_config=None,
                log_level="warning",
                access_log=False,
                server_header=False,
                timeout_graceful_shutdown=_GRACE,
            )
        )
        self._on_ready = on_ready
        self._url = url

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self._on_ready is not None:
            self._on_ready(self._url)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        for connection in self.server_state.connections:
            # who takes nothing now takes no farewell either, and uvicorn would wait, and complain
            if connection.transport.get_write_buffer_size():
                connection.transport.abort()
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
