"""Time limits of a link."""

from dataclasses import dataclass


@dataclass(frozen=True)
class LinkTimeouts:
    """Time limits (s) of a link.

    The defaults fit a school's network. A slow one, or a class on a busy machine, may need longer
    ones: a link that is given up too early is opened again, and sends its states once more.
    """

    open: float = 5.0
    """Time to open a connection."""
    send: float = 5.0
    """A connection that takes nothing for twice as long counts as lost."""
    ping: float = 5.0
    """Time between two pings."""
    pong: float = 10.0
    """Time for the answer to a ping; a network that is gone is noticed after ``ping`` and this."""
    welcome: float = 10.0
    """Time for the class's answer to the hello."""
    ack: float = 10.0
    """Time after which a result that was not acknowledged is sent again over the same
    connection."""
    close: float = 0.5
    """Time for the class's answer to a close."""
