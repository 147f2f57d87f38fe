"""Lets threads wake late, in each Python whose ``PYTHONPATH`` has this folder.

On a busy machine others go on between an event and the thread that waits for it. Here that happens
often, and on an idle machine: a thread pauses now and then after it waited, after it woke others,
after it got bytes, as it begins and as it ends. ``python -m tests.stability --late`` starts the
tests with it, and they hand it on to the processes that they start.
"""

import asyncio
import functools
import os
import random
import socket
import threading
import time
from collections.abc import Callable
from typing import Any

SHARE = 0.3
"""Part of these places where a thread pauses."""
LONGEST_S = 0.2
"""Time (s) of the longest pause."""
STEP_SHARE = SHARE / 30
"""Part of the steps of an event loop: all of its tasks wait for each."""

chance = random.Random(os.getpid())


def pause(share: float) -> None:
    """Pause now and then."""
    if chance.random() < share:
        # real time: that others are late is what this is for
        time.sleep(chance.random() * LONGEST_S)


def make_late(owner: type, name: str, *, before: float = 0.0, after: float = SHARE) -> None:
    """Have a method pause now and then before it does its work, and after that."""
    method: Callable[..., Any] = getattr(owner, name)

    def paused(*args: Any, **kwargs: Any) -> Any:
        pause(before)
        try:
            return method(*args, **kwargs)
        finally:
            pause(after)

    # what tells where a thread hangs names the method's file, as it does without this
    paused.__code__ = paused.__code__.replace(co_filename=method.__code__.co_filename)
    setattr(owner, name, functools.update_wrapper(paused, method))


class LateSocket(socket.socket):
    """Socket whose reader gets its bytes late if it waits for them."""

    def recv(self, *args: int) -> bytes:
        """Receive as a socket does."""
        received = super().recv(*args)
        if self.gettimeout() != 0:  # an event loop's step pauses by itself
            pause(SHARE)
        return received


make_late(threading.Condition, "wait")
make_late(threading.Event, "set")
make_late(threading.Thread, "run", before=SHARE)
make_late(asyncio.Handle, "_run", after=STEP_SHARE)
# all that makes sockets later gets this one
socket.socket = LateSocket  # type: ignore[misc]
