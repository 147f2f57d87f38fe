"""Limits of a room's process, and the checks that end one which breaks them."""

import os
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import httpx
import psutil

from ai4u_edu.classroom.room_host import RoomAddress
from ai4u_edu.locale import gettext as _

MB = 2**20
BUSY_SHARE = 0.6
"""Share of a core above which a process gets a lower priority than the others."""
BUSY_NICENESS, NICENESS = 10, 3
"""Priorities of a busy process and of the others; the class itself has 0."""
MAX_ROOM_FILE_BYTES = 64 * MB
"""Largest file that a room may write."""


@dataclass(frozen=True)
class RoomLimits:
    """Limits of one room's process."""

    sleep_after_s: float = 300.0
    """Time without a page or a script after which the process ends; 0: it never does."""
    max_memory_mb: float = 600.0
    """Memory (MB) above which the process is restarted."""
    answer_timeout_s: float = 20.0
    """Time without an answer after which the process is restarted, less the time for which its
    threads had no processor (on Linux); what it computed counts in any case."""
    check_s: float = 2.0
    """Interval between two checks."""
    ask_s: float = 8.0
    """Interval between two requests for a sign of life, while the room is in use."""
    start_timeout_s: float = 60.0
    """Time in which the process has to serve its room."""
    end_timeout_s: float = 5.0
    """Time in which the process saves what was made, and ends; then it is killed."""


class RoomWatch:
    """Checks of one process.

    Args:
        pid: of the process.
        limits: to hold it to.
        clock: returns seconds; to be replaced in tests.
        queue_clock: returns the time (s) for which each thread of the process has waited for a
            processor, by its id; to be replaced in tests.
    """

    def __init__(
        self,
        pid: int,
        limits: RoomLimits,
        clock: Callable[[], float] = time.monotonic,
        queue_clock: Callable[[int], dict[int, float]] | None = None,
    ) -> None:
        self._process, self._limits, self._clock = psutil.Process(pid), limits, clock
        self._queue_clock = queue_clock or time_in_queue
        self._asked_at, self._is_asking = -limits.ask_s, False
        self._unanswered_since: float | None = None
        self._queued_before: dict[int, float] = {}
        self._computed_before = 0.0
        self._is_busy = False
        self._max_file_bytes = MAX_ROOM_FILE_BYTES
        with suppress(psutil.Error):
            self._process.cpu_percent()  # measures from here on
        self._set_niceness(NICENESS)

    def broken_limit(self) -> str:
        """Return a sentence about the limit that the process breaks; empty if it breaks none.

        A process that computes much gets a lower priority: the other rooms go first.
        """
        try:
            memory_mb = self._process.memory_info().rss / MB
            share = self._process.cpu_percent() / 100
            computed_s = self._computed_s() - self._computed_before
        except psutil.Error:  # it has ended
            return ""
        if memory_mb > self._limits.max_memory_mb:
            return _(
                "Your world used {memory_mb:.0f} MB of memory, more than the {most:.0f} MB "
                "that it may. It starts again with its last scene; make that smaller.",
                memory_mb=memory_mb,
                most=self._limits.max_memory_mb,
            )
        since = self._unanswered_since
        if since is not None:
            waited_s = self._clock() - since
            # A process that gets no processor is not to blame, and to start another one costs more.
            # Where threads wait side by side, their sum is longer than what passed.
            own_s = max(waited_s - self._queued_s(), min(computed_s, waited_s))
            if own_s > self._limits.answer_timeout_s:
                return _("Your world did not answer any more. It starts again with its last scene.")
        if (share > BUSY_SHARE) != self._is_busy:
            self._is_busy = not self._is_busy
            self._set_niceness(BUSY_NICENESS if self._is_busy else NICENESS)
        return ""

    def limit_files(self, *, is_full: bool) -> None:
        """Let the process write no more to files while the class's folder is full (on Linux)."""
        limit = 0 if is_full else MAX_ROOM_FILE_BYTES
        if sys.platform == "linux" and limit != self._max_file_bytes:
            with suppress(psutil.Error, OSError, ValueError):
                _, hard = self._process.rlimit(psutil.RLIMIT_FSIZE)
                self._process.rlimit(psutil.RLIMIT_FSIZE, (limit, hard))
                self._max_file_bytes = limit

    async def ask(self, client: httpx.AsyncClient, url: str, address: RoomAddress) -> None:
        """Ask the process for a sign of life, if that is due, and wait for it.

        On a machine that has too much to do an answer comes late, and is a sign of life, too. So
        this waits until the answer comes or the process ends, and does not ask again meanwhile.
        """
        now = self._clock()
        if self._is_asking or now - self._asked_at < self._limits.ask_s:
            return
        self._asked_at = now
        if self._unanswered_since is None:
            self._unanswered_since = now
            self._queued_before = self._queue_clock(self._process.pid)
            with suppress(psutil.Error):
                self._computed_before = self._computed_s()
        headers = {"Authorization": f"Bearer {address.token}"}
        self._is_asking = True
        try:
            with suppress(httpx.HTTPError):
                await client.get(url, headers=headers, timeout=None)
                self._unanswered_since = None
        finally:
            self._is_asking = False

    def _queued_s(self) -> float:
        """Return how long (s) all threads together had no processor since the request.

        They take turns: one that waits for Python's lock sleeps, and stands in no queue, while the
        one that has the lock waits for a processor.
        """
        before = self._queued_before
        now = self._queue_clock(self._process.pid)
        return sum(now[thread] - before.get(thread, 0.0) for thread in now)

    def _computed_s(self) -> float:
        times = self._process.cpu_times()
        return times.user + times.system

    def _set_niceness(self, niceness: int) -> None:
        # lowering it again needs rights that a teacher's account may lack
        with suppress(psutil.Error, OSError):
            if sys.platform == "win32":
                self._process.nice(_windows_class(niceness))
            elif sys.platform == "linux":  # each thread has its own; a new one takes its maker's
                done: set[int] = set()
                while found := {each.id for each in self._process.threads()} - done:
                    for thread in found:
                        with suppress(ProcessLookupError):  # it has ended
                            os.setpriority(os.PRIO_PROCESS, thread, niceness)
                    done |= found
            else:
                self._process.nice(niceness)


def time_in_queue(pid: int) -> dict[int, float]:
    """Return how long (s) each thread of a process has waited for a processor, by thread id.

    Empty where the system does not tell (it is Linux's ``schedstat``), and for a process that has
    ended.
    """
    waited: dict[int, float] = {}
    for path in Path(f"/proc/{pid}/task").glob("*/schedstat"):
        with suppress(OSError, ValueError, IndexError):  # the thread has ended
            waited[int(path.parent.name)] = int(path.read_text().split()[1]) / 1e9
    return waited


def _windows_class(niceness: int) -> int:
    below: int = getattr(psutil, "BELOW_NORMAL_PRIORITY_CLASS", niceness)
    normal: int = getattr(psutil, "NORMAL_PRIORITY_CLASS", niceness)
    return below if niceness == BUSY_NICENESS else normal


def limit_own_files() -> None:
    """Limit the size of files that this process writes, where the system can do that."""
    if sys.platform == "win32":
        return
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    limit = (
        MAX_ROOM_FILE_BYTES if hard == resource.RLIM_INFINITY else min(MAX_ROOM_FILE_BYTES, hard)
    )
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, hard))
