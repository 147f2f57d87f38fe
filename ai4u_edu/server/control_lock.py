"""Lock on an agent's keyboard: at most one page drives it."""

import asyncio
from collections.abc import Collection
from concurrent.futures import Future
from typing import Protocol

from ai4u_edu.blocks import Keyboard
from ai4u_edu.blocks.keyboard import CENTERED, Stick


class Override(Protocol):
    """Replacement of an agent's brain while a person drives.

    See :class:`ai4u_edu.server.human_override.HumanOverride`.
    """

    def is_requested_by(self, codes: Collection[str]) -> bool:
        """Return True if one of these keys asks for control."""

    def begin(self) -> Future[None] | None:
        """Make the agent listen to the keyboard."""

    def end(self) -> Future[None] | None:
        """Give the agent its own brain back."""


class ControlLock:
    """Lock on an agent's keyboard, and the pages that may acquire it.

    The first page to press a key while the lock is free acquires it. Only its keys count until
    another page takes over, or it releases the lock or disconnects. Belongs to the server's loop.

    Methods that return a future have started something in the runner's thread.

    >>> lock = ControlLock(Keyboard())
    >>> for page in (1, 2):
    ...     _ = lock.add_page(page)
    >>> lock.hold_keys(1, ["KeyW"]); lock.hold_keys(2, ["KeyS"])
    >>> lock.driver, sorted(lock.keyboard.held())
    (1, ['KeyW'])
    >>> lock.acquire(2)
    >>> lock.driver, sorted(lock.keyboard.held())
    (2, [])
    """

    def __init__(self, keyboard: Keyboard, override: Override | None = None) -> None:
        self.keyboard = keyboard
        self._override = override
        self.driver: int | None = None
        """Number of the page that holds the lock; None while it is free."""
        self._changed: dict[int, asyncio.Event] = {}

    @property
    def page_count(self) -> int:
        """Number of pages that show the agent."""
        return len(self._changed)

    def add_page(self, page: int) -> asyncio.Event:
        """Add a page, and return an event that is set whenever the lock changes."""
        self._changed[page] = asyncio.Event()
        self._notify()
        return self._changed[page]

    def remove_page(self, page: int) -> None:
        """Remove a page; release the lock if the page held it."""
        del self._changed[page]
        if self.driver == page:
            self._set_driver(None)
        self._notify()

    def acquire(self, page: int) -> Future[None] | None:
        """Give a page the lock, also if another page holds it."""
        if self.driver != page:
            self._set_driver(page)
        return self._override.begin() if self._override else None

    def release(self, page: int) -> Future[None] | None:
        """Release the lock, if the page holds it."""
        return self._set_driver(None) if self.driver == page else None

    def hold_keys(
        self, page: int, codes: Collection[str], stick: Stick = CENTERED
    ) -> Future[None] | None:
        """Set the keys that a page holds; they count if it has the lock, or can acquire it."""
        is_request = any(stick) or (
            self._override.is_requested_by(codes) if self._override else bool(codes)
        )
        if self.driver is None and is_request:
            self._set_driver(page)
        if self.driver != page:
            return None
        self.keyboard.hold(codes, stick)
        return self._override.begin() if self._override and is_request else None

    def _set_driver(self, page: int | None) -> Future[None] | None:
        self.keyboard.release()
        self.driver = page
        self._notify()
        return self._override.end() if self._override and page is None else None

    def _notify(self) -> None:
        for event in self._changed.values():
            event.set()
