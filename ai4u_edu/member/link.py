"""The link to a class, from the side of a world: its settings, time limits and interface."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal, Protocol

from ai4u_edu.wire.class_link import (
    Applied,
    Delivery,
    Drawing,
    FromClass,
    Poses,
    State,
    Work,
)

Receive = Callable[[FromClass], object]
"""Called with each message of the class, in a thread of the link."""


@dataclass(frozen=True)
class ClassLinkSettings:
    """Address of a class, and the secret that the class gave."""

    url: str
    """Address, such as ``http://teacher:8080/``."""
    secret: str = field(repr=False)
    kind: Literal["room", "notebook"] = "room"
    page: str = ""
    """Path of its page at a JupyterHub; see :attr:`~ai4u_edu.wire.class_link.State.page`."""


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


class ClassLink(Protocol):
    """A connection with a class; thread-safe. :class:`~ai4u_edu.member.client.LinkClient`."""

    @property
    def is_connected(self) -> bool:
        """True while the class has accepted the link."""

    def start(self) -> None:
        """Connect, in the background."""

    def stop(self, timeout_s: float = 2.0) -> None:
        """End the link; send what is pending if possible."""

    def send(self, message: Drawing | Poses | State | Work | Applied) -> None:
        """Send a present state, which replaces an earlier one of its kind."""

    def send_result(self, result: Delivery) -> None:
        """Deliver a result; it may wait for the disk."""
