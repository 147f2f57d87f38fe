"""Limits of what an entry may use in a game."""

import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import unpacked

if sys.platform != "win32":
    import resource

LOAD_CPU_S = 5.0
"""Processor time in which a network is loaded: onnxruntime computes what depends on nothing."""
DECISION_CPU_S = 1.0
"""Processor time of one decision."""
GAME_CPU_S = 60.0
"""Processor time of all decisions of a game."""
MEMORY_BYTES = 2**31
"""Memory that a game may take beyond what its process has (on Linux)."""
CHECK_INTERVAL_S = 0.1
CPU_TIME = _("s of processor time")


class CpuMeter:
    """Measures the processor time of an entry's decisions, and ends one that takes too long.

    Wall time does not count: other programs on the machine take nothing from an entry.

    Args:
        stop: called in another thread if a decision has taken too long and is still under way.
    """

    def __init__(self, stop: Callable[[], object]) -> None:
        self._stop = stop
        self._began: float | None = None
        self._used_s = 0.0
        self._has_stopped = False
        self._ended = threading.Event()
        self._thread: threading.Thread | None = None

    @contextmanager
    def measuring(self) -> Iterator[None]:
        """Measure a decision.

        Raises:
            OverTimeError: it took too long, or the entry did in this game.
        """
        if self._thread is None:
            self._thread = threading.Thread(target=self._watch, name="cpu meter", daemon=True)
            self._thread.start()
        began = time.thread_time()
        self._began = time.process_time()
        try:
            yield
        finally:
            self._began = None
            used = time.thread_time() - began
            self._used_s += used
            # also in place of the error of a network that was stopped
            if self._has_stopped or used > DECISION_CPU_S:
                raise OverTimeError(over_time(max(used, DECISION_CPU_S)))
            if self._used_s > GAME_CPU_S:
                raise OverTimeError(over_game_time())

    def close(self) -> None:
        """End the thread; it has ended when this returns."""
        self._ended.set()
        if self._thread is not None:
            self._thread.join()

    def _watch(self) -> None:
        while not self._ended.wait(CHECK_INTERVAL_S):
            # in this order: if this thread stands still in between, the difference is too small,
            # and not that between the end of a decision and the beginning of another one
            now = time.process_time()
            began = self._began
            if began is not None and now - began > DECISION_CPU_S:
                self._has_stopped = True
                self._stop()


class OverTimeError(Exception):
    """An entry took more processor time than it may."""


def over_time(used_s: float) -> str:
    """Return the sentence on a decision that took too long."""
    return _(
        "it took {used_s:.1f} {cpu_time} for a decision; expected at most {decision_cpu_s:g} s",
        used_s=used_s,
        cpu_time=CPU_TIME,
        decision_cpu_s=DECISION_CPU_S,
    )


def is_over_time(reason: str) -> bool:
    """Return True if an entry failed by processor time, which is not the same twice."""
    return CPU_TIME in unpacked(reason)


def over_load_time() -> str:
    """Return the sentence on a network that took too long to load."""
    return _(
        "it took more than {load_cpu_s:g} {cpu_time} to load",
        load_cpu_s=LOAD_CPU_S,
        cpu_time=CPU_TIME,
    )


def over_game_time() -> str:
    """Return the sentence on a game that took too long."""
    return _(
        "it took more than {game_cpu_s:g} {cpu_time} in one game",
        game_cpu_s=GAME_CPU_S,
        cpu_time=CPU_TIME,
    )


@contextmanager
def memory_limit() -> Iterator[None]:
    """Limit the memory of this process beyond what it has; an allocation of more raises an error.

    It holds on Linux only.
    """
    if not sys.platform.startswith("linux"):
        yield
        return
    pages = int(Path("/proc/self/statm").read_text("ascii").split()[0])
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    wanted = pages * resource.getpagesize() + MEMORY_BYTES
    if soft != resource.RLIM_INFINITY:
        wanted = min(wanted, soft)
    resource.setrlimit(resource.RLIMIT_AS, (wanted, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
