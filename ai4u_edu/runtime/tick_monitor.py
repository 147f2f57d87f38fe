"""Detection of slow ticks, and of blocks that do not return."""

import logging
import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.block_frames import CodePlace, calls_of_thread, find_place
from ai4u_edu.locale import gettext as _
from ai4u_edu.snapshot import SlowTick

logger = logging.getLogger(__name__)

STALL_S = 2.0
"""Time after which a tick or a command that has not ended counts as stalled."""
STALL_POLL_S = 0.5
"""Poll interval of the thread that logs stalls."""
SLOW_TICK_S = 0.05
"""Duration above which a tick counts as slow."""
SLOW_TICK_SHOWN_S = 5.0
"""Time for which a slow tick is reported."""


@dataclass(frozen=True, slots=True)
class Stall:
    """A tick or a command that has not ended for :data:`STALL_S`."""

    since: float
    """Time at which it began, by the runner's clock (s)."""
    seconds: float
    """Time since then."""
    place: CodePlace
    """The block and the line where the thread is."""

    @property
    def block(self) -> str:
        """The block that does not return; empty if the thread is in none."""
        return self.place.block

    @property
    def agent(self) -> str:
        """The id of its agent; empty if it is not known."""
        return self.place.agent

    @property
    def where(self) -> str:
        """File and line; empty if they are not known."""
        return self.place.where

    @property
    def title(self) -> str:
        """The block, its agent and the line, without the time."""
        title = self.place.title
        return _("{block} ({place})", block=title, place=self.where) if self.where else title

    def __str__(self) -> str:
        """Return a sentence about it.

        >>> place = CodePlace("Sensor WallDistance 'wall'", "0", "my_blocks.py, line 12")
        >>> str(Stall(since=3.0, seconds=5.2, place=place))
        "Sensor WallDistance 'wall' of agent '0' has not answered for 5 s (my_blocks.py, line 12)"
        """
        return str(self.text)

    @property
    def text(self) -> str:
        """The same, as a text that can be translated."""
        values = {"block": self.place.title, "seconds": f"{self.seconds:.0f}"}
        if not self.where:
            return _("{block} has not answered for {seconds} s", **values)
        return _("{block} has not answered for {seconds} s ({place})", place=self.where, **values)


class TickMonitor:
    """Finds ticks that are slow, and ticks or commands that do not end.

    The runner's thread calls :meth:`begin`, :meth:`end`, :meth:`note_tick` and :meth:`forget`; they
    take no lock and cost no more than a look at the clock. Any thread may read :attr:`stall`; only
    then, and only if too much time has passed, the stack is examined. A thread of the monitor's own
    logs stalls.

    Args:
        clock: seconds.
        agents: returns those of the world that runs.
    """

    def __init__(
        self, clock: Callable[[], float], agents: Callable[[], Iterable[BasicAgent]]
    ) -> None:
        self._clock = clock
        self._agents = agents
        self._since: float | None = None
        self._thread_id = 0
        self._slow: tuple[float, SlowTick] | None = None
        self._seen: Stall | None = None
        self._logged: Stall | None = None
        self._ended = threading.Event()

    def begin(self) -> None:
        """Note that the calling thread begins something that should soon end."""
        self._thread_id = threading.get_ident()
        self._since = self._clock()

    def end(self) -> None:
        """Note that it has ended, or only waits."""
        self._since = None

    def note_tick(self, seconds: float, count_contacts: Callable[[], int]) -> None:
        """Note how long a tick took; contacts are counted only if it was slow."""
        if seconds <= SLOW_TICK_S:
            return
        before = self.slow_tick
        if before is None or seconds > before.seconds:
            self._slow = self._clock(), SlowTick(seconds, count_contacts())

    def forget(self) -> None:
        """Forget slow ticks, since another world has taken this one's place."""
        self._slow = None

    @property
    def slow_tick(self) -> SlowTick | None:
        """The slowest tick of the last :data:`SLOW_TICK_SHOWN_S`; None if none was slow."""
        if self._slow is None or self._clock() - self._slow[0] > SLOW_TICK_SHOWN_S:
            return None
        return self._slow[1]

    @property
    def is_stalled(self) -> bool:
        """True while something that should have ended has not; cheap."""
        since = self._since
        return since is not None and self._clock() - since > STALL_S

    @property
    def stall(self) -> Stall | None:
        """The tick or command that has not ended for too long; None if there is none."""
        return self.under_way() if self.is_stalled else None

    def under_way(self) -> Stall | None:
        """Return what has not ended, however long it has taken; None if nothing is under way."""
        since = self._since
        if since is None:
            return None
        place = find_place(calls_of_thread(self._thread_id), self._agents())
        if self._since != since:
            return None  # it ended while the stack was examined
        return Stall(since, self._clock() - since, place)

    def start(self) -> None:
        """Start the thread that logs stalls."""
        threading.Thread(target=self._run, name="stall monitor", daemon=True).start()

    def stop(self) -> None:
        """End that thread."""
        self._ended.set()

    def log_changes(self) -> None:
        """Log a stall that has begun, or one that has ended, once each.

        One that is seen for the first time is checked once more: a process that was stopped for a
        while, or a computer that slept, continues in the middle of a tick.
        """
        stall, seen, logged = self.stall, self._seen, self._logged
        self._seen = stall
        if logged is not None and (stall is None or stall.since != logged.since):
            self._logged = None
            lasted = self._clock() - logged.since
            logger.warning("%s goes on, after about %.0f s", logged.place, lasted)
        elif stall is not None and logged is None and seen and seen.since == stall.since:
            self._logged = stall
            logger.warning("%s", stall)

    def _run(self) -> None:
        while not self._ended.wait(STALL_POLL_S):
            self.log_changes()
