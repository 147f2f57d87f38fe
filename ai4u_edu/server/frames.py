"""A short way for frames that somebody waits for.

Through ASGI every frame takes two more turns of the event loop than it needs, one for each
direction. Where a script and a world wait for each other, that is a third of their time. So a
socket may ask for its frames as they arrive, and may write its own at once. Everything else, the
handshake, pings, the close, remains uvicorn's and ASGI's.
"""

import asyncio
from asyncio.transports import BaseTransport
from collections.abc import Callable, MutableMapping
from typing import Any

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.exceptions import InvalidState
from websockets.http11 import Request

from ai4u_edu.server.refusal import refusal

EXTENSION = "ai4u_edu.frames"
"""Where an ASGI app finds it, in ``scope["extensions"]``."""

HANDSHAKE_TIMEOUT_S = 15.0
"""Time in which an app has to accept a socket. viser is waited for up to 10 s."""
CLOSE_TIMEOUT_S = 3.0
"""Time that the other side has to answer a close."""

Listener = Callable[[bytes], bool]
"""Gets a frame as it arrives; whether it took it. What it does not take goes on through ASGI."""


class FramesProtocol(WebSocketsSansIOProtocol):
    """uvicorn's protocol, with the short way in its extensions."""

    listener: Listener | None = None
    _handshake_timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport: BaseTransport) -> None:
        """Begin to wait for the handshake."""
        super().connection_made(transport)
        self.close_timeout = CLOSE_TIMEOUT_S
        self._handshake_timer = self.loop.call_later(HANDSHAKE_TIMEOUT_S, self._end_handshake)

    def connection_lost(self, exc: Exception | None) -> None:
        """End the timer too."""
        self._stop_handshake_timer()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Hear the next bytes; a head that websockets can't read is refused."""
        super().data_received(data)
        if not self.handshake_initiated and self.conn.handshake_exc is not None:
            # websockets ends here without a word, and uvicorn would wait for the request
            self.handshake_initiated = self.handshake_complete = self.close_sent = True
            why = "expected at most 128 headers of at most 8 KiB each, such as its cookies"
            self.transport.write(refusal(431, why))
            self.transport.close()

    def keepalive_timeout(self) -> None:
        """End the connection of who does not answer, also if it does not read either."""
        super().keepalive_timeout()
        self.loop.call_later(CLOSE_TIMEOUT_S, self.transport.abort)

    def on_task_complete(self, task: asyncio.Task[None]) -> None:
        """End the connection after its app, also if the other side does not read the rest."""
        super().on_task_complete(task)
        self.loop.call_later(2 * CLOSE_TIMEOUT_S, self.transport.abort)

    def handle_connect(self, event: Request) -> None:
        """Lets the app find the short way; refuses what websockets can't even refuse."""
        try:
            super().handle_connect(event)
        except UnicodeEncodeError:  # its answer would repeat a header that is no ASCII
            self.handshake_initiated = self.handshake_complete = self.close_sent = True
            head = (b"HTTP/1.1 400 Bad Request", b"Connection: close", b"Content-Length: 0")
            self.transport.write(b"\r\n".join((*head, b"", b"")))
            self.transport.close()
            return
        if self.handshake_initiated and not self.close_sent:
            extensions: MutableMapping[str, Any] = self.scope["extensions"]
            extensions[EXTENSION] = self

    def shutdown(self) -> None:
        """Ends the connection with the server, also where its farewell is on its way already."""
        try:
            super().shutdown()
        except InvalidState:  # uvicorn would say goodbye a second time, and not end at all
            self.transport.close()

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
        """Hands a frame to the listener first."""
        if self.listener is not None and self.curr_msg_data_type == "bytes" and self.queue.empty():
            frame = b"".join(self.frames)
            if not self.close_sent and self.listener(frame):
                self.frames = []
                return
        super().send_receive_event_to_app()

    def write(self, frame: bytes) -> bool:
        """Sends a frame at once; whether it could. It can't while earlier ones wait."""
        if not self.handshake_complete or self.close_sent or not self.writable.is_set():
            return False
        try:
            self.conn.send_binary(frame)
        except InvalidState:  # the other side has closed
            return False
        self.transport.write(b"".join(self.conn.data_to_send()))
        return True
