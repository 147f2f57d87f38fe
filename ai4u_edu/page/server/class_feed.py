"""State of a class for pages, as the input socket sends it."""

from typing import Any, Protocol

from starlette.datastructures import Headers

ROLE_HEADER = "x-ai4u-role"
"""Header of a class's requests: ``teacher`` or ``student``."""
SEAT_HEADER = "x-ai4u-seat"
"""Header of a class's requests: the number of the page's seat."""
MAX_SEAT_DIGITS = 9


class ClassFeed(Protocol):
    """The state of a class as a room knows it; any thread may read it."""

    @property
    def version(self) -> int:
        """A number that grows with every change."""

    def event(self, role: str, seat: int) -> dict[str, Any] | None:
        """Return the event for a page; None while there is none.

        Args:
            role: ``teacher`` or ``student``.
            seat: number of the page's seat; 0 if it is not known.
        """


class PageOfClass:
    """A page's part in a class: finds out what it has to be sent.

    Args:
        feed: of the class; None for a room without one.
        headers: of the page's request.
    """

    def __init__(self, feed: ClassFeed | None, headers: Headers) -> None:
        self._feed = feed
        self._role = headers.get(ROLE_HEADER, "student")
        digits = headers.get(SEAT_HEADER, "")[:MAX_SEAT_DIGITS]
        self.seat = int(digits) if digits.isascii() and digits.isdigit() else 0
        """Number of the page's seat; 0 if it is not known."""
        self._version = 0

    def news(self) -> dict[str, Any] | None:
        """Return the event if it has changed since the last call; else None.

        The times that are left in it are of now, so it is not compared with an earlier one.
        """
        feed = self._feed
        if feed is None or feed.version == self._version:
            return None
        self._version = feed.version
        return feed.event(self._role, self.seat)
