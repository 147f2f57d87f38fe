"""Rows of work of rooms, which processes of the class do in turn.

:class:`~ai4u_edu.classroom.practice_queue.PracticeQueue` and
:class:`~ai4u_edu.classroom.task_queue.TaskQueue` differ in what a row does, who is next, and what
is on disk; how a row begins, gets its place in the line, ends and is told to its room stands here.
"""

import asyncio
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

import msgspec
from msgspec.structs import replace

from ai4u_edu.base.atomic_write import reason
from ai4u_edu.base.errors import shorten
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.classroom.trainings import FULL
from ai4u_edu.locale import gettext as _
from ai4u_edu.teach.learning import STOPPED
from ai4u_edu.wire.class_link import Practised, TaskState
from ai4u_edu.wire.validation import MAX_TEXT_CHARS

MAX_ENDED = 3
"""Rows of a room that are over and still listed, so that it learns how they ended."""
STOPPED_BY_TEACHER = _("your teacher has stopped it")
MISSING = _("its files are not there any more; begin another one")


class _Killable(Protocol):
    def kill(self) -> None:
        """End it."""


StateT = TypeVar("StateT", Practised, TaskState)
ProcessT = TypeVar("ProcessT", bound=_Killable)


@dataclass(eq=False)
class QueueRow(Generic[StateT, ProcessT]):
    """A room's work."""

    room: str
    state: StateT
    """State that the room is told."""
    process: ProcessT | None = None
    is_ending: bool = False
    """True from when its end is certain; its room learns of it when the process has ended."""

    @property
    def is_open(self) -> bool:
        """True until its end is certain."""
        return not (self.state.is_over or self.is_ending)


RowT = TypeVar("RowT", bound=QueueRow[Any, Any])


class RoomQueue(ABC, Generic[RowT, StateT]):
    """Work of all rooms. Belongs to the event loop, but for methods that say otherwise.

    Args:
        store: of the class.
        tell_room: called with a room's id when one of its rows has changed.
        note_change: called when the teacher's pages must be updated.
    """

    _poll_s: float
    """Interval at which the processes are looked at."""

    def __init__(
        self,
        store: ClassStore,
        tell_room: Callable[[str], object],
        note_change: Callable[[], object],
    ) -> None:
        self._store, self._tell_room, self._note_change = store, tell_room, note_change
        self._rows: dict[str, RowT] = {}
        self._task: asyncio.Task[None] | None = None

    def of_room(self, room: str) -> tuple[StateT, ...]:
        """Return the states of a room's rows, the oldest first."""
        return tuple(row.state for row in self._rows.values() if row.room == room)

    async def stop(self, room: str, key: str = "", problem: str = STOPPED) -> bool:
        """End a row of a room that is not over; without a key, all of them.

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

    async def delete(self, room: str) -> None:
        """End the processes of a room and forget its rows, because it will be deleted."""
        rows = [row for row in self._rows.values() if row.room == room]
        self._rows = {key: row for key, row in self._rows.items() if row not in rows}
        await self._end_all(rows)
        self._place()

    async def end(self) -> None:
        """End all processes and forget everything in memory, because it will be deleted."""
        rows, self._rows = [*self._rows.values()], {}
        await self._end_all(rows)
        if self._task is not None:
            await asyncio.gather(self._task, return_exceptions=True)

    async def _end_all(self, rows: list[RowT]) -> None:
        for row in rows:
            row.is_ending = True
            await asyncio.to_thread(self._end_process, row)

    async def _take(self, row: RowT, too_many: str) -> None:
        """Take a new row, or refuse it: if the disk is full, or with a sentence about too many."""
        problem = FULL if self._store.quota.is_full else too_many
        row.state = replace(row.state, is_over=bool(problem), problem=problem)
        await self._save(row)
        await asyncio.to_thread(self._look, row)  # before it is in the line: it tells who is next
        self._rows[row.state.key] = row
        await self._forget_ended(row.room)
        self._place()
        self.tick()

    def _tell(self, room: str) -> None:
        self._tell_room(room)
        self._note_change()

    def _open(self, room: str | None = None) -> list[RowT]:
        """Return the rows that are not over, of one room or of all."""
        return [row for row in self._rows.values() if row.is_open and room in (None, row.room)]

    @abstractmethod
    def _lines(self) -> Iterable[list[RowT]]:
        """Return each line of rows that wait, the next one first."""

    @abstractmethod
    async def _round(self, rows: list[RowT]) -> None:
        """Follow the open rows that have a process, and begin with those whose turn it is."""

    async def _save(self, row: RowT) -> None:
        """Write a row to the disk, if such rows outlive the class's process."""

    async def _delete(self, row: RowT) -> None:
        """Delete what :meth:`_save` wrote."""

    async def _work(self) -> None:
        try:
            while rows := self._open():
                await self._round(rows)
                self._place()
                await asyncio.sleep(self._poll_s)
        finally:
            self._task = None
            for row in self._rows.values():
                if row.process is not None:
                    row.process.kill()

    async def _begin(self, row: RowT) -> bool:
        """Start the process of a row; return False if it can't be, or is not wanted any more."""
        try:
            process = await asyncio.to_thread(self._start, row)
        except (OSError, msgspec.MsgspecError) as error:
            problem = MISSING
            if isinstance(error, OSError) and not isinstance(error, FileNotFoundError):
                problem = _("it could not begin: {reason}", reason=reason(error))
            await self._end_row(row, problem)
            return False
        row.process = process
        if not row.is_open or self._rows.get(row.state.key) is not row:  # stopped meanwhile
            await asyncio.to_thread(self._end_process, row)
            return False
        return True

    async def _end_row(self, row: RowT, problem: str) -> None:
        """End a row; its room reads what is in its folder."""
        row.is_ending = True
        await asyncio.to_thread(self._end_process, row)
        problem = shorten(problem, MAX_TEXT_CHARS)
        row.state = replace(row.state, place=0, is_over=True, problem=problem)
        await self._save_end(row)
        self._place()
        self._tell(row.room)

    async def _save_end(self, row: RowT) -> None:
        await self._save(row)
        await self._forget_ended(row.room)

    def _place(self) -> None:
        """Give all their places in the line, and tell the rooms for which they change."""
        places = {
            row.state.key: place for line in self._lines() for place, row in enumerate(line, 1)
        }
        for row in self._open():
            place = places.get(row.state.key, 0)
            if place != row.state.place:
                row.state = replace(row.state, place=place)
                self._tell(row.room)

    async def _forget_ended(self, room: str) -> None:
        rows = [row for row in self._rows.values() if row.room == room and row.state.is_over]
        for row in rows[:-MAX_ENDED]:
            del self._rows[row.state.key]
            await self._delete(row)

    # -- in threads --------------------------------------------------------------------------------

    @abstractmethod
    def _look(self, row: RowT) -> None:
        """Read what a row has done so far."""

    @abstractmethod
    def _start(self, row: RowT) -> Any:
        """Start the process of a row.

        Raises:
            OSError, MsgspecError: it can't begin.
        """

    def _end_process(self, row: RowT) -> None:
        """End the process of a row, and wait until it has ended."""
        process, row.process = row.process, None
        if process is not None:
            process.kill()
