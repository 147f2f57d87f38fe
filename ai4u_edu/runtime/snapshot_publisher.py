"""The latest snapshot, and a way to wait for the next one."""

import threading
from collections.abc import Callable

from ai4u_edu.recording.snapshot import Snapshot
from ai4u_edu.runtime.frame_budget import FrameBudget


class SnapshotPublisher:
    """Keeps the latest snapshot, and notifies threads that wait for it.

    The runner's thread publishes; any thread may read and wait.

    Args:
        first: the snapshot to begin with.
        budget: is told what a snapshot costs.
        clock: seconds.
    """

    def __init__(self, first: Snapshot, budget: FrameBudget, clock: Callable[[], float]) -> None:
        self.latest = first
        """Replaced, never changed."""
        self._budget = budget
        self._clock = clock
        self._published = threading.Condition()

    def wait(self, seen: Snapshot, timeout: float) -> Snapshot:
        """Return the latest snapshot as soon as it is not ``seen``, or after ``timeout`` s."""
        with self._published:
            self._published.wait_for(lambda: self.latest is not seen, timeout)
        return self.latest

    def publish(self, make: Callable[[], Snapshot]) -> None:
        """Make a snapshot and notify all that wait for one."""
        began = self._clock()
        try:
            self.latest = make()
        finally:
            self._budget.note_snapshot(began, self._clock())
        with self._published:
            self._published.notify_all()
