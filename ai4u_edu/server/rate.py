"""How many messages a connection may send."""

import time
from collections.abc import Callable


class Rate:
    """A bucket of permissions that fills steadily; each message takes one.

    Args:
        per_second: how fast it fills, and how much it holds.
        clock: seconds; to be replaced in tests.

    >>> now = 0.0
    >>> rate = Rate(2, clock=lambda: now)
    >>> rate.take(), rate.take(), rate.take()
    (0.0, 0.0, 0.5)
    >>> now = 1.0
    >>> rate.take()
    0.0
    """

    def __init__(self, per_second: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._per_second = per_second
        self._clock = clock
        self._left = per_second
        self._looked = clock()

    def take(self) -> float:
        """For how many seconds this message comes too early; 0 if it does not."""
        now = self._clock()
        gained = (now - self._looked) * self._per_second
        self._left = min(self._per_second, self._left + gained) - 1
        self._looked = now
        return max(0.0, -self._left / self._per_second)
