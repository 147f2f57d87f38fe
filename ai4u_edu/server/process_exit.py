"""The end of a process that serves: within seconds, whatever still runs in it.

For commands only, which own their process. Python joins threads and thread pools when it ends,
however long they take: a picture that is being drawn, a block in an endless loop. And a thread that
is in a network's C++ code then may have the process crash.
"""

import os
import sys
import threading
from contextlib import suppress
from typing import NoReturn

EXIT_S = 1.5
"""Seconds that a process has to end by itself once nobody is served any more."""

HAS_SERVED = threading.Event()
"""Set by a command that has served a world, and is about to return."""


def end_process(status: int) -> None:
    """See to it that a process that has served ends soon; called last, by its entry point.

    Args:
        status: the exit status.
    """
    if not HAS_SERVED.is_set():
        return
    if any(thread.name == "runner" for thread in threading.enumerate()):
        exit_at_once(status)  # a block does not return
    timer = threading.Timer(EXIT_S, exit_at_once, (status,))
    timer.daemon = True
    timer.start()


def exit_at_once(status: int) -> NoReturn:
    """End the process without waiting for any thread."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):  # whoever read them may have gone
            stream.flush()
    os._exit(status)
