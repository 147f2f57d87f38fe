"""A UDP socket that talks to one address."""

import contextlib
import select
import socket
import sys
from collections.abc import Callable

RECEIVE_BUFFER_BYTES = 2**16
"""More than the largest datagram."""
MAX_DRAINED = 1000
"""Datagrams that one drain discards at most: somebody may send faster than we read."""
LINUX_IP_RECVERR = 11
"""Socket option that reports unreachable ports at once; Python has no name for it."""


class UdpSocket:
    """A UDP socket that talks to one address, and never blocks by itself.

    It is not connected, so that datagrams from others can be counted. Its timeout never changes,
    since setting one is a system call.

    Args:
        peer: the address.
    """

    def __init__(self, peer: tuple[str, int]) -> None:
        self.peer = peer
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        if sys.platform == "linux":
            # without it, only a timeout shows that nobody listens at a port
            self._socket.setsockopt(socket.IPPROTO_IP, LINUX_IP_RECVERR, 1)
        self.wait_readable = _poller(self._socket)
        """Waits at most the given milliseconds; returns something true if there is a datagram or an
        error to receive."""
        self.close = self._socket.close

    def send(self, data: bytes) -> None:
        """Send a datagram to the address.

        Raises:
            OSError: this datagram, or an earlier one, can't reach it.
        """
        try:
            self._socket.sendto(data, self.peer)
        except OSError:
            self._clear_errors()
            raise

    def receive(self) -> tuple[bytes, bool]:
        """Return the next datagram, and whether it is from the address.

        Raises:
            BlockingIOError: there is none.
            OSError: an earlier datagram reached nobody.
        """
        try:
            data, sender = self._socket.recvfrom(RECEIVE_BUFFER_BYTES)
        except BlockingIOError:
            raise
        except OSError:
            self._clear_errors()
            raise
        return data, sender == self.peer

    def drain(self) -> int:
        """Discard the datagrams that have arrived, and return their number."""
        count = 0
        for _ in range(MAX_DRAINED):
            if not self.wait_readable(0):
                break
            with contextlib.suppress(OSError):  # a datagram reached nobody; the next one will tell
                self.receive()
                count += 1
        return count

    def _clear_errors(self) -> None:
        """Empty Linux's error queue: while an error is in it, polling returns at once."""
        if sys.platform == "linux":
            with contextlib.suppress(OSError):
                while True:
                    self._socket.recvmsg(0, 0, socket.MSG_ERRQUEUE)


def _poller(udp: socket.socket) -> Callable[[float], object]:
    if hasattr(select, "poll"):
        poll = select.poll()
        poll.register(udp, select.POLLIN)
        return poll.poll
    return lambda milliseconds: select.select([udp], [], [], milliseconds / 1000)[0]
