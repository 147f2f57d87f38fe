"""Waits for what a test caused, with a limit that only a fault reaches."""

import asyncio
import time
from collections.abc import Callable

LIMIT_S = 180.0
"""Time (s) that a test waits for an event; on a busy machine everything takes ten times as long."""
LIMIT_MS = 1000 * LIMIT_S


def until(condition: Callable[[], object], pause: Callable[[float], object] = time.sleep) -> None:
    """Wait for a condition to become true.

    Args:
        pause: sleeps for that many seconds; a loop that the condition needs may run meanwhile.
    """
    deadline = Deadline()
    while not condition():
        deadline.left()
        pause(POLL_S)


async def until_async(condition: Callable[[], object]) -> None:
    """Wait for a condition to become true while the event loop runs."""
    deadline = Deadline()
    while not condition():
        deadline.left()
        await asyncio.sleep(POLL_S)


POLL_S = 0.005


class Deadline:
    """Limit of a wait that takes several steps."""

    def __init__(self) -> None:
        self._end = time.monotonic() + LIMIT_S

    def left(self, state: str = "") -> float:
        """Return the seconds that are left.

        Args:
            state: text for the error, as what is there in place of what was expected.

        Raises:
            AssertionError: there are none.
        """
        left = self._end - time.monotonic()
        assert left > 0, f"it did not happen within {LIMIT_S:.0f} s {state}"
        return left
