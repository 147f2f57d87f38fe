"""The direct way to a page, where the viewer and the server are one process.

A picture goes from the viewer to viser's socket on this machine, from there to the server, and on
to the page: three calls of the system for each page, and at each Python lets other threads go on
first. So for each page the server leaves a direct way here, and tells viser under which ticket; the
viewer takes it, and writes into the page's own socket.

What was sent the long way has to arrive first. So the viewer sends the ticket after it, and waits
until the server, to which it comes last, opens the direct way.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from secrets import token_hex
from typing import Protocol

from ai4u_edu.base.loop_queue import Post

HEADER = "X-AI4U-Edu-Direct"
"""By this viser is told a page's ticket."""

_left: dict[str, "Direct"] = {}


class Socket(Protocol):
    """A page's WebSocket, as the server has it."""

    def is_clear(self) -> bool:
        """Whether all that was written has gone out; may be asked by any thread."""

    def write_framed(self, frame: bytes) -> None:
        """Writes a WebSocket frame as it is; nothing if the socket is closed. In its loop."""


class Direct:
    """The direct way to one page. One thread tells, the server's loop writes.

    Args:
        socket: the page's.
        post: into the server's loop.
    """

    def __init__(self, socket: Socket, post: Post) -> None:
        self.ticket = token_hex(16)
        self._socket = socket
        self._post = post
        self._is_open = False
        self._told = self._written = 0

    def open(self) -> None:
        """All that went the long way has arrived; said by the server."""
        self._is_open = True

    def is_clear(self) -> bool:
        """Whether it is open, and the page has taken all that it was told this way."""
        return self._is_open and self._told == self._written and self._socket.is_clear()

    def tell(self, frame: bytes) -> None:
        """Sends a frame as :func:`framed` makes it.

        Nothing heaps up if it is asked first whether the way is clear.
        """
        self._told += 1
        try:
            self._post.give(self._write, frame)
        except RuntimeError:  # the server has ended, and the page is told by nobody any more
            self._written = self._told

    def _write(self, frame: bytes) -> None:
        self._written += 1
        self._socket.write_framed(frame)


@contextmanager
def left(socket: Socket, post: Post) -> Iterator[Direct]:
    """Leaves the direct way to a page, for as long as the page is there."""
    way = Direct(socket, post)
    _left[way.ticket] = way
    try:
        yield way
    finally:
        del _left[way.ticket]


def taken(ticket: str) -> Direct | None:
    """The way that was left under a ticket; None if there is none in this process."""
    return _left.get(ticket)


def framed(message: bytes) -> bytes:
    """A message as a server's WebSocket frame.

    >>> framed(b"hello").hex(" ")
    '82 05 68 65 6c 6c 6f'
    >>> framed(bytes(300))[:4].hex(" "), framed(bytes(70_000))[:10].hex(" ")
    ('82 7e 01 2c', '82 7f 00 00 00 00 00 01 11 70')
    """
    size = len(message)
    if size < 126:
        head = bytes((0x82, size))
    elif size < 2**16:
        head = b"\x82\x7e" + size.to_bytes(2)
    else:
        head = b"\x82\x7f" + size.to_bytes(8)
    return head + message
