"""The queue of frames to one script's connection."""

import asyncio
from collections import deque
from collections.abc import Callable

from starlette.types import Message, Send

from ai4u_edu.locale import catalogue
from ai4u_edu.wire import native
from ai4u_edu.wire.json_form import JsonForm
from ai4u_edu.wire.validation import WireError

MAX_REASON_BYTES = 120
"""Longest reason of a close; the WebSocket protocol has room for 123 bytes."""


class Outbox:
    """A queue of frames to one script, sent in order. Only the server's event loop calls it.

    Args:
        send: the ASGI connection's.
        write: sends a frame at once, without the queue, and returns False if it can't.
        form: of the messages, if the script speaks JSON.
    """

    def __init__(
        self,
        send: Send,
        write: Callable[[bytes], bool] | None = None,
        form: JsonForm | None = None,
    ) -> None:
        self._send = send
        self._write = write
        self._form = form
        self._queue: deque[Message] = deque()
        self._is_not_empty = asyncio.Event()
        self._catalogue = catalogue()
        self.is_closing = False

    def send(self, frame: bytes) -> None:
        """Send a frame after all others; discard it if the connection is being closed."""
        if self.is_closing:
            return
        if self._form is not None:
            self._send_text(self._form, frame)
        elif self._queue or self._write is None or not self._write(frame):
            self._put({"type": "websocket.send", "bytes": frame})

    def send_problem(self, problem: native.Problem) -> None:
        """Send a problem in the script's language: that of the request for its connection."""
        text = self._catalogue.translate(problem.text)
        self.send(native.encode(native.Problem(problem.code, text, problem.seq)))

    def send_bye(self, reason: str) -> None:
        """Send the end of the session, with its reason in the script's language."""
        self.send(native.encode(native.Bye(self._catalogue.translate(reason))))

    def close(self, code: int, reason: str) -> None:
        """Close the connection when all frames have been sent."""
        if not self.is_closing:
            self.is_closing = True
            short = (
                self._catalogue.translate(reason)
                .encode()[:MAX_REASON_BYTES]
                .decode(errors="ignore")
            )
            self._put({"type": "websocket.close", "code": code, "reason": short})

    def close_with_problem(self, code: str, text: str) -> None:
        """Send a problem, and close the connection with its code."""
        self.send_problem(native.Problem(code, text, 0))
        self.close(native.PROBLEMS[code], text)

    async def run(self) -> None:
        """Send what is in the queue, until the close has been sent."""
        while True:
            await self._is_not_empty.wait()
            self._is_not_empty.clear()
            while self._queue:
                message = self._queue[0]
                await self._send(message)
                self._queue.popleft()
                if message["type"] == "websocket.close":
                    return

    def _send_text(self, form: JsonForm, frame: bytes) -> None:
        try:
            self._put({"type": "websocket.send", "text": form.text_of(frame)})
        except WireError as error:
            self.close_with_problem("ended", str(error))

    def _put(self, message: Message) -> None:
        self._queue.append(message)
        self._is_not_empty.set()
