"""The latest snapshot, and when it is time for another one.

There are as many as one can see and as there is time for: rather than ticks, snapshots are fewer.
"""

import threading
from collections.abc import Callable

from ai4u_edu.snapshot import Snapshot

OFTEN_ENOUGH = 1 / 120
"""Seconds between two snapshots at least, while the world runs faster than anybody can look."""
SHOWING = 0.1
"""The share of the time that may go into snapshots: of a hundred agents there are fewer of them,
rather than fewer ticks."""
ENOUGH = 0.8 / 30
"""So many seconds between two of them, or a tick more: there are enough snapshots to see things
move; rather than that there are fewer, they may take :data:`MOST_SHOWING` of the time."""
MOST_SHOWING = 0.25
GOOD_MOMENT = 1 / 31
"""So long (s) a snapshot waits for a tick that leaves time for it: not longer than two ticks."""
MUCH, UNUSUAL = 0.1, 1.5
"""In a tick that takes more than this share of its time, and so many times as long as others,
many agents sense."""
FEW_TICKS = 1 / 16
"""The share that the last tick has in how long ticks took lately, and in how late they were."""


class Publisher:
    """Keeps the latest snapshot, and tells who waits for it.

    Args:
        first: the one to begin with.
        clock: seconds.
    """

    def __init__(self, first: Snapshot, clock: Callable[[], float]) -> None:
        self.latest = first
        """Replaced, never changed; may be read by any thread."""
        self._clock = clock
        self._published = threading.Condition()
        self._shown = self._showing = 0.0
        self._took = 0.0

    def wait(self, seen: Snapshot, timeout: float) -> Snapshot:
        """The latest snapshot, as soon as it is another one than ``seen`` (or after timeout s)."""
        with self._published:
            self._published.wait_for(lambda: self.latest is not seen, timeout)
        return self.latest

    def publish(self, make: Callable[[], Snapshot]) -> None:
        """Has another one made, and all see it."""
        self._shown = self._clock()
        self.latest = make()
        self._showing = self._clock() - self._shown
        with self._published:
            self._published.notify_all()

    def is_due(self, now: float, *, took: float, next_due: float, period: float) -> bool:
        """Whether there is to be another one after a tick.

        Where it would make the next tick late, or would come between agents that have just sensed
        and their scripts, a snapshot waits for a tick that leaves more time.

        Args:
            now: by the clock.
            took: seconds of this tick.
            next_due: when the next one is to begin, by the clock.
            period: seconds from one to the next; 0 for a world without a pause.
        """
        since = now - self._shown
        if period < OFTEN_ENOUGH and since < OFTEN_ENOUGH:
            return False
        pause = max(
            0.0 if period >= OFTEN_ENOUGH else OFTEN_ENOUGH,
            min(self._showing / SHOWING, ENOUGH),
            self._showing / MOST_SHOWING,
        )
        many_sensed = took > MUCH * period and took > UNUSUAL * self._took
        self._took += FEW_TICKS * (took - self._took) if self._took else took
        no_time = now + self._showing > next_due
        if OFTEN_ENOUGH <= period < GOOD_MOMENT and (many_sensed or no_time):
            pause = max(pause, GOOD_MOMENT)
        return since >= pause
