"""Networks that practise for rewards in the class's process, for the rooms of its machine.

A practice lies in the folder of its room, which writes it there and reads what it reaches. The
class only decides which practice learns now: rooms may start no process.
"""

import asyncio
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import msgspec
from msgspec.structs import replace
from pydantic import ValidationError

from ai4u_edu.base.atomic_write import reason, write_atomically
from ai4u_edu.base.errors import shorten
from ai4u_edu.blocks.loading import own_files
from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.classroom.trainings import FULL
from ai4u_edu.learn.training.run import Run
from ai4u_edu.runtime.training_progress import TrainingProgress
from ai4u_edu.teach.learning import DIED, STOPPED
from ai4u_edu.teach.practice import FOLDER as PRACTICES
from ai4u_edu.teach.practice import PracticeProcess, PracticeRequest
from ai4u_edu.wire.class_link import Practise, Practised
from ai4u_edu.wire.validation import MAX_TEXT_CHARS

MAX_CPU_S = 600.0
"""Processor time of one practice, over all its pauses."""
MAX_OPEN = 3
"""Practices of a room that are not over: one learns, two wait."""
MAX_ENDED = 3
"""Practices of a room that are over and still listed, so that it learns how they ended."""
POLL_S = 0.5
"""Interval at which the processes are looked at."""
CPU_FILE = "processor_s"
"""File in a practice's folder with the processor time (s) that it has used."""
MISSING = "its files are not there any more; begin another practice"
TOO_LONG = f"it has used its {MAX_CPU_S / 60:g} minutes of processor time"
TOO_MANY = f"expected at most {MAX_OPEN} practices of a world at once; wait until one is done"


@dataclass(eq=False)
class _Row:
    """A room's practice."""

    room: str
    state: Practised
    decisions: int = 0
    total: int = 0
    checks: int = 0
    is_game: bool = False
    """True if the episodes of its checks are games against somebody."""
    success: float | None = None
    """Best share of a check's starts from which it reached the goal; None before a check."""
    cpu_s: float = 0.0
    """Processor time (s) of its earlier processes."""
    process: PracticeProcess | None = None
    checks_before: int = 0
    """Checks before the present process."""
    is_ending: bool = False
    """True from when its end is certain; its room learns of it when the process has ended."""

    @property
    def remaining(self) -> int:
        """Decisions that it still has to learn from."""
        return self.total - self.decisions

    @property
    def is_preemptible(self) -> bool:
        """True if the present process has made a check, so that little is lost."""
        return self.checks > self.checks_before


