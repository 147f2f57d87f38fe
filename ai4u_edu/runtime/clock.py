"""When ticks are due by the wall clock, and how well that is kept."""

import math
import threading
import time
from collections import deque
from collections.abc import Callable

from ai4u_edu.runtime.snapshot_publisher import FEW_TICKS

MAX_LAG_S = 0.25
"""A world that is further behind than this gives up catching up."""
PROMPT_SLEEP_S = 0.05
"""A pause that is shorter is slept without listening for commands, which is more exact."""
COMMAND_POLL_S = 0.05
"""Seconds between two looks whether commands that wait may be carried out, in a longer pause."""
YIELD_S = 0.0002
"""Seconds for which a thread that gives way to a tick sleeps at a time."""
MAX_YIELD_S = 0.01
"""Seconds for which a thread that draws waits for the end of a tick."""
SOON_S = 0.0003
"""Drawing also yields if the next tick is due within this time."""
HOPELESS_LAG_S = 0.02
"""A world whose ticks are late by so much, on average, is not helped by yielding."""


class TickSchedule:
    """Paces the thread that runs a world, and lets threads that draw keep out of its way.

    The runner's thread holds :attr:`is_ticking` during a tick and calls :meth:`tick_ended` and
    :meth:`sleep` after it. Any thread may call :meth:`give_way` and read the numbers.

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
        self.is_ticking = threading.Lock()
        self.is_asleep = False
        """True until the next tick is due."""
        self._window: deque[tuple[float, int]] = deque(maxlen=60)

    def give_way(self) -> None:
        """Wait until no tick is due or under way, but not for long.

        One thread computes at a time. A tick between others that compute takes as many times as
        long; so who only draws says this between one thing and the next.
        """
        if self.lateness > HOPELESS_LAG_S:
            return
        enough = self._clock() + MAX_YIELD_S
        while self.is_asleep and self.due - SOON_S < self._clock() < enough:
            time.sleep(YIELD_S)  # it would not get the processor when it wakes up
        if self.is_ticking.acquire(timeout=MAX_YIELD_S):
            self.is_ticking.release()

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
        self.lateness += FEW_TICKS * (late - self.lateness)

    def sleep(self, wake: threading.Event, listen: Callable[[], bool]) -> None:
        """Sleep until the next tick is due.

        Args:
            wake: set when somebody wants something.
            listen: looks what is wanted; false ends the sleep.
        """
        self.is_asleep = True
        try:
            while (left := self.due - self._clock()) > 0:
                if left <= PROMPT_SLEEP_S:
                    time.sleep(left)
                    return
                if wake.wait(min(left - PROMPT_SLEEP_S / 2, COMMAND_POLL_S)):
                    wake.clear()
                if not listen():
                    return
        finally:
            self.is_asleep = False

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
