"""Counts of wrong secrets by address."""

import math
from collections import OrderedDict
from collections.abc import Callable
from typing import TypeVar

MAX_WRONG = 60
"""Wrong secrets in a row after which an address is limited."""
FORGOTTEN_PER_S = 1.0
"""Rate at which an address's wrong secrets are forgotten."""
MAX_ADDRESSES = 1000
"""Addresses that are remembered, the most recent ones."""

Value = TypeVar("Value")


class WrongCounts:
    """Counts of wrong secrets (tokens, codes) by address, which are forgotten with time.

    Args:
        clock: returns seconds.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._wrong: OrderedDict[str, tuple[float, float]] = OrderedDict()  # how many, and when

    def __len__(self) -> int:
        return len(self._wrong)

    def add(self, address: str) -> None:
        """Count a wrong secret."""
        count = min(self._count(address) + 1, MAX_WRONG + 10)  # the count must not grow without end
        remember(self._wrong, address, (count, self._clock()))

    def seconds_over(self, address: str) -> int:
        """Return the seconds until an address is not limited any more; 0 if it is not now."""
        over = self._count(address) - MAX_WRONG + 1
        return max(0, math.ceil(over / FORGOTTEN_PER_S))

    def _count(self, address: str) -> float:
        count, when = self._wrong.get(address, (0.0, 0.0))
        return max(0.0, count - (self._clock() - when) * FORGOTTEN_PER_S)


def remember(kept: OrderedDict[str, Value], address: str, value: Value) -> None:
    """Keep a value of an address, and forget the oldest one of too many."""
    kept[address] = value
    kept.move_to_end(address)
    if len(kept) > MAX_ADDRESSES:
        kept.popitem(last=False)
