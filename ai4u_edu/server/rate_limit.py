"""Rate limit for the messages of one connection."""

import time
from collections.abc import Callable


class RateLimit:
    """A token bucket: it fills steadily, and each message takes one token.

    Args:
        per_second: tokens added in a second, and the most that it holds.
        clock: returns seconds; to be replaced in tests.

    >>> now = 0.0
    >>> limit = RateLimit(2, clock=lambda: now)
    >>> limit.take(), limit.take(), limit.take()
    (0.0, 0.0, 0.5)
    >>> now = 1.0
    >>> limit.take()
    0.0
    """

    def __init__(self, per_second: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._per_second = per_second
        self._clock = clock
        self._tokens = per_second
        self._filled_at = clock()

    def take(self) -> float:
        """Take a token, and return the seconds by which the message came too early (0: none)."""
        now = self._clock()
        gained = (now - self._filled_at) * self._per_second
        self._tokens = min(self._per_second, self._tokens + gained) - 1
        self._filled_at = now
        return max(0.0, -self._tokens / self._per_second)
