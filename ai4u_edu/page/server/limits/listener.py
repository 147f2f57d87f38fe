"""A listening socket that refuses connections beyond a limit, and survives a lack of descriptors.

asyncio's selector loop calls :meth:`socket.socket.accept` of the socket that it is given.
Connections are refused there, before anything is allocated for them. On Windows the loop accepts by
other means; there only the timeouts of :mod:`ai4u_edu.page.server.limits.requests` apply.
"""

import errno
import logging
import os
import socket
from contextlib import suppress
from typing import Any

from ai4u_edu.base.log_limit import log_limited
from ai4u_edu.page.server.limits.connections import Connections
from ai4u_edu.page.server.limits.plain_response import plain_response

RETRY_AFTER_S = 5
MAX_REFUSED = 64
"""Connections that are refused in a row before other tasks of the loop have their turn."""
_EXHAUSTED = (errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM)
_logger = logging.getLogger(__name__)


class Listener(socket.socket):
    """A listening socket; belongs to the event loop that accepts from it.

    Args:
        listener: a listening socket, whose descriptor is taken over.
        connections: the limits.
    """

    def __init__(self, listener: socket.socket, connections: Connections) -> None:
        super().__init__(listener.family, listener.type, listener.proto, listener.detach())
        self.setblocking(False)
        self._connections = connections
        self._spare = _spare_descriptor()
        self._has_failed = False

    def accept(self) -> tuple[socket.socket, Any]:
        """Accept a connection within the limits; answer those beyond with 503 and close them.

        Raises:
            BlockingIOError: there is none, the server shuts down, or other tasks should have their
                turn first.
            OSError: there are no file descriptors, and none to spare.
        """
        if self._connections.is_closing:
            # Python 3.11 never closes what comes to a server that is closed
            raise BlockingIOError(errno.EAGAIN, "the server ends")
        for _ in range(MAX_REFUSED):
            if self._connections.are_waiting():
                break  # the loop calls again at once
            accepted = self._accept_or_refuse()
            if accepted is not None:
                return accepted
        raise BlockingIOError(errno.EAGAIN, "others have their turn")

    def close(self) -> None:
        """Close the socket and its spare descriptor."""
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
        reason = self._connections.admit(connection.fileno(), peer)
        if not reason:
            return _Accepted(connection, self._connections), peer
        log_limited(_logger, logging.WARNING, "limit", "a connection is refused: %s", reason)
        with connection, suppress(OSError):
            connection.setblocking(False)
            with suppress(BlockingIOError):
                connection.recv(65536)  # closing with unread bytes would reset it
            connection.send(plain_response(503, reason, retry_after=RETRY_AFTER_S))
        return None

    def _refuse_without_descriptors(self, error: OSError) -> None:
        """Close the next connection: left in the backlog, it would wake the loop without end."""
        log_limited(_logger, logging.ERROR, "descriptors", "a connection is refused: %s", error)
        if self._give_spare():
            with suppress(OSError):
                super().accept()[0].close()
            self._spare = _spare_descriptor()
            return
        if self._has_failed:  # asyncio calls again in the same turn, once for each of its backlog
            self._has_failed = False
            raise BlockingIOError(errno.EAGAIN, "no descriptors")
        self._has_failed = True
        raise error  # asyncio calls again after a second

    def _give_spare(self) -> bool:
        spare, self._spare = self._spare, None
        if spare is None:
            return False
        os.close(spare)
        return True


class _Accepted(socket.socket):
    """Accepted connection, which counts until its socket is closed."""

    def __init__(self, connection: socket.socket, connections: Connections) -> None:
        super().__init__(connection.family, connection.type, connection.proto, connection.detach())
        self._connections = connections

    def close(self) -> None:
        descriptor = self.fileno()
        super().close()
        self._connections.leave(descriptor)


def _spare_descriptor() -> int | None:
    try:
        return os.open(os.devnull, os.O_RDONLY | getattr(os, "O_CLOEXEC", 0))
    except OSError:
        return None
