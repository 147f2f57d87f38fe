"""The latest snapshot, and a way to wait for the next one."""

import threading
from collections.abc import Callable
from dataclasses import replace

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.runtime.frame_budget import FrameBudget
from ai4u_edu.snapshot import Snapshot, StaticScene, capture_static_scene


class SnapshotPublisher:
    """Keeps the latest snapshot, and notifies threads that wait for it.

    Any thread may read :attr:`latest`, and :meth:`wait` for the next one by a condition. All else
    belongs to the world's thread, the static scene included, which snapshots share and which is
    captured again when something was built.

    Args:
        sim: the world and its agents.
        budget: gets the cost of each snapshot.
        clock: seconds.
    """

    def __init__(
        self, sim: ControlRequestor, budget: FrameBudget, clock: Callable[[], float]
    ) -> None:
        self.latest: Snapshot
        """Replaced, never changed; whoever makes this object gives it the first one."""
        self.past: Snapshot | None = None
        """Snapshot of the past, which is published in place of the present; None for none."""
        self._budget, self._clock = budget, clock
        self._version: tuple[int, str, str] | None = None
        self._static_scene = capture_static_scene(sim)
        self._published = threading.Condition()

    def wait(self, seen: Snapshot, timeout: float) -> Snapshot:
        """Return the latest snapshot as soon as it is not ``seen``, or after ``timeout`` s."""
        with self._published:
            self._published.wait_for(lambda: self.latest is not seen, timeout)
        return self.latest

    def publish(self, make: Callable[[], Snapshot]) -> None:
        """Publish the snapshot of the past, or make one, and notify all that wait for one."""
        began = self._clock()
        try:
            self.latest = self.past or make()
        finally:
            self._budget.note_snapshot(began, self._clock())
        with self._published:
            self._published.notify_all()

    def show_past(self, past: Snapshot | None, time_scale: float) -> None:
        """Publish a snapshot of the past from now on; None for the present.

        Args:
            past: the snapshot; it shares the present static scene if that is equal.
            time_scale: wanted speed of the world.
        """
        if past is not None:
            shared = self._shared(past.static_scene)
            past = replace(past, static_scene=shared, paused=True, time_scale=time_scale)
        self.past = past

    def static_scene(self, sim: ControlRequestor) -> StaticScene:
        """Return a world's static scene; the same object as long as nothing in it has changed."""
        version = sim.world.generation, sim.goal, sim.success
        if self._version != version:
            self._version = version
            self._static_scene = self._shared(capture_static_scene(sim))
        return self._static_scene

    def forget_static_scene(self) -> None:
        """Compare with the world again; another one may have the same version."""
        self._version = None

    def _shared(self, other: StaticScene) -> StaticScene:
        """Return the present static scene if another one is equal to it, else that other one."""
        present = self._static_scene
        return present if other is present or other == present else other
