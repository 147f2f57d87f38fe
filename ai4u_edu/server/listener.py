"""A listening socket that refuses connections beyond a limit, and survives a lack of descriptors.

asyncio's selector loop calls :meth:`socket.socket.accept` of the socket that it is given, which is
where connections are refused: before anything else is made for them. On Windows the loop accepts
by other means; there only the time limits of :mod:`ai4u_edu.server.requests` apply.
"""

import errno
import logging
import os
import socket
from contextlib import suppress
from typing import Any

from ai4u_edu.base.log_limit import log_limited
from ai4u_edu.server.connections import MAX_EVICTING, Connections
from ai4u_edu.server.refusal import refusal

RETRY_AFTER_S = 5
MAX_REFUSED = 64
"""Connections that are refused in a row before the loop goes on to others."""
_EXHAUSTED = (errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM)
_logger = logging.getLogger(__name__)


class Listener(socket.socket):
    """A listening socket; belongs to the event loop that accepts from it.

    Args:
        listener: a socket that listens; it is taken over.
        connections: whose limits are kept.
    """

    def __init__(self, listener: socket.socket, connections: Connections) -> None:
        super().__init__(listener.family, listener.type, listener.proto, listener.detach())
        self.setblocking(False)
        self._connections = connections
        self._spare = _spare_descriptor()
        self._has_failed = False

    def accept(self) -> tuple[socket.socket, Any]:
        """Accept a connection that is within the limits; those beyond get 503 and are closed.

        Raises:
            BlockingIOError: none is there, or others should have their turn first.
            OSError: there are no descriptors, and none to spare.
        """
        for _ in range(MAX_REFUSED):
            if self._connections.evicting >= MAX_EVICTING:
                break  # those have to be gone first; the loop comes back at once
            accepted = self._accept_or_refuse()
            if accepted is not None:
                return accepted
        raise BlockingIOError(errno.EAGAIN, "others have their turn")

    def close(self) -> None:
        """Close it, and the descriptor that it kept."""
        self._give_spare()
        super().close()

    def _accept_or_refuse(self) -> tuple[socket.socket, Any] | None:
        try:
            connection, peer = super().accept()
        except OSError as error:
            if error.errno not in _EXHAUSTED:
                raise
            self._refuse_without_descriptors(error)
            return None
        self._has_failed = False
        if self._spare is None:
            self._spare = _spare_descriptor()
        reason = self._connections.admit(peer)
        if not reason:
            return _Accepted(connection, peer, self._connections), peer
        log_limited(_logger, logging.WARNING, "limit", "a connection is refused: %s", reason)
        with connection, suppress(OSError):
            connection.setblocking(False)
            with suppress(BlockingIOError):
                connection.recv(65536)  # what is unread when it closes would take the answer away
            connection.send(refusal(503, reason, retry_after=RETRY_AFTER_S))
        return None

    def _refuse_without_descriptors(self, error: OSError) -> None:
        """Close the connection that waits: left there, it would wake the loop without end."""
        log_limited(_logger, logging.ERROR, "descriptors", "a connection is refused: %s", error)
        if self._give_spare():
            with suppress(OSError):
                super().accept()[0].close()
            self._spare = _spare_descriptor()
            return
        if self._has_failed:  # asyncio asks on in the same turn, as often as its backlog is long
            self._has_failed = False
            raise BlockingIOError(errno.EAGAIN, "no descriptors")
        self._has_failed = True
        raise error  # asyncio comes back after a second

    def _give_spare(self) -> bool:
        spare, self._spare = self._spare, None
        if spare is None:
            return False
        os.close(spare)
        return True


class _Accepted(socket.socket):
    """A connection that counts until its socket is closed."""

    def __init__(self, connection: socket.socket, peer: Any, connections: Connections) -> None:
        super().__init__(connection.family, connection.type, connection.proto, connection.detach())
        self._peer, self._connections = peer, connections

    def close(self) -> None:
        super().close()
        self._connections.leave(self._peer)


def _spare_descriptor() -> int | None:
    try:
        return os.open(os.devnull, os.O_RDONLY | getattr(os, "O_CLOEXEC", 0))
    except OSError:
        return None
