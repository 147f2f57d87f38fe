"""A port that no other program gets while a test needs it."""

import socket
import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def reserved_port() -> Iterator[int]:
    """Holds a port, at which a connection is refused until a server of the test listens there."""
    with socket.socket() as holder:
        if sys.platform == "linux":  # elsewhere the server could not listen
            holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        holder.bind(("127.0.0.1", 0))
        port: int = holder.getsockname()[1]
        if sys.platform != "linux":
            holder.close()
        yield port
