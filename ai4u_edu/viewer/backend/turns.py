"""Whose turn it is, where each page is drawn for itself."""

from collections.abc import Collection
from itertools import islice

AT_ONCE = 16
"""Pages that are drawn between two pictures: a picture, and a tick, would have to wait for more."""


class Turns:
    """A few pages at a time, all of them in turn.

    >>> turns = Turns()
    >>> turns.next(range(3)), turns.next(range(3))
    ([0, 1, 2], [0, 1, 2])
    >>> turns.next(range(20))[-1], turns.next(range(20))[:5]
    (15, [16, 17, 18, 19, 0])
    """

    def __init__(self) -> None:
        self._next = 0

    def next(self, pages: Collection[int]) -> list[int]:
        """The numbers of those whose turn it is."""
        count = len(pages)
        if count <= AT_ONCE:
            return list(pages)
        first, self._next = self._next % count, (self._next + AT_ONCE) % count
        return list(islice((*pages, *pages), first, first + AT_ONCE))

    @staticmethod
    def rounds(pages: int) -> int:
        """How many times it takes until each has had its turn."""
        return max(-(-pages // AT_ONCE), 1)
