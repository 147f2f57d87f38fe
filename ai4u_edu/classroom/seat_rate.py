"""Rate limit for the requests of each seat."""

import time
from collections.abc import Callable

from ai4u_edu.page.server.limits.rate_limit import RateLimits

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
        self._limits = RateLimits(REQUESTS_PER_S, MAX_REQUESTS_AT_ONCE, clock=clock)

    def is_allowed(self, seat: int) -> bool:
        """Count a request of a seat; return False if there are too many."""
        return self._limits.take_within(seat) is not None
