"""The steps of a dialogue: what it asks a connection to do.

A :class:`~ai4u_edu.remote.dialogue.Dialogue` does no input or output itself. Its methods are
generators: they yield these steps, and a connection, synchronous or asynchronous, carries them out
and sends back the result. So both kinds of connections share one dialogue.
"""

from collections.abc import Generator
from typing import Any, NamedTuple, TypeVar

T = TypeVar("T")


class Open(NamedTuple):
    """Open a new connection; raises :class:`ConnectionLostError` if that fails."""

    timeout: float
    """Seconds."""


class Send(NamedTuple):
    """Send a frame."""

    frame: bytes


class Receive(NamedTuple):
    """Wait for a frame; the result is None on a timeout."""

    timeout: float
    """Seconds."""


class Delay(NamedTuple):
    """Sleep."""

    seconds: float


class Close(NamedTuple):
    """Close the connection; never fails."""


class Note(NamedTuple):
    """Tell the person at this machine something, such as that the script waits."""

    text: str


Step = Open | Send | Receive | Delay | Close | Note
Flow = Generator[Step, Any, T]


class ConnectionLostError(Exception):
    """There is no connection, or it was lost; never raised to users of this package.

    Attributes:
        code: of the WebSocket's close; 0 if it had none.
        is_permanent: True if there is no such host, or the handshake was refused; a retry is
            unlikely to help.
    """

    def __init__(self, reason: str, code: int = 0, *, is_permanent: bool = False) -> None:
        super().__init__(reason)
        self.code = code
        self.is_permanent = is_permanent
