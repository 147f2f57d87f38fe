"""A queue of commands for the thread that runs a world."""

import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, TypeVar

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class QueuedCommand:
    """A command that waits, and the future of its result."""

    asked_at: float
    """Time (s) at which it was submitted."""
    run: Callable[[], Any]
    future: "Future[Any]"


class CommandQueue:
    """A first-in, first-out queue of commands that can be closed for good.

    Any thread may submit. The world's thread takes and never blocks here; ``wake`` wakes it.

    Args:
        clock: seconds.
        wake: set when a command was submitted.
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
        """The command that has waited longest; None if none waits."""
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
        """Cancel the commands that wait, and all that are submitted from now on."""
        with self._lock:
            self._is_closed = True
            waiting = list(self._commands)
            self._commands.clear()
        for command in waiting:
            command.future.cancel()
