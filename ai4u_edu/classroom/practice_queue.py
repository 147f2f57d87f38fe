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

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.blocks.loading import own_files
from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.room_queue import STOPPED_BY_TEACHER, QueueRow, RoomQueue
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.learn.training.run import Run
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import packed, unpacked
from ai4u_edu.runtime.training_progress import TrainingProgress
from ai4u_edu.teach.learning import DIED, STOPPED
from ai4u_edu.teach.practice import FOLDER as PRACTICES
from ai4u_edu.teach.practice import PracticeProcess, PracticeRequest
from ai4u_edu.wire.class_link import Practise, Practised

MAX_CPU_S = 600.0
"""Processor time of one practice, over all its pauses."""
MAX_OPEN = 3
"""Practices of a room that are not over: one learns, two wait."""
POLL_S = 0.5
"""Interval at which the processes are looked at."""
CPU_FILE = "processor_s"
"""File in a practice's folder with the processor time (s) that it has used."""
TOO_LONG = _("it has used its {most:g} minutes of processor time", most=MAX_CPU_S / 60)
TOO_MANY = _(
    "expected at most {most} practices of a world at once; wait until one is done", most=MAX_OPEN
)


@dataclass(eq=False)
class _PracticeRow(QueueRow[Practised, PracticeProcess]):
    """A room's practice."""

    decisions: int = 0
    total: int = 0
    checks: int = 0
    is_game: bool = False
    """True if the episodes of its checks are games against somebody."""
    success: float | None = None
    """Best share of a check's starts from which it reached the goal; None before a check."""
    cpu_s: float = 0.0
    """Processor time (s) of its earlier processes."""
    checks_before: int = 0
    """Checks before the present process."""

    @property
    def remaining(self) -> int:
        """Decisions that it still has to learn from."""
        return self.total - self.decisions

    @property
    def is_preemptible(self) -> bool:
        """True if the present process has made a check, so that little is lost."""
        return self.checks > self.checks_before


class PracticeQueue(RoomQueue[_PracticeRow, Practised]):
    """Practices of all rooms; those with the fewest decisions left learn first.

    One that waits takes the place of a longer one at the longer one's next check. Each is on disk
    from its request on, and goes on if the class's process is killed.

    Args:
        store, tell_room, note_change: as for :class:`RoomQueue`.
        workers: practices that learn at once.
    """

    _poll_s = POLL_S

    def __init__(
        self,
        store: ClassStore,
        workers: int,
        tell_room: Callable[[str], object],
        note_change: Callable[[], object],
    ) -> None:
        super().__init__(store, tell_room, note_change)
        self._workers = workers
        self.read()

    def read(self) -> None:
        """Read all from the store."""
        rows = self._store.query("select key, room, state from practices order by rowid")
        self._rows = {key: _PracticeRow(room, _read(state)) for key, room, state in rows}
        for row in self._rows.values():
            self._look(row)  # those that are over are not looked at again

    def sentence(self, room: str) -> str:
        """Return how the practice of a room goes, or went; empty if it has none."""
        rows = [row for row in self._rows.values() if row.room == room]
        if not rows or rows[-1].state.problem == STOPPED:
            return ""
        row = rows[-1]
        if row.state.problem == STOPPED_BY_TEACHER and not row.checks:
            return ""
        if row.state.place:
            return _("waits to practise, place {place}", place=row.state.place)
        if not row.state.is_over:
            done = row.decisions / max(1, row.total)
            how = _("practises, {done:.0%} done", done=done)
        elif row.checks or not row.state.problem:
            how = _("practised")
        else:
            return _("could not practise")
        if row.success is None:
            return how
        if row.is_game:
            return _("{practice}, won {share:.0%}", practice=how, share=row.success)
        return _("{practice}, goal {share:.0%}", practice=how, share=row.success)

    async def add(self, room: str, request: Practise) -> None:
        """Take a room's request, which is on disk afterwards; one that is there is told again.

        Raises:
            StoreError: it can't be written.
        """
        if request.key not in self._rows:
            row = _PracticeRow(room, Practised(request.key, request.practice))
            await self._take(row, TOO_MANY if len(self._open(room)) >= MAX_OPEN else "")
        self._tell(room)

    def _lines(self) -> Iterable[list[_PracticeRow]]:
        yield self._waiting()

    def _waiting(self) -> list[_PracticeRow]:
        """Return those that wait, the next one first."""
        return sorted(
            (row for row in self._open() if row.process is None), key=lambda row: row.remaining
        )

    async def _round(self, rows: list[_PracticeRow]) -> None:
        for row in rows:
            await asyncio.to_thread(self._look, row)
        for row in rows:
            await self._follow(row)
        await self._schedule()
        self._note_change()

    async def _follow(self, row: _PracticeRow) -> None:
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
            if await self._begin(row):
                running.append(row)

    async def _save(self, row: _PracticeRow) -> None:
        await asyncio.to_thread(self._write, row)

    async def _save_end(self, row: _PracticeRow) -> None:
        with suppress(StoreError):  # a full disk: it begins again in the class's next process
            await super()._save_end(row)

    async def _delete(self, row: _PracticeRow) -> None:
        await asyncio.to_thread(self._delete_key, row.state.key)

    # -- in threads --------------------------------------------------------------------------------

    def _folder(self, row: _PracticeRow) -> Path:
        """Return the folder of a practice.

        Raises:
            FileNotFoundError: it would be none of the room's.
        """
        name = row.state.practice
        if name != Path(name).name or name in ("", "..") or "\0" in name:
            raise FileNotFoundError
        return self._store.room_folder(row.room).absolute() / PRACTICES / name

    def _request(self, row: _PracticeRow) -> PracticeRequest:
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

    def _look(self, row: _PracticeRow) -> None:
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

    def _start(self, row: _PracticeRow) -> PracticeProcess:
        request = self._request(row)
        row.checks_before = row.checks
        return PracticeProcess(request)

    def _end_process(self, row: _PracticeRow) -> None:
        process = row.process
        if process is None:
            return
        row.cpu_s += process.cpu_s()
        super()._end_process(row)
        _ = process.problem  # waits for its end
        with suppress(OSError):  # the folder is gone
            write_atomically(self._folder(row) / CPU_FILE, f"{row.cpu_s:.1f}", mode=0o600)

    def _write(self, row: _PracticeRow) -> None:
        with self._store.transaction() as database:
            values = [
                row.state.key,
                row.room,
                msgspec.json.encode(row.state, enc_hook=packed).decode(),
            ]
            database.execute(
                "insert into practices values (?, ?, ?) on conflict (key) do update set "
                "state = excluded.state",
                values,
            )

    def _delete_key(self, key: str) -> None:
        with self._store.transaction() as database:
            database.execute("delete from practices where key = ?", [key])


def _read(text: str) -> Practised:
    state = msgspec.json.decode(text, type=Practised)
    return replace(state, problem=unpacked(state.problem))
