"""Between an event loop and other threads: a queue of calls for the loop, and waits for results.

Waking a loop takes a system call, at which Python lets other threads run first. A tick in which a
hundred agents sense would be interrupted a hundred times. So the loop is woken once for everything
that is in the queue by then.
"""

import asyncio
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from threading import get_ident
from typing import Any, TypeVar

T = TypeVar("T")

MAX_CALLS_AT_ONCE = 16
"""Calls that are made in a row before the loop's other tasks have their turn."""


class LoopQueue:
    """Calls for the running event loop, made in their order in its thread.

    Any thread may call :meth:`call`; all else belongs to the loop.
    """

    def __init__(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._thread = get_ident()
        self._calls: deque[tuple[Callable[[Any], None], Any]] = deque()
        self._is_scheduled = False

    def is_running_loop(self) -> bool:
        """Return True in the loop that this queue is for."""
        return self._loop is asyncio.get_running_loop()

    def call(self, function: Callable[[Any], None], argument: object) -> None:
        """Call a function in the loop: at once in its own thread if the queue is empty.

        Raises:
            RuntimeError: the loop is closed.
        """
        if not self._calls and get_ident() == self._thread:
            function(argument)
            return
        self._calls.append((function, argument))
        if not self._is_scheduled:
            self._is_scheduled = True
            self._loop.call_soon_threadsafe(self._make_calls)

    def _make_calls(self) -> None:
        self._is_scheduled = False  # first: a call that is added from here on schedules again
        try:
            for _ in range(min(MAX_CALLS_AT_ONCE, len(self._calls))):
                function, argument = self._calls.popleft()
                function(argument)
        finally:
            if self._calls and not self._is_scheduled:
                self._is_scheduled = True
                self._loop.call_soon(self._make_calls)


def queue_here(queue: LoopQueue | None) -> LoopQueue:
    """Return the queue if it is for the running loop, else a new one."""
    return queue if queue is not None and queue.is_running_loop() else LoopQueue()


async def result_of(future: "Future[T]") -> T:
    """Return a future's result, or raise its error.

    The other thread goes on if the wait is cancelled, since the page has left. Nobody asks for the
    error then; asyncio would write it into the log as one that was forgotten.
    """
    wrapped = asyncio.wrap_future(future)
    wrapped.add_done_callback(lambda done: done.cancelled() or done.exception())
    return await asyncio.shield(wrapped)
