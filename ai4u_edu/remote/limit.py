"""How long a task waits at most."""

import asyncio
from types import TracebackType
from typing import Any, Self


class Limit:
    """Ends a wait as :func:`asyncio.timeout` does, but one timer serves many waits.

    A script waits thousands of times a second, and hardly ever in vain; a timer for each wait is a
    seventh of what such a script costs. For one task at a time, of the loop that runs now::

        with limit.of(0.2):
            await something
    """

    def __init__(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._timer: asyncio.TimerHandle | None = None
        self._task: asyncio.Task[Any] | None = None
        self._until = 0.0
        self._cancels = 0
        self._has_cancelled = False

    def of(self, seconds: float) -> Self:
        """So many seconds from now on; then it raises a TimeoutError."""
        self._until = self._loop.time() + seconds
        return self

    def __enter__(self) -> None:
        self._task = task = asyncio.current_task()
        self._cancels, self._has_cancelled = task.cancelling() if task else 0, False
        if self._timer is not None and self._timer.when() > self._until:
            self._timer.cancel()
            self._timer = None
        if self._timer is None:
            self._timer = self._loop.call_at(self._until, self._ring)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        _: TracebackType | None,
    ) -> None:
        task, self._task = self._task, None
        if not self._has_cancelled or task is None:
            return
        # another's wish to cancel it counts for more
        if task.uncancel() <= self._cancels and kind is asyncio.CancelledError:
            raise TimeoutError from error

    def _ring(self) -> None:
        self._timer = None
        if self._task is None:
            return
        if self._loop.time() < self._until:  # it was set for a wait before this one
            self._timer = self._loop.call_at(self._until, self._ring)
        else:
            self._has_cancelled = True
            self._task.cancel()
