"""Tasks in the class's process, for the rooms of its machine: networks in files, and many values.

What a task needs lies in a folder of its room, and its notes are put there. A room may start no
process, and sleeps while nobody uses it: it finds the notes later.
"""

import asyncio
import subprocess
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import msgspec
from msgspec import Struct
from msgspec.structs import replace

from ai4u_edu.base.atomic_write import reason, write_atomically
from ai4u_edu.base.errors import shorten
from ai4u_edu.blocks.loading import own_files
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.classroom.trainings import FULL
from ai4u_edu.teach.background import cpu_s, send_request, start_process
from ai4u_edu.teach.learning import STOPPED
from ai4u_edu.teach.opened_network import FILE, OpenRequest
from ai4u_edu.teach.tasks import FOLDER, MODULES, NOTES, REQUEST
from ai4u_edu.teach.tries import TryNote, TryRequest
from ai4u_edu.wire.class_link import Task, TaskKind, TaskState
from ai4u_edu.wire.validation import MAX_TEXT_CHARS

MAX_CPU_S: Mapping[TaskKind, float] = {"open": 60.0, "try": 600.0}
"""Processor time of one task; the process of an ``open`` has a shorter limit of its own."""
MAX_ENDED = 3
"""Tasks of a room that are over and still listed, so that it learns how they ended."""
POLL_S = 0.2
"""Interval at which the processes are looked at."""
MISSING = "its files are not there any more; try again"
TOO_LONG = "it has used all its processor time, {minutes:g} minutes"
TOO_MANY = "this world has such a task already; wait until it is done"


@dataclass(eq=False)
class _Row:
    """A room's task."""

    room: str
    state: TaskState
    total: int = 1
    """Episodes that it takes, if it tries values."""
    done: int = 0
    """Episodes that were driven."""
    process: "_TaskProcess | None" = None
    is_ending: bool = False
    """True from when its end is certain; its room learns of it when the process has ended."""

    @property
    def is_open(self) -> bool:
        return not (self.state.is_over or self.is_ending)


