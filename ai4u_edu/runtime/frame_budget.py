"""Limits on how often a world is drawn. All of them are here, since they have to fit together.

A frame takes two steps: after a tick the runner's thread makes a snapshot, and the viewer's thread
draws the latest snapshot on the pages, part by part. Both share the processor with ticks, which
must be on time, so the rate of every step is limited: what costs more is done less often.
"""

import math
import time
from collections.abc import Callable, Collection, Iterator

MAX_FRAMES_PER_S = 75.0
"""Frame rate for few pages, and the limit for snapshots. Above the usual 60 ticks a second, so that
a tick that comes a bit early is drawn too."""
MIN_FRAMES_PER_S = 30.0
"""Frame rate for many pages, late ticks or slow frames; motion still looks smooth."""
MAX_PAGE_FRAMES_PER_S = 720.0
"""Limit for the frames of all pages together: above nine pages, each one gets fewer."""
MAX_TICK_LATENESS_S = 0.02
"""Average lateness of ticks at which the frame rate is at its minimum."""
DRAW_SHARE = 0.3
"""Share of one processor that drawing may take, unless the frame rate is at its minimum."""
PART_SHARE = 0.2
"""Share of one processor that snapshots may take, and each part of a frame: what is slow to draw
(the labels of a hundred agents) is drawn less often, and all else stays smooth."""
PAGES_SLICE_S = 0.003
"""Processor time in one frame for a part that is drawn for each page; the next frame goes on with
the other pages."""
MAX_SNAPSHOT_DELAY_S = 0.032
"""Time between two snapshots after which the next one may make a tick late: just under two ticks at
60 a second, so that there are :data:`MIN_FRAMES_PER_S`."""
SENSES_PER_S = 30.0
"""Rate at which sensors, actions and ghosts are drawn; floors and bodies are in every frame."""
TRAILS_PER_S = 4.0
"""Rate at which the trails behind agents are drawn on each page."""
TEXTS_PER_S = 8.0
"""Rate at which the texts of the panel are drawn: faster than anybody reads."""
FRAMES_PER_SENSES, FRAMES_PER_TEXT = 2, 6
"""Least frames for each drawing of the senses, and for each of a panel's texts; they count where a
room has fewer frames than usual."""

EARLY_FRACTION = 0.8
"""Fraction of a part's period after which it may be drawn. Frames follow ticks: a part that waited
for its whole period would often be drawn one frame late."""


class FrameBudget:
    """Decides when the next snapshot and the next frame are due.

    The runner's thread calls :meth:`is_snapshot_due` and :meth:`note_snapshot`; the rest is free of
    state, and any thread may call it.

    Args:
        max_frames_per_s: for few pages, and for snapshots.
        min_frames_per_s: for many pages, late ticks or slow frames; at most the other one.
    """

    def __init__(
        self,
        max_frames_per_s: float = MAX_FRAMES_PER_S,
        min_frames_per_s: float = MIN_FRAMES_PER_S,
    ) -> None:
        self._min_period = 1 / max_frames_per_s
        self._max_period = 1 / min(min_frames_per_s, max_frames_per_s)
        self.texts_per_s = min(TEXTS_PER_S, max_frames_per_s / FRAMES_PER_TEXT)
        """Rate at which a panel's texts are sent."""
        self.senses_per_s = min(SENSES_PER_S, max_frames_per_s / FRAMES_PER_SENSES)
        """Rate at which sensors, actions and ghosts are drawn."""
        self.is_smooth = max_frames_per_s >= MIN_FRAMES_PER_S
        """True if there are enough frames for a camera that moves; a class's rooms have fewer."""
        self._snapshot_at = self._due_at = -math.inf
        self._snapshot_s = 0.0

    def note_snapshot(self, began: float, ended: float) -> None:
        """Note when a snapshot was made (s), from which the next one follows.

        One that came late does not move the later ones, so that the rate is kept.
        """
        self._snapshot_at, self._snapshot_s = began, ended - began
        self._due_at = max(self._due_at + self._min_period, began)

    def is_snapshot_due(self, now: float, next_tick_at: float) -> bool:
        """Return True if a snapshot is due after this tick.

        One that would make the next tick late waits for a tick that leaves more time, for up to
        :data:`MAX_SNAPSHOT_DELAY_S` since the last one.

        Args:
            now: end of the tick (s).
            next_tick_at: when the next tick is to begin (s).
        """
        since = now - self._snapshot_at
        if now < self._due_at or since < self._snapshot_s / PART_SHARE:
            return False
        return now + self._snapshot_s <= next_tick_at or since >= MAX_SNAPSHOT_DELAY_S

    def frame_period(self, *, pages: int, tick_lateness: float, draw_time: float) -> float:
        """Return the time (s) from the begin of one frame to that of the next.

        Args:
            pages: number of pages that are open.
            tick_lateness: average lateness of ticks (s).
            draw_time: processor time of the last frame (s).

        >>> [round(1 / FrameBudget().frame_period(pages=pages, tick_lateness=0, draw_time=0.002))
        ...  for pages in (1, 9, 18, 100)]
        [75, 75, 40, 30]
        """
        wanted = max(
            self._min_period,
            pages / MAX_PAGE_FRAMES_PER_S,
            draw_time / DRAW_SHARE,
            tick_lateness / MAX_TICK_LATENESS_S * self._max_period,
        )
        return min(wanted, self._max_period)


class PageTurns:
    """Takes turns among the pages that a part is drawn for, longest waiting first.

    Args:
        rate: how many times a second each page is drawn, at most.
        clock: wall clock (s); to be replaced in tests.
        processor_clock: processor time of this thread (s); likewise.
    """

    def __init__(
        self,
        rate: float,
        clock: Callable[[], float] = time.monotonic,
        processor_clock: Callable[[], float] = time.thread_time,
    ) -> None:
        self._period = EARLY_FRACTION / rate
        self._clock, self._processor_clock = clock, processor_clock
        self._drawn_at: dict[int, float] = {}

    def due(self, pages: Collection[int]) -> Iterator[int]:
        """Yield the numbers of the pages to draw now, until the frame's share of time is used."""
        now, began = self._clock(), self._processor_clock()
        self._drawn_at = {page: self._drawn_at.get(page, -math.inf) for page in pages}
        for page in sorted(self._drawn_at, key=self._drawn_at.__getitem__):
            if now - self._drawn_at[page] < self._period:
                return
            self._drawn_at[page] = now
            yield page
            if self._processor_clock() - began >= PAGES_SLICE_S:
                return
