"""Networks that learn from drives in the class's process, for the rooms of its machine.

Rooms may start no process, and sleep while nobody uses them. So a room asks the class, and takes
the network out of its folder when it is done, be it in the room's next process.
"""

import asyncio
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import msgspec
from msgspec.structs import replace

from ai4u_edu.base.atomic_write import reason, write_atomically
from ai4u_edu.base.errors import shorten
from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext, packed, unpacked
from ai4u_edu.teach.drives import FOLDER as DRIVES
from ai4u_edu.teach.learning import DIED, LEARNED, STOPPED, Learning
from ai4u_edu.teach.network_score import NetworkScore
from ai4u_edu.wire.class_link import Learn, Training
from ai4u_edu.wire.validation import MAX_TEXT_CHARS

MAX_CPU_S = 120.0
"""Processor time of one learning; usually it takes a few seconds."""
SCORE_DECISIONS = 2_000
"""Decisions with which a network is scored at most: others wait meanwhile."""
POLL_S = 0.1
"""Interval at which the process is looked at."""
MISSING = _("a drive is not there any more; choose others, and learn again")
TOO_LONG = _("it took more than {most:g} s of processor time; choose fewer drives", most=MAX_CPU_S)
FULL = _("the class's folder is full, and keeps nothing more; tell your teacher")


@dataclass(frozen=True)
class _TrainingRow:
    """A room's latest training, as it is stored."""

    room: str
    training: Training
    files: tuple[str, ...]
    """Names of the drives' files."""


