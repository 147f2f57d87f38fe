"""Priority of a process that is to leave the processor to others."""

import sys

import psutil

if sys.platform == "win32":
    NICENESS = psutil.BELOW_NORMAL_PRIORITY_CLASS
else:
    NICENESS = 10


def lower_priority() -> None:
    """Let other processes come first; it holds for processes that this one starts, too."""
    psutil.Process().nice(NICENESS)
