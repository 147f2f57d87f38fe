"""When ticks are due by the wall clock, and how well that is kept."""

import math
import threading
import time
from collections import deque
from collections.abc import Callable

LATENESS_SMOOTHING = 1 / 16
"""Weight of the last tick in the moving average of lateness."""
MAX_LAG_S = 0.25
"""A world that is further behind than this gives up catching up."""
PROMPT_SLEEP_S = 0.05
"""A pause that is shorter is slept without listening for commands, which is more exact."""
COMMAND_POLL_S = 0.05
"""Seconds between two looks whether commands that wait may be carried out, in a longer pause."""


class TickSchedule:
    """The times at which ticks are due, and how well they are kept.

    The runner's thread calls :meth:`tick_ended` and :meth:`sleep` after each tick. Any thread may
    read the numbers.

    Args:
        clock: seconds.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self.due = clock()
        """When the next tick is to begin."""
        self.lateness = 0.0
        """Lateness (s) with which ticks lately began, on average."""
        self.ticked = 0
        """Count of ticks so far."""
        self._window: deque[tuple[float, int]] = deque(maxlen=60)

    def tick_ended(self, period: float, *, held: bool) -> None:
        """Find out when the next tick is due.

        Args:
            period: seconds from one tick to the next; 0 for a world that runs as fast as it can.
            held: whether the tick did not take place: then there is nothing to catch up with.
        """
        now = self._clock()
        self._window.append((now, self.ticked))
        if held:
            self.due = now
            return
        self.due = max(self.due + period, now - MAX_LAG_S)
        late = max(now - self.due, 0.0) if period else 0.0  # as fast as it goes is never late
        self.lateness += LATENESS_SMOOTHING * (late - self.lateness)

    def sleep(self, wake: threading.Event, listen: Callable[[], bool]) -> None:
        """Sleep until the next tick is due.

        Args:
            wake: set when somebody wants something.
            listen: looks what is wanted; false ends the sleep.
        """
        while (left := self.due - self._clock()) > 0:
            if left <= PROMPT_SLEEP_S:
                time.sleep(left)
                return
            if wake.wait(min(left - PROMPT_SLEEP_S / 2, COMMAND_POLL_S)):
                wake.clear()
            if not listen():
                return

    def rest(self) -> None:
        """Forget how well it went: the time stands still."""
        self._window.clear()
        self.lateness = 0.0
        self.due = self._clock()

    def real_time_factor(self, dt: float) -> float | None:
        """Return how fast the time ran lately; None if it has only begun.

        Args:
            dt: seconds of a tick, of the world's time.
        """
        if len(self._window) < 2:
            return None
        (began, first), (ended, last) = self._window[0], self._window[-1]
        return (last - first) * dt / max(ended - began, 1e-9)

    def forget(self) -> None:
        """Forget how well it went: another world runs at another speed."""
        self._window.clear()


def is_unpaced(time_scale: float) -> bool:
    """Return whether the time runs as fast as it can, and not by the clock."""
    return math.isinf(time_scale)
