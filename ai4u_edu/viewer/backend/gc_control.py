"""Keeps Python's search for garbage from making ticks late."""

import gc
import math
import time
from collections.abc import Callable, Set

SETTLED = 2.0
"""Seconds after which pages that have come are complete."""
NEW = 50_000
"""Things that are new, after which they are searched: many times what a picture is made of."""
MANY = 20
"""Pages that have gone, after which everything is searched, which takes longest."""


class Housekeeping:
    """Sets aside what stays as long as the pages do.

    To find garbage in cycles, Python looks at everything that there is, and nobody else computes
    meanwhile: with sixty pages for 20 ms, every other second. Nearly all of it stays. So when pages
    have come or gone it is searched once, and what is left is set aside; from then on only what is
    new is looked at, and when there is much of it. What pages leave behind that was set aside waits
    until many have gone.

    Args:
        clock: seconds; to be replaced in tests.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._before = gc.get_threshold()
        gc.set_threshold(NEW, *self._before[1:])
        self._pages: frozenset[int] = frozenset()
        self._gone = 0
        self._due = math.inf
        _set_aside()

    def look(self, pages: Set[int]) -> None:
        """Does what is due; to be called now and then.

        Args:
            pages: the numbers of those that there are.
        """
        if self._pages != pages:
            self._gone += len(self._pages.difference(pages))
            self._pages, self._due = frozenset(pages), self._clock() + SETTLED
        elif self._clock() >= self._due:
            self._due = math.inf
            if self._gone >= MANY or not pages:
                self._gone = 0
                gc.unfreeze()
            _set_aside()

    def end(self) -> None:
        """Python does as it did before."""
        gc.unfreeze()
        gc.set_threshold(*self._before)


def _set_aside() -> None:
    gc.collect()
    gc.freeze()
