"""Processes that tests look for."""

from contextlib import suppress

import psutil


def command_line(process: psutil.Process) -> str:
    """Return what a process was started with; empty for one that has ended.

    The child of another test may end between two looks, or have ended without a parent that waits.
    """
    with suppress(psutil.NoSuchProcess):  # a zombie is one
        return " ".join(process.cmdline())
    return ""
