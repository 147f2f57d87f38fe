"""The slowest tick of the last seconds, if one took too long."""

from collections.abc import Callable

from ai4u_edu.snapshot import SlowTick

SLOW = 0.05
"""A tick that takes longer (s) is reported."""
LATELY = 5.0
"""For so long (s)."""


class SlowTicks:
    """Remembers a slow tick for a while.

    Args:
        clock: seconds.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._slowest: tuple[float, SlowTick] | None = None

    def note(self, took: float, count_contacts: Callable[[], int]) -> None:
        """A tick took so many seconds; what touches is counted only if it was slow."""
        if took <= SLOW:
            return
        before = self.slowest
        if before is None or took > before.seconds:
            self._slowest = self._clock(), SlowTick(took, count_contacts())

    @property
    def slowest(self) -> SlowTick | None:
        """The slowest one, lately; None if none was slow."""
        if self._slowest is None or self._clock() - self._slowest[0] > LATELY:
            return None
        return self._slowest[1]

    def clear(self) -> None:
        """Another world has other ticks."""
        self._slowest = None
