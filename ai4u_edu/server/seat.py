"""Who drives an agent."""

import asyncio
from collections.abc import Iterable

from ai4u_edu.blocks import Keyboard


class Seat:
    """One seat before an agent's keyboard, and the pages that may want it.

    Whoever presses a key while it is free takes it; only that page's keys count then, until
    another one takes the seat over or the page is gone.

    >>> seat = Seat(Keyboard())
    >>> for page in (1, 2):
    ...     _ = seat.enter(page)
    >>> seat.hold(1, ["KeyW"]); seat.hold(2, ["KeyS"])
    >>> seat.driver, sorted(seat.keyboard.held())
    (1, ['KeyW'])
    >>> seat.take(2)
    >>> seat.driver, sorted(seat.keyboard.held())
    (2, [])
    """

    def __init__(self, keyboard: Keyboard) -> None:
        self.keyboard = keyboard
        self.driver: int | None = None
        self._changed: dict[int, asyncio.Event] = {}

    @property
    def pages(self) -> int:
        """How many pages look at the agent."""
        return len(self._changed)

    def enter(self, page: int) -> asyncio.Event:
        """A page has come; the event tells it that something about the seat has changed."""
        self._changed[page] = asyncio.Event()
        self._tell()
        return self._changed[page]

    def leave(self, page: int) -> None:
        """A page is gone; if it drove, its keys are let go and the seat is free."""
        del self._changed[page]
        if self.driver == page:
            self._hand_to(None)
        self._tell()

    def take(self, page: int) -> None:
        """A page wants the seat, and gets it."""
        if self.driver != page:
            self._hand_to(page)

    def hold(self, page: int, codes: Iterable[str]) -> None:
        """A page holds these keys now; they count if it drives, or may begin to."""
        codes = frozenset(codes)
        if self.driver is None and codes:
            self._hand_to(page)
        if self.driver == page:
            self.keyboard.hold(codes)

    def _hand_to(self, page: int | None) -> None:
        self.keyboard.release()
        self.driver = page
        self._tell()

    def _tell(self) -> None:
        for event in self._changed.values():
            event.set()
