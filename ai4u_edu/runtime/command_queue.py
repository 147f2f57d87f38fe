"""Commands for the thread that runs a world, in the order in which they came."""

import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, TypeVar

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class QueuedCommand:
    """A command that waits."""

    asked_at: float
    """When it came (s)."""
    run: Callable[[], Any]
    future: "Future[Any]"


class CommandQueue:
    """A queue of commands that ends for good when it is closed.

    Any thread may submit. The thread that runs the world takes; it is woken by ``wake``, and never
    waits for anybody here.

    Args:
        clock: seconds.
        wake: set when a command has come.
    """

    def __init__(self, clock: Callable[[], float], wake: threading.Event) -> None:
        self._clock = clock
        self._wake = wake
        self._lock = threading.Lock()
        self._commands: deque[QueuedCommand] = deque()
        self._is_closed = False

    def __len__(self) -> int:
        return len(self._commands)

    @property
    def first(self) -> QueuedCommand | None:
        """The command that is next; None if none waits."""
        return self._commands[0] if self._commands else None

    def submit(self, run: Callable[[], T]) -> "Future[T]":
        """Add a command; its future is cancelled if the queue is closed."""
        future: Future[T] = Future()
        with self._lock:
            if not self._is_closed:
                self._commands.append(QueuedCommand(self._clock(), run, future))
                self._wake.set()
                return future
        future.cancel()
        return future

    def take(self) -> QueuedCommand | None:
        """Remove the first command that nobody has cancelled, and mark it as running."""
        while self._commands:
            command = self._commands.popleft()
            if command.future.set_running_or_notify_cancel():
                return command
        return None

    def close(self) -> None:
        """Cancel what waits, and all that comes from now on."""
        with self._lock:
            self._is_closed = True
            waiting = list(self._commands)
            self._commands.clear()
        for command in waiting:
            command.future.cancel()
