"""Rate limit for the requests of each seat."""

import time
from collections.abc import Callable

REQUESTS_PER_S = 1.0
"""Rate of a seat's requests, of which some may come at once."""
MAX_REQUESTS_AT_ONCE = 30


class SeatRate:
    """Counts the requests of each seat. Belongs to the event loop.

    Args:
        clock: returns seconds; to be replaced in tests.

    >>> rate = SeatRate(lambda: 0.0)
    >>> [rate.is_allowed(1) for _ in range(31)].count(True), rate.is_allowed(2)
    (30, True)
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._requests: dict[int, tuple[float, float]] = {}  # how many of late, and when

    def is_allowed(self, seat: int) -> bool:
        """Count a request of a seat; return False if there are too many."""
        now = self._clock()
        count, since = self._requests.get(seat, (0.0, now))
        count = max(0.0, count - (now - since) * REQUESTS_PER_S)
        if count >= MAX_REQUESTS_AT_ONCE:
            return False
        self._requests[seat] = (count + 1, now)
        return True
