"""uvicorn's WebSocket protocol with timeouts, and with a callback for frames.

The callback is for scripts in lockstep, where world and script wait for each other: through ASGI a
frame takes two more turns of the event loop, and a decision 7 to 14% more of the server's time
(``python -m tests.benchmarks.remote_native``). Handshake, pings and close remain uvicorn's and
ASGI's. See ``docs/adr/0003-limits-of-connections.md``.
"""

import asyncio
from asyncio.transports import BaseTransport
from collections.abc import Callable, MutableMapping
from contextlib import suppress
from typing import Any, cast

from starlette.websockets import WebSocketDisconnect
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.exceptions import InvalidState
from websockets.http11 import Request

from ai4u_edu.page.server.limits.plain_response import plain_response
from ai4u_edu.page.server.limits.requests import ServerConfig
from ai4u_edu.page.server.limits.timeouts import Timeouts

EXTENSION = "ai4u_edu.frames"
"""Key of the protocol in an ASGI scope's ``extensions``."""

INVALID_DATA = 1007
"""Code of a close: a text was not UTF-8."""

Listener = Callable[[bytes], bool]
"""Callback that gets each binary frame; one for which it returns False goes through ASGI."""


class FramesProtocol(WebSocketsSansIOProtocol):
    """uvicorn's protocol with timeouts; ASGI apps find it in their scope under EXTENSION."""

    listener: Listener | None = None
    _handshake_timer: asyncio.TimerHandle | None = None
    _abort_timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport: BaseTransport) -> None:
        """Start the handshake's timeout."""
        super().connection_made(transport)
        self.close_timeout = self._timeouts.close
        self._handshake_timer = self.loop.call_later(self._timeouts.handshake, self._end_handshake)

    def connection_lost(self, exc: Exception | None) -> None:
        """Cancel the timeouts."""
        self._stop_handshake_timer()
        if self._abort_timer is not None:
            self._abort_timer.cancel()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Parse the next bytes; refuse a request whose headers websockets can't parse."""
        super().data_received(data)
        if not self.handshake_initiated and self.conn.handshake_exc is not None:
            # websockets stops here without an answer, and uvicorn would go on waiting
            self.handshake_initiated = self.handshake_complete = self.close_sent = True
            why = "expected at most 128 headers of at most 8 KiB each, such as its cookies"
            self.transport.write(plain_response(431, why))
            self.transport.close()

    def handle_parser_exception(self) -> None:
        """Close a connection that sends what is no frame, or too large a one."""
        super().handle_parser_exception()
        # An app may send before it hears of this. uvicorn raises a RuntimeError then, as if the
        # app itself had closed; now it raises the error that ASGI has for a page that has left.
        self.disconnected = True

    def keepalive_timeout(self) -> None:
        """Close a connection that answers no pings; abort it if it does not read either."""
        super().keepalive_timeout()
        self.disconnected = True  # see handle_parser_exception
        self._abort_after(self._timeouts.close)

    def on_task_complete(self, task: asyncio.Task[None]) -> None:
        """Abort the connection after its app has ended if the other side does not read the rest."""
        super().on_task_complete(task)
        connections = cast(ServerConfig, self.config).connections
        if connections is not None:  # a new connection need not wait for the other side's close
            connections.set_idle(self.transport, True)
        self._abort_after(2 * self._timeouts.close)

    async def run_asgi(self) -> None:
        """Call the app, for which a page that has left is no error."""
        app = self.app

        async def call(scope: Any, receive: Any, send: Any) -> None:
            with suppress(WebSocketDisconnect):
                await app(scope, receive, send)
            if self.transport.is_closing():  # the page left during the handshake
                self.handshake_complete = True

        self.app = call
        await super().run_asgi()

    async def send(self, message: Any) -> None:
        """Send an app's message; note a page that left before it was accepted.

        uvicorn drops that ``accept``, and would take the app's next message for one too early.
        """
        await super().send(message)
        if message["type"] == "websocket.accept" and not self.handshake_complete:
            self.disconnected = True

    def handle_connect(self, event: Request) -> None:
        """Add the extension to the scope; refuse a request that websockets fails to refuse."""
        try:
            super().handle_connect(event)
        except UnicodeEncodeError:  # its answer would repeat a header that is not ASCII
            self.handshake_initiated = self.handshake_complete = self.close_sent = True
            head = (b"HTTP/1.1 400 Bad Request", b"Connection: close", b"Content-Length: 0")
            self.transport.write(b"\r\n".join((*head, b"", b"")))
            self.transport.close()
            return
        if self.handshake_initiated and not self.close_sent:
            extensions: MutableMapping[str, Any] = self.scope["extensions"]
            extensions[EXTENSION] = self

    def shutdown(self) -> None:
        """Close the connection with the server, also if its close has been sent already."""
        try:
            super().shutdown()
        except InvalidState:  # uvicorn would send a second close, and not end
            self.transport.close()

    @property
    def _timeouts(self) -> Timeouts:
        return cast(ServerConfig, self.config).timeouts

    def _abort_after(self, seconds: float) -> None:
        # a transport that closed after it sent its last bytes raises an error in abort()
        if self in self.connections:
            if self._abort_timer is not None:
                self._abort_timer.cancel()
            self._abort_timer = self.loop.call_later(seconds, self.transport.abort)

    def _end_handshake(self) -> None:
        self._handshake_timer = None
        if not self.handshake_complete:
            self.send_500_response()
            self.transport.close()

    def _stop_handshake_timer(self) -> None:
        if self._handshake_timer is not None:
            self._handshake_timer.cancel()
            self._handshake_timer = None

    def send_receive_event_to_app(self) -> None:
        """Pass a frame to the listener first."""
        if self.listener is not None and self.curr_msg_data_type == "bytes" and self.queue.empty():
            frame = b"".join(self.frames)
            if not self.close_sent and self.listener(frame):
                self.frames = []
                return
        if self.curr_msg_data_type == "text" and not _is_utf8(b"".join(self.frames)):
            self.frames = []
            if not self.close_sent:  # uvicorn would log a traceback besides
                self.conn.send_close(INVALID_DATA)
                self.handle_parser_exception()
            return
        super().send_receive_event_to_app()

    def write(self, frame: bytes) -> bool:
        """Send a frame at once; return False if others wait or the socket is closed."""
        if not self.handshake_complete or self.close_sent or not self.writable.is_set():
            return False
        try:
            self.conn.send_binary(frame)
        except InvalidState:  # the other side has closed
            return False
        self.transport.write(b"".join(self.conn.data_to_send()))
        return True


def _is_utf8(text: bytes) -> bool:
    try:
        text.decode()
    except UnicodeDecodeError:
        return False
    return True
