"""UDP to one address, and waiting for what comes back."""

import contextlib
import select
import socket
import sys
from collections.abc import Callable

LARGEST = 2**16
"""Bytes of the largest datagram, and more."""
MOST_DRAINED = 1000
"""Datagrams thrown away at one go, at most: somebody may send faster than we read."""


IP_RECVERR = 11
"""Linux's option by which a socket is told that nobody listens; Python has no name for it."""


class Datagrams:
    """A socket that speaks to one address, and never waits by itself.

    It is not connected, so that what others send can be counted. Its timeout never changes: setting
    one is a call to the system each time.

    Args:
        peer: the address.
    """

    def __init__(self, peer: tuple[str, int]) -> None:
        self.peer = peer
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        if sys.platform == "linux":
            # else it takes the timeout to find out that nobody listens at a port
            self._socket.setsockopt(socket.IPPROTO_IP, IP_RECVERR, 1)
        self.is_there = _watch(self._socket)
        """Whether there is something to take, an error too, within so many milliseconds."""
        self.close = self._socket.close

    def send(self, data: bytes) -> None:
        """Sends to the address.

        Raises:
            OSError: this one, or one that was sent before, can't reach it.
        """
        try:
            self._socket.sendto(data, self.peer)
        except OSError:
            self._forget_errors()
            raise

    def take(self) -> tuple[bytes, bool]:
        """The next datagram, and whether it is from the address.

        Raises:
            BlockingIOError: there is none.
            OSError: what was sent before reached nobody.
        """
        try:
            data, sender = self._socket.recvfrom(LARGEST)
        except BlockingIOError:
            raise
        except OSError:
            self._forget_errors()
            raise
        return data, sender == self.peer

    def drain(self) -> int:
        """Throws away what has come; how many there were."""
        count = 0
        for _ in range(MOST_DRAINED):
            if not self.is_there(0):
                break
            with contextlib.suppress(OSError):  # some datagram reached nobody; the next one tells
                self.take()
                count += 1
        return count

    def _forget_errors(self) -> None:
        """Empties Linux's queue of them: as long as one is in it, no waiting waits."""
        if sys.platform == "linux":
            with contextlib.suppress(OSError):
                while True:
                    self._socket.recvmsg(0, 0, socket.MSG_ERRQUEUE)


def _watch(udp: socket.socket) -> Callable[[float], object]:
    if hasattr(select, "poll"):
        poll = select.poll()
        poll.register(udp, select.POLLIN)
        return poll.poll
    return lambda milliseconds: select.select([udp], [], [], milliseconds / 1000)[0]
