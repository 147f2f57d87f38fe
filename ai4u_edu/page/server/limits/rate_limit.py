"""Rate limits: of one connection's messages, and of whatever is counted by address or seat."""

import math
import time
from collections import OrderedDict
from collections.abc import Callable, Hashable
from functools import partial

MAX_KEYS = 1000
"""Keys that are remembered, the most recent ones."""


class RateLimit:
    """A token bucket: it fills steadily, and each message takes one token.

    Args:
        per_second: tokens added in a second.
        burst: the most tokens that it holds; default: those of one second.
        max_debt: tokens that may be taken before they are there.
        clock: returns seconds; to be replaced in tests.

    >>> now = 0.0
    >>> limit = RateLimit(2, clock=lambda: now)
    >>> limit.take(), limit.take(), limit.take()
    (0.0, 0.0, 0.5)
    >>> now = 1.0
    >>> limit.take()
    0.0
    """

    def __init__(
        self,
        per_second: float,
        burst: float | None = None,
        *,
        max_debt: float = math.inf,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._per_second, self._max_debt = per_second, max_debt
        self._burst = per_second if burst is None else burst
        self._clock = clock
        self._tokens = self._burst
        self._filled_at = clock()

    def take(self) -> float:
        """Take a token, and return the seconds by which the message came too early (0: none)."""
        self._tokens = max(self._fill() - 1, -self._max_debt)
        return self._seconds_for(0.0)

    def take_within(self, max_wait_s: float = 0.0) -> float | None:
        """Take a token if it is there soon enough, and return the seconds until then, else None.

        >>> limit = RateLimit(2, clock=lambda: 0.0)
        >>> limit.take_within(), limit.take_within(), limit.take_within(), limit.take_within(0.5)
        (0.0, 0.0, None, 0.5)
        """
        if self._fill() - 1 < 0 and self._seconds_for(1.0) > max_wait_s:
            return None
        return self.take()

    def wait_s(self) -> float:
        """Return the seconds until a token is there, without taking it."""
        self._fill()
        return self._seconds_for(1.0)

    def _fill(self) -> float:
        now = self._clock()
        gained = (now - self._filled_at) * self._per_second
        self._tokens, self._filled_at = min(self._burst, self._tokens + gained), now
        return self._tokens

    def _seconds_for(self, tokens: float) -> float:
        missing = tokens - self._tokens
        return 0.0 if missing <= 0 else missing / self._per_second if self._per_second else math.inf


class RateLimits:
    """A rate limit for each key, such as an address or a seat; see :class:`RateLimit`.

    The keys of the latest :data:`MAX_KEYS` tokens are remembered. Belongs to one thread.

    Args:
        per_second: tokens added in a second.
        burst: the most tokens of a key.
        max_debt: tokens of a key that may be taken before they are there.
        clock: returns seconds; to be replaced in tests.

    >>> limits = RateLimits(1, 2, clock=lambda: 0.0)
    >>> [limits.take_within("a") for _ in range(3)], limits.take_within("b")
    ([0.0, 0.0, None], 0.0)
    """

    def __init__(
        self,
        per_second: float,
        burst: float,
        *,
        max_debt: float = math.inf,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._new = partial(RateLimit, per_second, burst, max_debt=max_debt, clock=clock)
        self._limits: OrderedDict[Hashable, RateLimit] = OrderedDict()

    def __len__(self) -> int:
        return len(self._limits)

    def take(self, key: Hashable) -> float:
        """Take a token of a key; see :meth:`RateLimit.take`."""
        return self._of(key).take()

    def take_within(self, key: Hashable, max_wait_s: float = 0.0) -> float | None:
        """Take a token of a key if it is there soon enough; see :meth:`RateLimit.take_within`."""
        return self._of(key).take_within(max_wait_s)

    def wait_s(self, key: Hashable) -> float:
        """Return the seconds until a key has a token, without taking it."""
        limit = self._limits.get(key)
        return 0.0 if limit is None else limit.wait_s()

    def _of(self, key: Hashable) -> RateLimit:
        limit = self._limits.setdefault(key, self._new())
        self._limits.move_to_end(key)
        if len(self._limits) > MAX_KEYS:
            self._limits.popitem(last=False)
        return limit