class Trainings:
    """The latest training of each room; one at a time learns, in the order in which they came.

    Belongs to the event loop. Each is on disk from its request on, so that it begins again if the
    class's process is killed.

    Args:
        store: of the class.
        tell_room: called with a room's id when its training has changed.
        note_change: called when the teacher's pages must be updated.
    """

    def __init__(
        self,
        store: ClassStore,
        tell_room: Callable[[str], object],
        note_change: Callable[[], object],
    ) -> None:
        self._store, self._tell_room, self._note_change = store, tell_room, note_change
        self._working: asyncio.Task[None] | None = None
        self._running: tuple[_TrainingRow, Learning] | None = None
        self.read()

    def read(self) -> None:
        """Read all from the store."""
        rows = self._store.query("select room, training, files from trainings order by rowid")
        self._rows = {
            room: _TrainingRow(
                room,
                _read(training),
                msgspec.json.decode(files, type=tuple[str, ...]),
            )
            for room, training, files in rows
        }

    def of_room(self, room: str) -> Training | None:
        """Return a room's latest training, with its place in the line; None for none."""
        row = self._rows.get(room)
        if row is None or row.training.is_over:
            return None if row is None else row.training
        if self._running is not None and self._running[0] is row:
            errors = tuple(error for _, error in self._running[1].errors)
            return replace(row.training, errors=errors)
        return replace(row.training, place=1 + self._line().index(row))

    def sentence(self, room: str) -> str:
        """Return how the learning of a room's network goes, or went; empty if it has none."""
        training = self.of_room(room)
        if training is None or training.problem == STOPPED:
            return ""
        if training.is_done:
            return _("learned: {alike:.0%} alike", alike=training.alike)
        if training.problem:
            return _("could not learn")
        if training.place:
            return _("waits to learn, place {place}", place=training.place)
        return ngettext("learns from {n} drive", "learns from {n} drives", training.drives)

    async def add(self, room: str, request: Learn) -> None:
        """Take a room's request, which is on disk afterwards; one that came before is ignored.

        Raises:
            StoreError: it can't be written.
        """
        training = Training(request.key, request.scene, request.agent, len(request.drives))
        if self._store.quota.is_full:
            training = replace(training, problem=FULL)
        row = _TrainingRow(room, training, request.drives)
        if await asyncio.to_thread(self._insert, row):
            self._rows.pop(room, None)  # to the end of the line
            self._rows[room] = row
            self.tick()
            self._tell_room(room)
            self._note_change()

    async def stop(self, room: str, key: str = "", problem: str = STOPPED) -> bool:
        """End a room's training without a result, if it is under way; without a key, any.

        Returns:
            False if there was none.
        """
        row = self._rows.get(room)
        if row is None or key not in ("", row.training.key) or row.training.is_over:
            return False
        await self._end_row(row, replace(row.training, problem=problem))
        return True

    def tick(self) -> None:
        """Begin with those that wait, if none learns."""
        if self._working is None and self._line():
            self._working = asyncio.create_task(self._work())

    async def delete(self, room: str) -> None:
        """End a room's training and forget it, because the room will be deleted."""
        self._rows.pop(room, None)
        while self._running is not None and self._running[0].room == room:
            await asyncio.sleep(POLL_S)  # its process ends, and writes nothing more
        for other in self._line():  # all move up
            self._tell_room(other.room)

    async def end(self) -> None:
        """End what learns and forget everything in memory, because it will be deleted."""
        self._rows = {}
        if self._working is not None:
            await asyncio.gather(self._working, return_exceptions=True)

    def _line(self) -> list[_TrainingRow]:
        """Return those that learn or wait, the first one first."""
        return [row for row in self._rows.values() if not row.training.is_over]

    # -- the task of what learns -------------------------------------------------------------------

    async def _work(self) -> None:
        try:
            while line := self._line():
                training = await self._learn(line[0])
                await self._end_row(line[0], training)
        finally:
            self._working = None

    async def _learn(self, row: _TrainingRow) -> Training:
        """Let a network learn, and return its training at the end."""
        folder = self._store.room_folder(row.room).absolute()
        drives = [folder / DRIVES / name for name in row.files]
        if [drive.name for drive in drives] != [*row.files] or not all(map(Path.is_file, drives)):
            return replace(row.training, problem=MISSING)
        faults: list[str] = []
        keep = partial(_keep, folder / LEARNED / f"{row.training.key}.onnx", faults)
        try:
            learning = await asyncio.to_thread(
                Learning,
                drives,
                row.training.agent,
                seed=0,
                on_done=keep,
                score_decisions=SCORE_DECISIONS,
            )
        except OSError as error:
            problem = _("it could not begin: {reason}", reason=reason(error))
            return replace(row.training, problem=problem)
        self._running = row, learning
        self._note_change()
        try:
            await self._follow(row, learning)
        finally:
            self._running = None
            learning.stop()
        return _ended(row.training, learning, faults)

    async def _follow(self, row: _TrainingRow, learning: Learning) -> None:
        told = -1
        while learning.is_running:
            if self._rows.get(row.room) is not row:  # it was stopped
                learning.stop()
            elif learning.cpu_s() > MAX_CPU_S:
                learning.stop(TOO_LONG)
            if told != len(learning.errors):
                told = len(learning.errors)
                self._tell_room(row.room)
            await asyncio.sleep(POLL_S)

    async def _end_row(self, row: _TrainingRow, training: Training) -> None:
        """Note the end of a training, if the room has no other one since."""
        if self._rows.get(row.room) is not row:
            return
        self._rows[row.room] = ended = _TrainingRow(row.room, training, row.files)
        with suppress(StoreError):  # a full disk: it begins again in the class's next process
            await asyncio.to_thread(self._update, ended)
        for room in (row.room, *(other.room for other in self._line())):  # all move up
            self._tell_room(room)
        self._note_change()

    # -- in threads --------------------------------------------------------------------------------

    def _insert(self, row: _TrainingRow) -> bool:
        with self._store.transaction() as database:
            # as with any result, a key that came is known for ever
            cursor = database.execute(
                "insert or ignore into results values (?, ?, ?, 'training', 0)",
                [row.training.key, row.room, row.training.scene],
            )
            if cursor.rowcount == 0:
                return False
            database.execute(
                "insert or replace into trainings values (?, ?, ?, ?)",
                [row.room, row.training.key, _json(row.training), _json(row.files)],
            )
        return True

    def _update(self, row: _TrainingRow) -> None:
        with self._store.transaction() as database:
            # the room may have another one meanwhile
            values = [_json(row.training), row.room, row.training.key]
            database.execute("update trainings set training = ? where room = ? and key = ?", values)


def _ended(training: Training, learning: Learning, faults: Sequence[str]) -> Training:
    note = learning.note
    problem = faults[0] if faults else note.problem or ("" if note.is_done else DIED)
    score = note.score or NetworkScore(0, 0, False, 0.0, 0.0)
    return replace(
        training,
        errors=tuple(error for _, error in learning.errors),
        is_done=not problem,
        problem=shorten(problem, MAX_TEXT_CHARS),
        decisions=note.decisions,
        alike=note.alike,
        commonest=note.commonest,
        held_out=note.held_out,
        starts=score.starts,
        successes=score.successes,
        has_all_starts=score.has_all,
        remarks=tuple(shorten(remark, MAX_TEXT_CHARS) for remark in note.remarks),
    )


def _keep(path: Path, faults: list[str], _learning: Learning, out: Path) -> None:
    """Put a network into the folder of its room; a thread does it."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        for other in path.parent.iterdir():  # one that the room never took
            with suppress(OSError):
                other.unlink()
        write_atomically(path, out.read_bytes(), mode=0o600)
    except OSError as error:
        faults.append(_("the network could not be kept: {reason}", reason=reason(error)))


def _read(text: str) -> Training:
    training = msgspec.json.decode(text, type=Training)
    remarks = tuple(map(unpacked, training.remarks))
    return replace(training, problem=unpacked(training.problem), remarks=remarks)


def _json(value: object) -> str:
    return msgspec.json.encode(value, enc_hook=packed).decode()