class PracticeQueue:
    """Practices of all rooms; those with the fewest decisions left learn first.

    Belongs to the event loop. One that waits takes the place of a longer one at the longer one's
    next check. Each is on disk from its request on, and goes on if the class's process is killed.

    Args:
        store: of the class.
        workers: practices that learn at once.
        tell_room: called with a room's id when one of its practices has changed.
        note_change: called when the teacher's pages must be updated.
    """

    def __init__(
        self,
        store: ClassStore,
        workers: int,
        tell_room: Callable[[str], object],
        note_change: Callable[[], object],
    ) -> None:
        self._store, self._workers = store, workers
        self._tell_room, self._note_change = tell_room, note_change
        self._task: asyncio.Task[None] | None = None
        self.read()

    def read(self) -> None:
        """Read all from the store."""
        rows = self._store.query("select key, room, state from practices order by rowid")
        self._rows = {
            key: _Row(room, msgspec.json.decode(state, type=Practised)) for key, room, state in rows
        }

    def of_room(self, room: str) -> tuple[Practised, ...]:
        """Return a room's practices, the oldest first."""
        return tuple(row.state for row in self._rows.values() if row.room == room)

    def sentence(self, room: str) -> str:
        """Return how the practice of a room goes, or went; empty if it has none."""
        rows = [row for row in self._rows.values() if row.room == room]
        if not rows or rows[-1].state.problem == STOPPED:
            return ""
        row = rows[-1]
        goal = "" if row.success is None else f", goal {row.success:.0%}"
        if row.success is not None and row.is_game:
            goal = f", won {row.success:.0%}"
        if row.state.place:
            return f"waits to practise, place {row.state.place}"
        if not row.state.is_over:
            return f"practises, {row.decisions / max(1, row.total):.0%} done{goal}"
        return f"practised{goal}" if row.checks else "could not practise"

    async def add(self, room: str, request: Practise) -> None:
        """Take a room's request, which is on disk afterwards; one that is there is told again.

        Raises:
            StoreError: it can't be written.
        """
        if request.key not in self._rows:
            problem = ""
            if self._store.quota.is_full:
                problem = FULL
            elif len([row for row in self._open() if row.room == room]) >= MAX_OPEN:
                problem = TOO_MANY
            state = Practised(request.key, request.practice, is_over=bool(problem), problem=problem)
            row = _Row(room, state)
            await asyncio.to_thread(self._write, row)
            self._rows[request.key] = row
            await self._forget_ended(room)
            await asyncio.to_thread(self._look, [row])
            self._place()
            self.tick()
        self._tell_room(room)
        self._note_change()

    async def stop(self, room: str, key: str = "", problem: str = STOPPED) -> bool:
        """End a practice of a room that is not over; without a key, all of them.

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
        """End what learns and forget everything in memory, because it will be deleted."""
        rows, self._rows = self._rows, {}
        for row in rows.values():
            await asyncio.to_thread(self._end_process, row)
        if self._task is not None:
            await asyncio.gather(self._task, return_exceptions=True)

    def _open(self) -> list[_Row]:
        return [row for row in self._rows.values() if not (row.state.is_over or row.is_ending)]

    def _waiting(self) -> list[_Row]:
        """Return those that wait, the next one first."""
        return sorted(
            (row for row in self._open() if row.process is None), key=lambda row: row.remaining
        )

    # -- the task of what learns -------------------------------------------------------------------

    async def _work(self) -> None:
        try:
            while rows := self._open():
                await asyncio.to_thread(self._look, rows)
                for row in rows:
                    await self._follow(row)
                await self._schedule()
                self._note_change()
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
        if process.wait(0):
            problem = await asyncio.to_thread(lambda: process.problem)
            await self._end_row(row, DIED if problem is None else problem)
        elif row.cpu_s + process.cpu_s() > MAX_CPU_S:
            await self._end_row(row, TOO_LONG)

    async def _schedule(self) -> None:
        """Let those with the fewest decisions left learn."""
        running = [row for row in self._open() if row.process is not None]
        for row in self._waiting():
            if row.room in {other.room for other in running}:
                continue
            if len(running) >= self._workers:
                longer = [other for other in running if other.is_preemptible]
                longest = max(longer, key=lambda other: other.remaining, default=None)
                if longest is None or longest.remaining <= row.remaining:
                    break
                running.remove(longest)
                await asyncio.to_thread(self._end_process, longest)
            if await self._start(row):
                running.append(row)
        self._place()

    async def _start(self, row: _Row) -> bool:
        """Start the process of a practice; return False if it can't be."""
        try:
            request = await asyncio.to_thread(self._request, row)
            row.checks_before = row.checks
            process = await asyncio.to_thread(PracticeProcess, request)
        except (OSError, msgspec.MsgspecError) as error:
            problem = MISSING
            if isinstance(error, OSError) and not isinstance(error, FileNotFoundError):
                problem = f"it could not begin: {reason(error)}"
            await self._end_row(row, problem)
            return False
        row.process = process
        if row.is_ending or self._rows.get(row.state.key) is not row:  # stopped meanwhile
            await asyncio.to_thread(self._end_process, row)
            return False
        return True

    async def _end_row(self, row: _Row, problem: str) -> None:
        """End a practice; its room takes the network out of the folder."""
        row.is_ending = True
        await asyncio.to_thread(self._end_process, row)
        row.state = replace(
            row.state, place=0, is_over=True, problem=shorten(problem, MAX_TEXT_CHARS)
        )
        with suppress(StoreError):  # a full disk: it begins again in the class's next process
            await asyncio.to_thread(self._write, row)
            await self._forget_ended(row.room)
        self._place()
        self._tell_room(row.room)
        self._note_change()

    def _place(self) -> None:
        """Give all their places in the line, and tell the rooms for which they change."""
        places = {id(row): place for place, row in enumerate(self._waiting(), 1)}
        for row in self._open():
            place = places.get(id(row), 0)
            if place != row.state.place:
                row.state = replace(row.state, place=place)
                self._tell_room(row.room)

    async def _forget_ended(self, room: str) -> None:
        rows = [row for row in self._rows.values() if row.room == room and row.state.is_over]
        for row in rows[:-MAX_ENDED]:
            del self._rows[row.state.key]
            await asyncio.to_thread(self._delete, row.state.key)

    # -- in threads --------------------------------------------------------------------------------

    def _folder(self, row: _Row) -> Path:
        """Return the folder of a practice.

        Raises:
            FileNotFoundError: it would be none of the room's.
        """
        name = row.state.practice
        if name != Path(name).name or name in ("", "..") or "\0" in name:
            raise FileNotFoundError
        return self._store.folder.absolute() / "rooms" / row.room / PRACTICES / name

    def _request(self, row: _Row) -> PracticeRequest:
        """Return the practice, whose files all lie in its folder.

        Raises:
            OSError, MsgspecError: there is none.
        """
        folder = self._folder(row)
        text = (folder / "request.json").read_bytes()
        request = msgspec.json.decode(text, type=PracticeRequest)
        is_file = request.against.endswith(".onnx")
        return replace(
            request,
            folder=str(folder / "run"),
            begin_with=str(folder / "begin_with.onnx") if request.begin_with else "",
            against=str(folder / "opponent.onnx") if is_file else request.against,
            blocks=[str(file) for file in own_files()],
        )

    def _look(self, rows: Iterable[_Row]) -> None:
        """Read what practices have reached."""
        for row in rows:
            with suppress(OSError, ValueError, ValidationError, msgspec.MsgspecError):
                folder = self._folder(row)
                if not row.total:
                    request = self._request(row)
                    row.total, row.is_game = request.steps, bool(request.against)
                if row.process is None:
                    with suppress(FileNotFoundError):
                        row.cpu_s = float((folder / CPU_FILE).read_text())
                text = Run(folder / "run").progress.read_bytes()
                progress = TrainingProgress.model_validate_json(text)
                row.decisions, row.checks = progress.decisions, len(progress.curve)
                shares = [point.success for point in progress.curve if point.success is not None]
                row.success = max(shares, default=None)

    def _end_process(self, row: _Row) -> None:
        """End the process of a practice, and wait until it has ended."""
        process, row.process = row.process, None
        if process is None:
            return
        row.cpu_s += process.cpu_s()
        process.kill()
        _ = process.problem  # waits for its end
        with suppress(OSError):  # the folder is gone
            write_atomically(self._folder(row) / CPU_FILE, f"{row.cpu_s:.1f}", mode=0o600)

    def _write(self, row: _Row) -> None:
        with self._store.transaction() as database:
            values = [row.state.key, row.room, msgspec.json.encode(row.state).decode()]
            database.execute(
                "insert into practices values (?, ?, ?) on conflict (key) do update set "
                "state = excluded.state",
                values,
            )

    def _delete(self, key: str) -> None:
        with self._store.transaction() as database:
            database.execute("delete from practices where key = ?", [key])
