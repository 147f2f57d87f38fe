"""Counts of wrong secrets by address."""

import math
from collections import OrderedDict
from collections.abc import Callable
from typing import TypeVar

from ai4u_edu.page.server.limits.rate_limit import MAX_KEYS, RateLimits

MAX_WRONG = 60
"""Wrong secrets in a row after which an address is limited."""
FORGOTTEN_PER_S = 1.0
"""Rate at which an address's wrong secrets are forgotten."""
MAX_DEBT = 10
"""Wrong secrets beyond that which count, so that an address is not limited without end."""
MAX_ADDRESSES = MAX_KEYS
"""Addresses that are remembered, the most recent ones."""

Value = TypeVar("Value")


class WrongCounts:
    """Counts of wrong secrets (tokens, codes) by address, which are forgotten with time.

    Args:
        clock: returns seconds.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self._limits = RateLimits(FORGOTTEN_PER_S, MAX_WRONG, max_debt=MAX_DEBT, clock=clock)

    def __len__(self) -> int:
        return len(self._limits)

    def add(self, address: str) -> None:
        """Count a wrong secret."""
        self._limits.take(address)

    def seconds_over(self, address: str) -> int:
        """Return the seconds until an address is not limited any more; 0 if it is not now."""
        return math.ceil(self._limits.wait_s(address))


def remember(kept: OrderedDict[str, Value], address: str, value: Value) -> None:
    """Keep a value of an address, and forget the oldest one of too many."""
    kept[address] = value
    kept.move_to_end(address)
    if len(kept) > MAX_ADDRESSES:
        kept.popitem(last=False)
