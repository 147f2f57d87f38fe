"""Tasks in the class's process, for the rooms of its machine: networks in files, and many values.

What a task needs lies in a folder of its room, and its notes are put there. A room may start no
process, and sleeps while nobody uses it: it finds the notes later.
"""

import asyncio
import subprocess
import threading
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import msgspec
from msgspec import Struct
from msgspec.structs import replace

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.blocks.loading import own_files
from ai4u_edu.classroom.room_queue import QueueRow, RoomQueue
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import packed
from ai4u_edu.teach.background import cpu_s, send_request, start_process
from ai4u_edu.teach.opened_network import FILE, OpenRequest
from ai4u_edu.teach.tasks import FOLDER, MODULES, NOTES, REQUEST
from ai4u_edu.teach.tries import TryNote, TryRequest
from ai4u_edu.wire.class_link import Task, TaskKind, TaskState

MAX_CPU_S: Mapping[TaskKind, float] = {"open": 60.0, "try": 600.0}
"""Processor time of one task; the process of an ``open`` has a shorter limit of its own."""
POLL_S = 0.2
"""Interval at which the processes are looked at."""
TOO_MANY = _("this world has such a task already; wait until it is done")


@dataclass(eq=False)
class _TaskRow(QueueRow[TaskState, "_TaskProcess"]):
    """A room's task."""

    total: int = 1
    """Episodes that it takes, if it tries values."""
    done: int = 0
    """Episodes that were driven."""


class TaskQueue(RoomQueue[_TaskRow, TaskState]):
    """Tasks of all rooms: one of each kind at a time.

    Files are opened in the order in which they came, tries with the fewest episodes come first.
    A task is not on disk here: after a restart of the class its room asks again, and values that
    were tried before are not tried once more.
    """

    _poll_s = POLL_S

    def sentence(self, room: str) -> str:
        """Return how the tries of a room go; empty if nothing is tried."""
        for row in self._open(room):
            if row.state.kind == "try":
                if row.state.place:
                    return _("waits to try values, place {place}", place=row.state.place)
                return _("tries values, {done} of {total} episodes", done=row.done, total=row.total)
        return ""

    async def add(self, room: str, request: Task) -> None:
        """Take a room's request; one that is there is told again."""
        if request.key not in self._rows:
            has_one = any(row.state.kind == request.kind for row in self._open(room))
            row = _TaskRow(room, TaskState(request.key, request.kind))
            await self._take(row, TOO_MANY if has_one else "")
        self._tell(room)

    def _lines(self) -> Iterable[list[_TaskRow]]:
        return map(self._waiting, MODULES)

    def _waiting(self, kind: TaskKind) -> list[_TaskRow]:
        """Return those of a kind that wait, the next one first."""
        rows = [row for row in self._open() if row.state.kind == kind and row.process is None]
        return sorted(rows, key=lambda row: row.total - row.done)

    async def _round(self, rows: list[_TaskRow]) -> None:
        for row in rows:
            await self._follow(row)
        for kind in MODULES:
            await self._schedule(kind)

    async def _follow(self, row: _TaskRow) -> None:
        """Look whether a process has ended, or must."""
        process = row.process
        if process is None or row.is_ending:
            return
        max_cpu_s = MAX_CPU_S[row.state.kind]
        if not process.is_running:
            await self._end_row(row, "")
        elif process.cpu_s() > max_cpu_s:
            await self._end_row(
                row,
                _(
                    "it has used all its processor time, {minutes:g} minutes",
                    minutes=max_cpu_s / 60,
                ),
            )
        else:
            done = row.done
            await asyncio.to_thread(self._look, row)
            if row.done != done:
                self._note_change()

    async def _schedule(self, kind: TaskKind) -> None:
        """Begin with the next one of a kind, if none is under way."""
        if any(row.state.kind == kind and row.process is not None for row in self._rows.values()):
            return
        for row in self._waiting(kind):
            if await self._begin(row):
                return

    # -- in threads --------------------------------------------------------------------------------

    def _folder(self, row: _TaskRow) -> Path:
        """Return the folder of a task; the link takes no key with a separator of paths in it."""
        return self._store.room_folder(row.room).absolute() / FOLDER / row.state.key

    def _look(self, row: _TaskRow) -> None:
        if row.state.kind != "try":
            return
        with suppress(OSError, msgspec.MsgspecError):
            folder = self._folder(row)
            text = (folder / REQUEST).read_bytes()
            request = msgspec.json.decode(text, type=TryRequest)
            row.total = request.starts * len(request.values)
            row.done = len(_tried(folder)) * request.starts

    def _start(self, row: _TaskRow) -> "_TaskProcess":
        folder = self._folder(row)
        text, blocks = (folder / REQUEST).read_bytes(), [str(file) for file in own_files()]
        if row.state.kind == "open":
            opened = msgspec.json.decode(text, type=OpenRequest)
            opened = replace(opened, file=str(folder / FILE), blocks=blocks)
            return _TaskProcess(MODULES["open"], opened, folder / NOTES, [])
        request, tried = msgspec.json.decode(text, type=TryRequest), _tried(folder)
        request = replace(request, values=request.values[len(tried) :], blocks=blocks)
        return _TaskProcess(MODULES["try"], request, folder / NOTES, tried)


class _TaskProcess:
    """Process of a task, whose notes are put into a file as they come.

    Args:
        module: of the process.
        request: for the process.
        notes: the file; it is replaced.
        before: notes of an earlier process.

    Raises:
        OSError: the file can't be written.
    """

    def __init__(self, module: str, request: Struct, notes: Path, before: list[TryNote]) -> None:
        self._request, self._notes = request, notes
        write_atomically(notes, b"".join(map(_line, before)), mode=0o600)
        self._process: subprocess.Popen[bytes] = start_process(module)
        self._thread = threading.Thread(target=self._copy, name="task notes", daemon=True)
        self._thread.start()

    @property
    def is_running(self) -> bool:
        """True until the process has ended and all its notes are in the file."""
        return self._thread.is_alive()

    def cpu_s(self) -> float:
        """Return the processor time (s) that it has used; 0 after its end."""
        return cpu_s(self._process)

    def kill(self) -> None:
        """End it, and wait until it has ended."""
        self._process.kill()
        self._thread.join()

    def _copy(self) -> None:
        process = self._process
        with process, suppress(OSError):  # it has ended already, or the folder is gone
            send_request(process, self._request)
            assert process.stdout is not None  # noqa: S101 - start_process asks for the pipe
            for line in process.stdout:
                with self._notes.open("ab") as file:
                    file.write(line)


def _tried(folder: Path) -> list[TryNote]:
    """Return the notes about values that are done."""
    notes = list[TryNote]()
    with suppress(FileNotFoundError):
        for line in (folder / NOTES).read_bytes().split(b"\n")[:-1]:
            note = msgspec.json.decode(line, type=TryNote)
            notes += [] if note.row is None else [note]
    return notes


def _line(note: TryNote) -> bytes:
    return msgspec.json.encode(note, enc_hook=packed) + b"\n"
