"""A port for a server that ends and comes back."""

import socket
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def kept_port() -> Iterator[int]:
    """Keep a port that a server of ours can listen at again and again, and that no other gets.

    Linux lets a socket listen at a port at which another one is bound but does not listen, if both
    have SO_REUSEADDR; and it gives such a port to no program that asks for a free one.
    """
    with socket.socket() as kept:
        kept.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        kept.bind(("127.0.0.1", 0))
        port: int = kept.getsockname()[1]
        yield port
