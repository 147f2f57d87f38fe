"""Processes and threads that tests look for."""

import threading
from contextlib import suppress

import psutil


def command_line(process: psutil.Process) -> str:
    """Return what a process was started with; empty for one that has ended.

    The child of another test may end between two looks, or have ended without a parent that waits.
    """
    with suppress(psutil.NoSuchProcess):  # a zombie is one
        return " ".join(process.cmdline())
    return ""


def children_that_run(module: str, parent: psutil.Process | None = None) -> list[psutil.Process]:
    """Return the children that run a module.

    Args:
        module: its full name.
        parent: of the children; default: this process.
    """
    children = (parent or psutil.Process()).children()
    return [each for each in children if module in command_line(each)]


def is_server(process: psutil.Process) -> bool:
    """Return True if a process waits for connections; False for one that has ended."""
    return bool(ports_of(process))


def ports_of(process: psutil.Process) -> set[int]:
    """Return the ports of this machine at which a process waits; none for one that has ended."""
    with suppress(psutil.NoSuchProcess):
        connections = process.net_connections("tcp")
        return {each.laddr.port for each in connections if each.status == psutil.CONN_LISTEN}
    return set()


def is_own_thread() -> bool:
    """Return False in a thread that another test left behind with its world."""
    return threading.current_thread() is threading.main_thread()
