"""Clocks that pass when a test or a world says so."""

import threading

from ai4u_edu.runtime.clock import Clock


class ManualClock(Clock):
    """Time that passes when a test says so, and while a world sleeps.

    A world with such a clock takes no longer than its ticks do, and is never late, however slow the
    machine is.
    """

    def __init__(self, now: float = 100.0) -> None:
        super().__init__(lambda: self.now)
        self.now = now
        self.slept: list[float] = []
        """Seconds of each sleep of the world."""

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self.now += seconds

    def wait(self, event: threading.Event, seconds: float) -> bool:
        if not event.is_set():
            self.slept.append(seconds)
            self.now += seconds
        return event.is_set()
