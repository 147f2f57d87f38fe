"""Waiting until a socket can be read from, or written to."""

import select
import sys
from socket import socket

if sys.platform == "win32":  # which has no poll

    def is_readable(sock: socket, within: float) -> bool:
        """Whether there is something to read, or the end, within so many seconds."""
        return bool(select.select([sock], [], [], max(within, 0.0))[0])

    def is_writable(sock: socket, within: float) -> bool:
        """Whether there is room for something, or the end, within so many seconds."""
        return bool(select.select([], [sock], [], max(within, 0.0))[1])

else:  # where select knows small file numbers only

    def is_readable(sock: socket, within: float) -> bool:
        """Whether there is something to read, or the end, within so many seconds."""
        return _polled(sock, select.POLLIN, within)

    def is_writable(sock: socket, within: float) -> bool:
        """Whether there is room for something, or the end, within so many seconds."""
        return _polled(sock, select.POLLOUT, within)

    def _polled(sock: socket, event: int, within: float) -> bool:
        poll = select.poll()
        poll.register(sock, event)
        return bool(poll.poll(max(within, 0.0) * 1000))
