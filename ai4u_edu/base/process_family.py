"""Processes that end with the one that started them, and processes that are ended with theirs."""

import ctypes
import os
import signal
import sys
from contextlib import suppress

import psutil

PR_SET_PDEATHSIG = 1
PR_SET_CHILD_SUBREAPER = 36
MAX_ROUNDS = 100
"""Rounds in which the descendants of a process are ended: some may start others meanwhile."""
ROUND_S = 0.05
"""Time that the system has in a round to remove those that were killed."""


def end_with_parent(parent: int, number: int = 0) -> None:
    """Have the system send this process a signal when the thread that started it ends; on Linux.

    If that has happened already, the signal comes at once.

    Args:
        parent: id of the process that started this one; 0 if it can't be seen from here.
        number: of the signal; by default SIGKILL.
    """
    if sys.platform.startswith("linux"):
        number = number or signal.SIGKILL
        _prctl(PR_SET_PDEATHSIG, int(number))
        if parent and os.getppid() != parent:  # it ended before the system knew of the wish
            os.kill(os.getpid(), number)


def adopt_orphans() -> None:
    """Become the parent of all descendants whose parents end, instead of init; on Linux."""
    if sys.platform.startswith("linux"):
        _prctl(PR_SET_CHILD_SUBREAPER, 1)


def kill_descendants(process: psutil.Process) -> None:
    """Kill all that a process has started, and what those have started.

    A process whose parent has ended is found only if it was adopted, see :func:`adopt_orphans`.
    """
    for _ in range(MAX_ROUNDS):
        try:
            family = process.children(recursive=True)
        except psutil.Error:  # it has ended itself
            return
        alive = [each for each in family if _is_alive(each)]
        for each in alive:
            with suppress(psutil.Error):
                each.kill()
        if not alive:
            return
        psutil.wait_procs(alive, ROUND_S)


def _is_alive(process: psutil.Process) -> bool:
    try:
        return bool(process.status() != psutil.STATUS_ZOMBIE)
    except psutil.Error:
        return False


def _prctl(option: int, value: int) -> None:
    # a system without it has no error to tell: the other ways to end a process stay
    ctypes.CDLL(None, use_errno=True).prctl(option, value, 0, 0, 0)
