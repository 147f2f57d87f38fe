"""The time for which a world in lockstep waits for a script."""

import time
from collections.abc import Callable

from ai4u_edu.blocks.brains.links.link import Link

WAIT_SLICE_S = 0.015
"""Time for which the world waits at once; then the runner checks its commands, and asks again."""
YIELD_AFTER_S = 0.05
"""Time for which a script that asks for time makes a world with other agents wait. One script may
drive several of them in turn: if the world waited for all of them, it would wait for ever."""
YIELDING_WAIT_S = 0.001
"""Time for which the world waits for such a script after that, at each tick."""


class Patience:
    """The time limit of a script's answer, and whether the world has stopped waiting for it.

    Only the runner's thread calls it.

    Args:
        clock: seconds, the one of the link's ``time_asked_at``.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self.timeout_s = 0.0
        """Time for which a script may be silent; may change at any time."""
        self._clock = clock
        self._asked = 0.0
        self._given_up: float | None = None
        self._silent_since = 0.0

    @property
    def is_given_up(self) -> bool:
        """True while the world does not wait, since the script was silent for too long."""
        return self._given_up is not None

    @property
    def silence_s(self) -> float:
        """Time since the script was asked for the action that it owes."""
        return self._clock() - (self._silent_since if self.is_given_up else self._asked)

    def now(self) -> float:
        """Return the seconds of the clock."""
        return self._clock()

    def restart(self) -> None:
        """Give the script its time again, as for another answer."""
        self._asked = self._clock()

    def give_up(self) -> None:
        """Stop waiting until the script speaks."""
        if not self.is_given_up:
            self._given_up, self._silent_since = self._clock(), self._asked

    def resume(self) -> None:
        """Wait for the script again."""
        self._given_up = None

    def asks_for_time(self, link: Link) -> bool:
        """Return True if a script that was given up has asked for time since then."""
        return self._given_up is not None and link.time_asked_at > self._given_up

    def has_time(self, link: Link, *, can_act: bool) -> bool:
        """Return True if the world may wait for the script.

        Args:
            link: to the script.
            can_act: whether there is something to decide; a script that has nothing to decide, and
                asks for time all the same, keeps nobody waiting.
        """
        if self.is_given_up:
            return False
        since = max(self._asked, link.time_asked_at) if can_act else self._asked
        return self._clock() - since <= self.timeout_s

    def yields(self, link: Link) -> bool:
        """Return True if the script has asked for time for so long that others may go on."""
        return link.time_asked_at > self._asked and self._clock() - self._asked > YIELD_AFTER_S

    def wait_s(self, link: Link, *, can_act: bool, has_company: bool) -> float:
        """Return the time to wait for an answer now.

        Args:
            link: to the script.
            can_act: see :meth:`has_time`.
            has_company: whether there are other agents in the world.
        """
        if self.is_given_up:
            return 0.0
        if self._clock() - self._asked <= YIELD_AFTER_S:
            return WAIT_SLICE_S  # whatever the script said meanwhile
        if not self.has_time(link, can_act=can_act):
            return 0.0
        return YIELDING_WAIT_S if has_company and self.yields(link) else WAIT_SLICE_S
