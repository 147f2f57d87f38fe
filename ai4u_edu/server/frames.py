"""A short way for frames that somebody waits for.

Through ASGI every frame takes two more turns of the event loop than it needs, one for each
direction. Where a script and a world wait for each other, that is a third of their time. So a
socket may ask for its frames as they arrive, and may write its own at once. A small frame that
comes alone is read here too, which takes a fifth of the time. Everything else, the handshake,
pings, what comes in pieces, the close, remains uvicorn's, websockets' and ASGI's.
"""

from collections.abc import Callable, MutableMapping
from typing import Any

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.exceptions import InvalidState
from websockets.http11 import Request
from websockets.protocol import State
from websockets.utils import apply_mask

from ai4u_edu.server.boundary import Boundary

CAP = 2**20
"""Bytes that no message needs, other than those to viser."""
EXTENSION = "ai4u_edu.frames"
"""Where an ASGI app finds it, in ``scope["extensions"]``."""

BINARY = 0x82
"""How a frame begins that is a whole message of bytes."""

Listener = Callable[[bytes], bool]
"""Gets a frame as it arrives; whether it took it. What it does not take goes on through ASGI."""


class FramesProtocol(WebSocketsSansIOProtocol):
    """uvicorn's protocol, with the short way in its extensions."""

    listener: Listener | None = None

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._boundary = Boundary()

    def cap(self, size: int) -> None:
        """From now on a message has at most so many bytes; a larger one is not even read.

        It ends the connection with 1009, without a word: so this is for what nobody means.
        """
        for name in ("max_message_size", "max_size"):  # the newer and the older websockets'
            setattr(self.conn, name, size)

    def handle_connect(self, event: Request) -> None:
        """Lets the app find the short way."""
        super().handle_connect(event)
        if self.handshake_initiated and not self.close_sent:
            extensions: MutableMapping[str, Any] = self.scope["extensions"]
            extensions[EXTENSION] = self

    def data_received(self, data: bytes) -> None:
        """Hands a frame that comes alone to the listener first."""
        if self.handshake_initiated:
            if self.listener is not None and self._boundary.is_reached:
                frame = self._alone(data)
                if frame is not None and self.listener(frame):
                    return
            self._boundary.feed(data)
        super().data_received(data)

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
        if len(frame) < 2**16 and self.conn.state is State.OPEN and not self.conn.extensions:
            self.transport.write(_head(len(frame)) + frame)
            return True
        try:
            self.conn.send_binary(frame)
        except InvalidState:  # the other side has closed
            return False
        self.transport.write(b"".join(self.conn.data_to_send()))
        return True

    def _alone(self, data: bytes) -> bytes | None:
        """The message, if what came is one small frame and nothing goes before it."""
        if len(data) < 6 or data[0] != BINARY or data[1] < 0x80 or data[1] == 0xFF:
            return None
        size, start = data[1] & 0x7F, 6
        if size == 126:
            size, start = int.from_bytes(data[2:4], "big"), 8
        is_next = not self.frames and self.queue.empty() and not self.close_sent
        if len(data) != start + size or not is_next or self.conn.state is not State.OPEN:
            return None
        return apply_mask(data[start:], data[start - 4 : start])


def _head(size: int) -> bytes:
    return bytes((BINARY, size)) if size < 126 else bytes((BINARY, 126)) + size.to_bytes(2, "big")
