"""Reasons for which a class holds a world."""

import math
import threading
from collections.abc import Callable

from ai4u_edu.runtime.runner import Runner


class Holds:
    """Holds a world while the teacher wants attention, a race counts down, or nobody is there.

    Thread-safe.

    Args:
        runner: runs the world.
        clock: seconds.
    """

    def __init__(self, runner: Runner, clock: Callable[[], float]) -> None:
        self._runner, self._clock = runner, clock
        self._lock = threading.Lock()
        self._attention_until = self._race_until = -math.inf
        self._absent_from = math.inf
        self._is_held = False

    @property
    def next_change(self) -> float:
        """Time of the clock (s) at which a hold begins or ends by itself; infinite if none does."""
        now = self._clock()
        ends = (self._attention_until, self._race_until, self._absent_from)
        return min((each for each in ends if each > now), default=math.inf)

    def for_attention(self, until: float) -> None:
        """Hold the world for the teacher until that time of the clock (s)."""
        self._attention_until = until
        self.refresh()

    def for_race(self, until: float) -> None:
        """Hold the world for a race's countdown.

        Args:
            until: time of the clock (s).
        """
        self._race_until = until
        self.refresh()

    def for_absence(self, since: float) -> None:
        """Hold the world because nobody is watching.

        Args:
            since: time of the clock (s) from which it is held; infinity while somebody watches.
        """
        self._absent_from = since
        self.refresh()

    def end(self) -> None:
        """End all holds."""
        self._attention_until = self._race_until = -math.inf
        self._absent_from = math.inf
        self.refresh()

    def refresh(self) -> None:
        """Hold the world or let it go, as is due now."""
        with self._lock:
            now = self._clock()
            is_held = now < max(self._attention_until, self._race_until) or now >= self._absent_from
            if is_held != self._is_held:
                self._is_held = is_held
                self._runner.hold(is_held)
