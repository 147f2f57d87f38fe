"""A process that asks itself to end, and notices that the one that started it has ended."""

import os
import signal
import sys

import psutil


def ask_to_end() -> None:
    """Send SIGTERM to this process, so that its handler ends what it serves.

    On Windows ``os.kill`` would end the process at once, without its handlers.
    """
    if sys.platform == "win32":
        signal.raise_signal(signal.SIGTERM)
    else:  # to the process and not to this thread, so that the main thread wakes up
        os.kill(os.getpid(), signal.SIGTERM)


def has_ended(parent: psutil.Process | None) -> bool:
    """Return True if the process that started this one is no longer its parent.

    Args:
        parent: what ``psutil.Process().parent()`` returned at the start; None if it had ended by
            then. Windows goes on naming a parent that has ended.
    """
    if parent is None:
        return True
    return not parent.is_running() or psutil.Process().ppid() != parent.pid
