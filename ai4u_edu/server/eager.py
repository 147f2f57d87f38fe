"""An event loop that may look for what comes a little longer, before it goes to sleep.

To be woken takes about as long as a script's whole answer. Where a world goes as fast as its
scripts, and the next answer is due any moment, it is quicker to look out for it.
"""

import asyncio
import selectors
import sys
import time

from ai4u_edu.base.lookout import give_way

EAGER = 2e-4
"""Seconds."""


class EagerSelector(selectors.DefaultSelector):
    """Waits as any other; until a moment, it does so without sleeping."""

    def __init__(self) -> None:
        super().__init__()
        self.until = 0.0
        """By time.perf_counter."""

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        """What is ready, within so many seconds; None for any time."""
        until = self.until
        if timeout is not None:
            until = min(until, time.perf_counter() + timeout)
        while time.perf_counter() < until:
            found = super().select(0)
            if found:
                return found
            give_way()
        return super().select(timeout)


class EagerLoop(asyncio.SelectorEventLoop):
    """An event loop with such a selector."""

    def __init__(self) -> None:
        self._eager = EagerSelector()
        super().__init__(self._eager)

    def look_out(self) -> None:
        """From now on it does not sleep for a little while."""
        self._eager.until = time.perf_counter() + EAGER


def look_out() -> None:
    """Has the loop that runs here look out, if it can."""
    loop = asyncio.get_running_loop()
    if isinstance(loop, EagerLoop):
        loop.look_out()


def new_loop() -> asyncio.AbstractEventLoop:
    """The loop of a server; on Windows, Python's own."""
    return asyncio.new_event_loop() if sys.platform == "win32" else EagerLoop()
