"""One connection: what is to be said goes out in its order."""

import asyncio
from collections import deque
from collections.abc import Callable

from starlette.types import Message, Send

from ai4u_edu.wire import native

LONGEST_REASON = 120
"""Bytes of a close's reason; WebSocket has room for 123."""


class Line:
    """The way out to one script. Belongs to the server's loop, as all of its methods do.

    Args:
        send: the socket's.
        write: the short way, where there is one: sends a frame at once, or says that it can't.
    """

    def __init__(self, send: Send, write: Callable[[bytes], bool] | None = None) -> None:
        self._send = send
        self._write = write
        self._outbox: deque[Message] = deque()
        self._something = asyncio.Event()
        self.is_ending = False

    def say(self, frame: bytes) -> None:
        """Sends a frame, after all others."""
        if self.is_ending:
            return
        if self._outbox or self._write is None or not self._write(frame):
            self._outbox.append({"type": "websocket.send", "bytes": frame})
            self._something.set()

    def end(self, code: int, reason: str) -> None:
        """Closes the connection when all has been said."""
        if not self.is_ending:
            self.is_ending = True
            short = reason.encode()[:LONGEST_REASON].decode(errors="ignore")
            self._outbox.append({"type": "websocket.close", "code": code, "reason": short})
            self._something.set()

    def end_by(self, code: str, text: str) -> None:
        """Says what is wrong, and closes the connection."""
        self.say(native.encode(native.Problem(code, text, 0)))
        self.end(native.PROBLEMS[code], text)

    async def run(self) -> None:
        """Carries out what is to be said, until the connection is closed from here."""
        while True:
            await self._something.wait()
            self._something.clear()
            while self._outbox:
                message = self._outbox[0]
                await self._send(message)
                self._outbox.popleft()
                if message["type"] == "websocket.close":
                    return
