"""A part of the picture, drawn at its own pace; what goes wrong in it stays in it."""

import time
from collections.abc import Callable
from typing import Protocol

from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.viewer.backend.log_once import Complaints

MOST = 0.2
"""The share of the processor's time that one part may take: with a hundred agents what takes long
is drawn less often, and all else is as smooth as ever."""
EACH_PAGE = 0.1
"""The same for a part that is drawn for each page anew: with a hundred pages it gives way to what
all of them see."""


class Part(Protocol):
    """Something that is drawn."""

    def build(self, static_scene: StaticScene) -> None:
        """Gets ready for a static scene; called for every new one."""

    def draw(self, snapshot: Snapshot) -> None:
        """Shows a snapshot."""


class Paced:
    """Draws a part so many times a second at most, and less often if it takes long.

    A picture that lacks it is better than none.

    Args:
        part: what is drawn.
        rate: how many times a second.
        complaints: gets to know what went wrong.
        share: of the time that it may take.
        rounds: so many times it has to be drawn until all pages have had their turn.
    """

    def __init__(
        self,
        part: Part,
        rate: float,
        complaints: Complaints,
        share: float = MOST,
        rounds: Callable[[], int] = lambda: 1,
    ) -> None:
        self.part, self._rounds = part, rounds
        self._period = 1 / rate
        self._share = share
        self._complaints = complaints
        self._drawn_at = self._took = 0.0
        self._ready = False

    def build(self, static_scene: StaticScene) -> None:
        """Gets the part ready for a static scene; its next picture is due at once."""
        self._drawn_at, self._ready = 0.0, False
        with self._complaints.caught():
            self.part.build(static_scene)
            self._ready = True

    def make_due(self) -> None:
        """Let the next snapshot be drawn, however soon it comes."""
        self._drawn_at = 0.0

    def draw(self, snapshot: Snapshot) -> None:
        """Shows a snapshot, if that is due."""
        now = time.monotonic()
        # pictures come when the world has ticked: a bit early is better than a tick late
        if self._ready and now - self._drawn_at >= max(
            0.8 * self._period / self._rounds(), self._took / self._share
        ):
            self._drawn_at, began = now, time.thread_time()
            with self._complaints.caught():
                self.part.draw(snapshot)
            self._took = time.thread_time() - began
