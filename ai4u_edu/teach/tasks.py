"""Tasks that take another process: one of this world's own, or one of the class's.

A room on a class's machine may start no process. It puts what is needed into a folder, asks the
class, and finds the notes of the class's process there.
"""

import threading
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Protocol

from msgspec import Struct

from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.editor import ClassTrainings
from ai4u_edu.teach.background import send_request, start_process
from ai4u_edu.teach.learning import STOPPED, UNREACHABLE
from ai4u_edu.wire.class_link import TaskKind

FOLDER = "tasks"
"""Folder of tasks in that of a class's room."""
REQUEST, NOTES = "request.json", "notes"
"""Files in a task's folder: what is asked for, and lines of JSON about what came of it."""
MODULES: dict[TaskKind, str] = {
    "open": "ai4u_edu.teach.open_process",
    "try": "ai4u_edu.teach.try_process",
}
POLL_S = 0.5
"""Interval at which the notes are read."""


class TaskWork(Protocol):
    """Work on a task. Any thread may call its methods; one iterates over the notes."""

    @property
    def waiting(self) -> str:
        """Sentence about what it waits for; empty if it works or has ended."""

    @property
    def problem(self) -> str:
        """Sentence about why it was ended; empty if it was not."""

    def notes(self) -> Iterator[Sequence[bytes]]:
        """Begin, and yield all lines so far whenever there are more, until the work has ended."""

    def stop(self, problem: str = STOPPED) -> None:
        """End it, with a sentence about why."""

    def leave(self) -> None:
        """Leave it to a later process of this world; end it if it can't go on without this one."""


class LocalTask:
    """Task in a process of this one's.

    Args:
        kind: of the task.
        request: for the process.
        max_wall_s: time after which it is ended, for a process without a limit of its own.
    """

    waiting = ""

    def __init__(self, kind: TaskKind, request: Struct, max_wall_s: float | None = None) -> None:
        self._request, self.problem = request, ""
        self._max_wall_s = max_wall_s
        self._process = start_process(MODULES[kind])

    def notes(self) -> Iterator[Sequence[bytes]]:
        """Begin, and yield all lines so far whenever there are more, until the work has ended."""
        process, lines = self._process, list[bytes]()
        timer = threading.Timer(self._max_wall_s or threading.TIMEOUT_MAX, process.kill)
        if self._max_wall_s is not None:
            timer.start()
        with process, suppress(OSError):  # it has ended already
            send_request(process, self._request)
            assert process.stdout is not None  # noqa: S101 - start_process asks for the pipe
            for line in process.stdout:
                lines.append(line)
                yield lines
        timer.cancel()

    def stop(self, problem: str = STOPPED) -> None:
        """End it, with a sentence about why."""
        self.problem = problem
        self._process.kill()

    leave = stop


class ClassTask:
    """Task in the class's process, which works in the task's folder.

    Args:
        kind: of the task.
        trainings: of the class.
        folder: of the task, with its request; the class's process has it, too.
    """

    def __init__(self, kind: TaskKind, trainings: ClassTrainings, folder: Path) -> None:
        self._trainings, self._folder, self._key = trainings, folder, folder.name
        self._is_left = threading.Event()
        trainings.begin_task(self._key, kind)

    @property
    def waiting(self) -> str:
        """Sentence about what it waits for; empty if it works or has ended."""
        task = self._trainings.task(self._key)
        if task is None or task.is_over:
            return ""
        if not self._trainings.is_connected:
            return UNREACHABLE
        return _("Your place in the line: {place}.", place=task.place) if task.place else ""

    @property
    def problem(self) -> str:
        """Sentence about why it was ended; empty if it was not."""
        task = self._trainings.task(self._key)
        return "" if task is None else task.problem

    def notes(self) -> Iterator[Sequence[bytes]]:
        """Yield all lines so far whenever there are more, until the work has ended."""
        before = b""
        while not self._is_left.is_set():
            is_over = self._is_over  # asked first, so that no line is missed
            text = b""
            with suppress(OSError):
                text = (self._folder / NOTES).read_bytes()
            if text != before:
                before = text
                yield text.split(b"\n")[:-1]  # the last one may not be whole yet
            if is_over:
                return
            self._is_left.wait(POLL_S)

    def stop(self, problem: str = STOPPED) -> None:
        """End it, with a sentence about why."""
        with suppress(OSError):  # so that no later process of the room or the class goes on
            (self._folder / REQUEST).unlink(missing_ok=True)
        self._trainings.stop_task(self._key, problem)

    def leave(self) -> None:
        """Leave it to a later process of the room."""
        self._is_left.set()

    @property
    def _is_over(self) -> bool:
        task = self._trainings.task(self._key)
        return task is None or task.is_over
