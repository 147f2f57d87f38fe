"""Exit of a process that has served a world, within seconds.

For commands only, which own their process. Python joins threads and thread pools at exit, however
long they take: a picture that is being drawn, a block in an endless loop. And a thread in a neural
network's C++ code may crash the process then.
"""

import os
import sys
import threading
from contextlib import suppress
from typing import NoReturn

EXIT_S = 1.5
"""Time that a process has to exit by itself after it has stopped serving."""

HAS_SERVED = threading.Event()
"""Event that a command sets when it has served a world and is about to return."""


def end_process(status: int) -> None:
    """Make a process that has served exit soon; called last, by its entry point.

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
        with suppress(OSError, ValueError):  # the reader may have closed them
            stream.flush()
    os._exit(status)
