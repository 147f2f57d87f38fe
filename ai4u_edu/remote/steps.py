"""What a dialogue asks of the line that carries it.

A dialogue opens no connection and waits for nothing. It is a generator that yields these steps, and
is sent what came of them; a plain line and an asynchronous one carry them out.
"""

from collections.abc import Generator
from typing import Any, NamedTuple, TypeVar

T = TypeVar("T")


class Open(NamedTuple):
    """Open a connection (anew); an error ends in :class:`LineLost`."""

    timeout: float
    """Seconds."""


class Send(NamedTuple):
    """Send a frame."""

    frame: bytes


class Receive(NamedTuple):
    """Wait for a frame; None if none comes in time."""

    timeout: float
    """Seconds."""


class Pause(NamedTuple):
    """Do nothing for a while."""

    seconds: float


class Close(NamedTuple):
    """Close the connection; does not fail."""


Step = Open | Send | Receive | Pause | Close
Flow = Generator[Step, Any, T]


class LineLost(Exception):  # noqa: N818 - it never leaves this package
    """There is no connection, or none any more.

    Attributes:
        code: of the WebSocket's close; 0 if it had none.
        for_good: whether nobody is there, or lets nobody in: trying again hardly helps.
    """

    def __init__(self, reason: str, code: int = 0, *, for_good: bool = False) -> None:
        super().__init__(reason)
        self.code = code
        self.for_good = for_good
