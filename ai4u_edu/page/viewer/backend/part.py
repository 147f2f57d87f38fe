"""Parts of a frame: each is drawn at its own rate, and its errors stop nothing else."""

import time
from typing import Protocol

from ai4u_edu.base.log_limit import ErrorLog
from ai4u_edu.runtime.frame_budget import EARLY_FRACTION, PART_SHARE
from ai4u_edu.snapshot import Snapshot, StaticScene


class Part(Protocol):
    """Something that is drawn."""

    def build(self, static_scene: StaticScene) -> None:
        """Prepare for a static scene; called for every new one."""

    def draw(self, snapshot: Snapshot) -> None:
        """Show a snapshot."""


class RatedPart:
    """Draws a part at a limited rate, and less often if it takes long.

    Args:
        part: what is drawn.
        rate: how many times a second, at most.
        error_log: logs errors of the part.
    """

    def __init__(self, part: Part, rate: float, error_log: ErrorLog) -> None:
        self.part = part
        self._period = EARLY_FRACTION / rate
        self._error_log = error_log
        self._drawn_at = self._draw_time = 0.0
        self._is_ready = False

    def build(self, static_scene: StaticScene) -> None:
        """Prepare the part for a static scene; it is drawn in the next frame."""
        self._drawn_at, self._is_ready = 0.0, False
        with self._error_log.caught():
            self.part.build(static_scene)
            self._is_ready = True

    def make_due(self) -> None:
        """Draw the next snapshot, however soon it comes."""
        self._drawn_at = 0.0

    def draw(self, snapshot: Snapshot) -> None:
        """Show a snapshot, if that is due."""
        now = time.monotonic()
        if self._is_ready and now - self._drawn_at >= max(
            self._period, self._draw_time / PART_SHARE
        ):
            self._drawn_at, began = now, time.thread_time()
            with self._error_log.caught():
                self.part.draw(snapshot)
            self._draw_time = time.thread_time() - began
