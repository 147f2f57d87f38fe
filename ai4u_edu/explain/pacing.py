"""A limit on how much of a processor one thread takes, and when."""

import math
import threading
import time
from collections.abc import Callable

MIN_WORK_S = 0.001
"""Processor time after which a thread rests; shorter rests would cost more than they give."""


TICK_S = 0.002
"""Time that a tick takes, about: a thread begins to work this long after one was due."""
MAX_TICKS_WAITED = 3
"""Most ticks that a thread lets pass, where the work fits between none of them."""


class StoppedError(Exception):
    """The work is to end."""


class Pacing:
    """Keeps the work of one thread to a share of one processor; that thread alone calls it.

    Only one thread of Python runs at a time: so work is done between two ticks of a world, as long
    as it is shorter than the time between them.

    Args:
        share: returns the share that it may take now, 0..1.
        stopping: ends the work.
        next_tick_at: returns when a world ticks next (s, of the clock); infinity if it does not
            tick by the clock.
        clock: seconds.
        thread_time: processor time (s) of the calling thread.
    """

    def __init__(
        self,
        share: Callable[[], float],
        stopping: threading.Event,
        next_tick_at: Callable[[], float] = lambda: math.inf,
        *,
        clock: Callable[[], float] = time.monotonic,
        thread_time: Callable[[], float] = time.thread_time,
    ) -> None:
        self._share, self._stopping = share, stopping
        self._next_tick_at = next_tick_at
        self._clock, self._thread_time = clock, thread_time
        self._began = thread_time()
        self._work_s = MIN_WORK_S
        """Length of the next piece of work, from those before it."""

    def rest(self) -> None:
        """Wait as long as the work since the last rest asks for.

        Raises:
            StoppedError: the work is to end.
        """
        took = self._thread_time() - self._began
        if took < MIN_WORK_S and not self._stopping.is_set():
            return
        self._work_s = max(took, 0.9 * self._work_s)
        self._wait(max(took / self._share() - took, 0.0))
        for _ in range(MAX_TICKS_WAITED):
            left = self._next_tick_at() - self._clock()
            if left > self._work_s + MIN_WORK_S or left < -TICK_S:
                break
            self._wait(max(left, 0.0) + TICK_S)
        self._began = self._thread_time()

    def _wait(self, seconds: float) -> None:
        if self._stopping.wait(seconds):
            raise StoppedError