class TaskQueue:
    """Tasks of all rooms: one of each kind at a time.

    Files are opened in the order in which they came, tries with the fewest episodes come first.
    Belongs to the event loop. A task is not on disk here: after a restart of the class its room
    asks again, and values that were tried before are not tried once more.

    Args:
        store: of the class.
        tell_room: called with a room's id when one of its tasks has changed.
        note_change: called when the teacher's pages must be updated.
    """

    def __init__(
        self,
        store: ClassStore,
        tell_room: Callable[[str], object],
        note_change: Callable[[], object],
    ) -> None:
        self._store, self._tell_room, self._note_change = store, tell_room, note_change
        self._rows: dict[str, _Row] = {}
        self._task: asyncio.Task[None] | None = None

    def of_room(self, room: str) -> tuple[TaskState, ...]:
        """Return a room's tasks, the oldest first."""
        return tuple(row.state for row in self._rows.values() if row.room == room)

    def sentence(self, room: str) -> str:
        """Return how the tries of a room go; empty if nothing is tried."""
        for row in self._rows.values():
            if row.room == room and row.state.kind == "try" and row.is_open:
                if row.state.place:
                    return f"waits to try values, place {row.state.place}"
                return f"tries values, {row.done} of {row.total} episodes"
        return ""

    async def add(self, room: str, request: Task) -> None:
        """Take a room's request; one that is there is told again."""
        key, kind = request.key, request.kind
        if key not in self._rows:
            problem = ""
            if self._store.quota.is_full:
                problem = FULL
            elif any(row.room == room and row.state.kind == kind for row in self._open()):
                problem = TOO_MANY
            state = TaskState(key, kind, is_over=bool(problem), problem=problem)
            self._rows[key] = row = _Row(room, state)
            self._forget_ended(room)
            await asyncio.to_thread(self._look, row)
            self._place()
            self.tick()
        self._tell_room(room)
        self._note_change()

    async def stop(self, room: str, key: str = "", problem: str = STOPPED) -> bool:
        """End a task of a room that is not over; without a key, all of them.

        Returns:
            False if there was none.
        """
        rows = [row for row in self._open() if row.room == room and key in ("", row.state.key)]
        for row in rows:
            await self._end_row(row, problem)
        return bool(rows)

    def tick(self) -> None:
        """Begin with those that wait."""
        if self._task is None and self._open():
            self._task = asyncio.create_task(self._work())

    async def end(self) -> None:
        """End all processes and forget everything in memory, because it will be deleted."""
        rows, self._rows = [*self._rows.values()], {}
        for row in rows:
            row.is_ending = True
            await asyncio.to_thread(self._end_process, row)
        if self._task is not None:
            await asyncio.gather(self._task, return_exceptions=True)

    def _open(self) -> list[_Row]:
        return [row for row in self._rows.values() if row.is_open]

    def _waiting(self, kind: TaskKind) -> list[_Row]:
        """Return those of a kind that wait, the next one first."""
        rows = [row for row in self._open() if row.state.kind == kind and row.process is None]
        return sorted(rows, key=lambda row: row.total - row.done)

    # -- the task that looks after processes -------------------------------------------------------

    async def _work(self) -> None:
        try:
            while rows := self._open():
                for row in rows:
                    await self._follow(row)
                for kind in MODULES:
                    await self._schedule(kind)
                self._place()
                await asyncio.sleep(POLL_S)
        finally:
            self._task = None
            for row in self._rows.values():
                if row.process is not None:
                    row.process.kill()

    async def _follow(self, row: _Row) -> None:
        """Look whether a process has ended, or must."""
        process = row.process
        if process is None or row.is_ending:
            return
        max_cpu_s = MAX_CPU_S[row.state.kind]
        if not process.is_running:
            await self._end_row(row, "")
        elif process.cpu_s() > max_cpu_s:
            await self._end_row(row, TOO_LONG.format(minutes=max_cpu_s / 60))
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
            try:
                process = await asyncio.to_thread(self._start, row)
            except (OSError, msgspec.MsgspecError) as error:
                problem = MISSING
                if isinstance(error, OSError) and not isinstance(error, FileNotFoundError):
                    problem = f"it could not begin: {reason(error)}"
                await self._end_row(row, problem)
                continue
            row.process = process
            if not row.is_open or self._rows.get(row.state.key) is not row:  # stopped meanwhile
                await asyncio.to_thread(self._end_process, row)
                continue
            return

    async def _end_row(self, row: _Row, problem: str) -> None:
        """End a task; its room reads the notes in the folder."""
        row.is_ending = True
        await asyncio.to_thread(self._end_process, row)
        problem = shorten(problem, MAX_TEXT_CHARS)
        row.state = replace(row.state, place=0, is_over=True, problem=problem)
        self._forget_ended(row.room)
        self._place()
        self._tell_room(row.room)
        self._note_change()

    def _place(self) -> None:
        """Give all their places in the line, and tell the rooms for which they change."""
        places = {
            row.state.key: place
            for kind in MODULES
            for place, row in enumerate(self._waiting(kind), 1)
        }
        for row in self._open():
            place = places.get(row.state.key, 0)
            if place != row.state.place:
                row.state = replace(row.state, place=place)
                self._tell_room(row.room)
                self._note_change()

    def _forget_ended(self, room: str) -> None:
        rows = [row for row in self._rows.values() if row.room == room and row.state.is_over]
        for row in rows[:-MAX_ENDED]:
            del self._rows[row.state.key]

    # -- in threads --------------------------------------------------------------------------------

    def _folder(self, row: _Row) -> Path:
        """Return the folder of a task; the link takes no key with a separator of paths in it."""
        return self._store.folder.absolute() / "rooms" / row.room / FOLDER / row.state.key

    def _look(self, row: _Row) -> None:
        """Read what a task has done, if it tries values."""
        if row.state.kind != "try":
            return
        with suppress(OSError, msgspec.MsgspecError):
            folder = self._folder(row)
            text = (folder / REQUEST).read_bytes()
            request = msgspec.json.decode(text, type=TryRequest)
            row.total = request.starts * len(request.values)
            row.done = len(_tried(folder)) * request.starts

    def _start(self, row: _Row) -> "_TaskProcess":
        """Start the process of a task.

        Raises:
            OSError, MsgspecError: it can't begin.
        """
        folder = self._folder(row)
        text, blocks = (folder / REQUEST).read_bytes(), [str(file) for file in own_files()]
        if row.state.kind == "open":
            opened = msgspec.json.decode(text, type=OpenRequest)
            opened = replace(opened, file=str(folder / FILE), blocks=blocks)
            return _TaskProcess(MODULES["open"], opened, folder / NOTES, [])
        request, tried = msgspec.json.decode(text, type=TryRequest), _tried(folder)
        request = replace(request, values=request.values[len(tried) :], blocks=blocks)
        return _TaskProcess(MODULES["try"], request, folder / NOTES, tried)

    def _end_process(self, row: _Row) -> None:
        """End the process of a task, and wait until it has ended."""
        process, row.process = row.process, None
        if process is not None:
            process.kill()


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
    return msgspec.json.encode(note) + b"\n"
