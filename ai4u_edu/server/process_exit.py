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


def limit_exit(seconds: float = EXIT_S) -> None:
    """End the process, as if all were well, if it has not ended by itself by then."""
    timer = threading.Timer(seconds, exit_at_once)
    timer.daemon = True
    timer.start()


def exit_at_once() -> NoReturn:
    """End the process without waiting for any thread; the exit status is that of a normal end."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):  # whoever read them may have gone
            stream.flush()
    os._exit(0)
