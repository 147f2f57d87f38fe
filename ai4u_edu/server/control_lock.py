"""Who drives an agent."""

import asyncio
from collections.abc import Collection
from concurrent.futures import Future
from typing import Protocol

from ai4u_edu.blocks import Keyboard
from ai4u_edu.blocks.brains.controllers.keyboard import CENTERED, Stick


class Driven(Protocol):
    """A driver that is no mere keyboard: see :mod:`ai4u_edu.server.human_override`."""

    def are_called_by(self, codes: Collection[str]) -> bool:
        """Whether keys mean that somebody wants to drive."""

    def take(self) -> Future[None] | None:
        """Has it listen to the keyboard."""

    def let_go(self) -> Future[None] | None:
        """Nobody is at the keyboard any more."""


class Seat:
    """One seat before an agent's keyboard, and the pages that may want it.

    Whoever presses a key while it is free takes it; only that page's keys count then, until
    another one takes the seat over, the page lets go or is gone.

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

    def __init__(self, keyboard: Keyboard, hands: Driven | None = None) -> None:
        self.keyboard = keyboard
        self._hands = hands
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

    def take(self, page: int) -> Future[None] | None:
        """A page wants the seat, and gets it; something may have to be waited for."""
        if self.driver != page:
            self._hand_to(page)
        return self._hands.take() if self._hands else None

    def let_go(self, page: int) -> Future[None] | None:
        """A page doesn't want the seat any more; something may have to be waited for."""
        return self._hand_to(None) if self.driver == page else None

    def hold(
        self, page: int, codes: Collection[str], stick: Stick = CENTERED
    ) -> Future[None] | None:
        """A page holds these keys now; they count if it drives, or may begin to."""
        wants = any(stick) or (self._hands.are_called_by(codes) if self._hands else bool(codes))
        if self.driver is None and wants:
            self._hand_to(page)
        if self.driver != page:
            return None
        self.keyboard.hold(codes, stick)
        return self._hands.take() if self._hands and wants else None

    def _hand_to(self, page: int | None) -> Future[None] | None:
        self.keyboard.release()
        self.driver = page
        self._tell()
        return self._hands.let_go() if self._hands and page is None else None

    def _tell(self) -> None:
        for event in self._changed.values():
            event.set()
