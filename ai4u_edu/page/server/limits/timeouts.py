"""Time limits of a server's connections, and of a room's answers."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Timeouts:
    """Time limits (s) of a server's connections, and of a room's answers.

    The defaults fit pages and scripts on a network that works. A server that shares its processor
    with much other work, or whose pages are far away, may need longer ones.
    """

    request: float = 5.0
    """A request's head, since the connection's or its own first byte; and its body."""
    linger: float = 1.0
    """Time that the other side has to read why its connection is closed."""
    stall: float = 20.0
    """Time without progress after which an answer that nobody reads is aborted."""
    handshake: float = 15.0
    """Time in which an app has to accept a WebSocket; longer than ``viser``."""
    ping: float = 10.0
    """Time between two pings of a WebSocket, and time for the answer. A page whose network is gone
    keeps others from driving for up to twice as long."""
    close: float = 3.0
    """Time in which the other side has to answer a WebSocket's close."""
    abort: float = 0.3
    """Time after which requests that are still waiting for an answer are aborted at shutdown."""
    viser: float = 10.0
    """Time for viser to accept a page's connection."""
    open_scene: float = 10.0
    """Time for the world to open a scene; a block that does not return keeps it from doing so."""
    shutdown: float = 1.0
    """Time that apps have to return at shutdown, rounded up to whole seconds; then they are
    cancelled."""


DEFAULT_TIMEOUTS = Timeouts()
