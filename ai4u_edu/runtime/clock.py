"""The clock of a world: when ticks are due, when an episode starts, and how long it has run."""

import threading
import time
from collections import deque
from collections.abc import Callable

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.driving_keys import has_driving_keys

LATENESS_SMOOTHING = 1 / 16
"""Weight of the last tick in the moving average of lateness."""
MAX_LAG_S = 0.25
"""Lag that is caught up; a world that is further behind skips the rest."""
UNINTERRUPTED_SLEEP_S = 0.05
"""Longest pause that is slept in one go, which is more exact; in longer ones commands are run."""
COMMAND_POLL_S = 0.05
"""Poll interval for commands in a longer pause."""


class Clock:
    """A clock by which a world runs, and the ways to sleep by it; by default the wall clock.

    A subclass gives a world a time of its own, as that of another program that it has to keep step
    with. A world whose clock moves on in :meth:`sleep` alone takes no longer than its ticks do.

    Args:
        read: returns the time (s); any thread may call it.

    >>> class Unslept(Clock):
    ...     time_s = 0.0
    ...     def sleep(self, seconds):
    ...         self.time_s += seconds
    >>> clock = Unslept(lambda: clock.time_s)
    >>> clock.sleep(3600.0)
    >>> clock.read()
    3600.0
    """

    def __init__(self, read: Callable[[], float] = time.perf_counter) -> None:
        self.read = read

    def sleep(self, seconds: float) -> None:
        """Sleep for a while; only the world's thread does."""
        time.sleep(seconds)

    def wait(self, event: threading.Event, seconds: float) -> bool:
        """Sleep until an event is set, but no longer than a while; return True if it is set."""
        return event.wait(seconds)


class TickSchedule:
    """Times at which ticks are due, with the lateness and the speed that were reached.

    The runner's thread calls :meth:`tick_ended` and :meth:`sleep` after each tick. Any thread may
    read the numbers.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self.due = clock.read()
        """Time (s) at which the next tick is to begin."""
        self.lateness = 0.0
        """Moving average of the lateness (s) of ticks."""
        self.ticked = 0
        """Number of ticks so far."""
        self._window: deque[tuple[float, int]] = deque(maxlen=60)

    def tick_ended(self, period: float, *, held: bool) -> None:
        """Set when the next tick is due.

        Args:
            period: seconds from one tick to the next; 0 for a world that runs as fast as it can.
            held: True if the tick did not take place, so that there is nothing to catch up with.
        """
        now = self._clock.read()
        self._window.append((now, self.ticked))
        if held:
            self.due = now
            return
        self.due = max(self.due + period, now - MAX_LAG_S)
        late = max(now - self.due, 0.0) if period else 0.0  # as fast as it goes is never late
        self.lateness += LATENESS_SMOOTHING * (late - self.lateness)

    def sleep(self, wake: threading.Event, run_commands: Callable[[], bool]) -> None:
        """Sleep until the next tick is due.

        Args:
            wake: set when there is a command.
            run_commands: runs those that wait; returns False to end the sleep.
        """
        while (left := self.due - self._clock.read()) > 0:
            if left <= UNINTERRUPTED_SLEEP_S:
                self._clock.sleep(left)
                return
            if self._clock.wait(wake, min(left - UNINTERRUPTED_SLEEP_S / 2, COMMAND_POLL_S)):
                wake.clear()
            if not run_commands():
                return

    def rest(self) -> None:
        """Restart after the world was paused."""
        self._window.clear()
        self.lateness = 0.0
        self.due = self._clock.read()

    def real_time_factor(self, dt: float) -> float | None:
        """Return how fast the time ran over the last 60 ticks; None if it has only begun.

        Args:
            dt: seconds of a tick, of the world's time.
        """
        if len(self._window) < 2:
            return None
        (began, first), (ended, last) = self._window[0], self._window[-1]
        return (last - first) * dt / max(ended - began, 1e-9)

    def forget(self) -> None:
        """Forget the speed, since another world has taken this one's place."""
        self._window.clear()


class EpisodeClock:
    """The time (s) of a world's present episode, for people.

    The world goes on after an episode's end, until somebody resets it; that is not counted. Where
    persons drive, an episode is over when their agents' are; else when all agents' are. Belongs to
    the world's thread.
    """

    def __init__(self) -> None:
        self._episode: tuple[ControlRequestor, int] | None = None
        self._ended_at: dict[tuple[str, int], float] = {}

    def note_ends(self, sim: ControlRequestor) -> None:
        """Note which agents' episodes are over; to be called after each tick."""
        if self._episode != (sim, sim.episode):
            self._episode = sim, sim.episode
            self._ended_at.clear()
        for agent in sim.agents:
            if agent.done:
                self._ended_at.setdefault((agent.id, agent.episode), sim.world.time)

    def read(self, sim: ControlRequestor) -> float:
        """Return the time at which the episode was over, or the present time of the world."""
        self.note_ends(sim)
        if not self._ended_at:
            return sim.world.time
        players = [agent for agent in sim.agents if has_driving_keys(agent)] or sim.agents
        ends = [self._ended_at.get((agent.id, agent.episode)) for agent in players]
        return max((sim.world.time if end is None else end) for end in ends)


class StartWait:
    """State of a wait on an episode's first frame, until a person presses a key.

    Nobody loses time while looking at a new start: the whole world stands still, opponents and
    clocks included. The world's thread calls the methods; any thread may read :attr:`is_waiting`.

    Args:
        is_enabled: False never waits; True waits where the world's ``wait_for_key`` says so.
    """

    def __init__(self, *, is_enabled: bool) -> None:
        self._is_enabled = is_enabled
        self._begun: tuple[ControlRequestor, int] | None = None
        self.is_waiting = False
        """True if the world waited when it was last asked about."""

    def update(self, sim: ControlRequestor) -> bool:
        """Return True if a world waits now."""
        self.is_waiting = (
            self._is_enabled
            and sim.wait_for_key
            and sim.world.ticks == 0
            and self._begun != (sim, sim.episode)
            and any(has_driving_keys(agent) for agent in sim.agents)
        )
        return self.is_waiting

    def reason(self, sim: ControlRequestor, *, is_held: bool, has_error: bool) -> str:
        """Return what a world waits for now; see :attr:`Snapshot.waiting`."""
        is_for_key = self.update(sim)
        if is_held:
            return "teacher"
        return "key" if is_for_key and not has_error else ""

    def begins(self, sim: ControlRequestor) -> bool:
        """Return True if a world waits now and did not before."""
        was_waiting = self.is_waiting
        return self.update(sim) and not was_waiting

    def end(self, sim: ControlRequestor) -> None:
        """Let a world's present episode run."""
        self._begun = (sim, sim.episode)
