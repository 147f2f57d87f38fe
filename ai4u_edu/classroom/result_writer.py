"""Writes results of rooms and notebooks to the class's file, each once, and then acknowledges."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

from ai4u_edu.base.errors import text_of
from ai4u_edu.classroom.course_index import known_diagnosis, words_for
from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.progress import Progress, Staged
from ai4u_edu.classroom.race import RaceResult, Races
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.wire.class_link import EpisodeResult, ExerciseResult, Result

MAX_BATCH = 500
_COUNT_WRONG = (
    "insert into wrong_answers values (?, ?, ?, ?) on conflict do update set "
    "count = excluded.count * (1 + count * (exercise = excluded.exercise "
    "and diagnosis = excluded.diagnosis)), exercise = excluded.exercise, "
    "diagnosis = excluded.diagnosis"
)
"""Counts a room's wrong answers in a row with the same mistake; a right one begins again."""
MAX_RESULTS = 2000
"""Latest results of a room that are kept, so that one that comes twice counts once. Programs send
those again that were not acknowledged, which are fewer."""


_FORGET_OLD = (
    "delete from results where room = ? and rowid <= "
    "(select rowid from results where room = ? order by rowid desc limit 1 offset ?)"
)


@dataclass(frozen=True)
class Received:
    """A result that came over a link."""

    room: str
    seats: tuple[int, ...]
    """Seats that it counts for."""
    result: Result
    done: Callable[[bool], object]
    """Called when the result is on disk (True), or could not be written (False)."""


class _Written(NamedTuple):
    """Changes of a batch that is on disk."""

    progress: Staged
    race: list[RaceResult]
    exercises: list[Received]
    """Exercise results that are new."""


class ResultWriter:
    """Stores results in batches: what came while one was written is the next one.

    Belongs to the event loop; a thread writes one batch at a time.

    Args:
        store: of the class.
        progress: of the class.
        races: of the class.
        on_exercise: called with each new exercise result that is on disk.
        on_change: called after each batch.
    """

    def __init__(
        self,
        store: ClassStore,
        progress: Progress,
        races: Races,
        on_exercise: Callable[[Received], object],
        on_change: Callable[[], object],
    ) -> None:
        self._store, self._progress, self._races = store, progress, races
        self._on_exercise, self._on_change = on_exercise, on_change
        self._waiting: list[tuple[Received, float]] = []
        self._task: asyncio.Task[None] | None = None
        self.problem = ""
        """Reason for which the last batch could not be written; empty if it could."""

    def add(self, received: Received) -> None:
        """Store a result soon, and then call its ``done``."""
        seconds = 0.0
        if isinstance(received.result, ExerciseResult):
            seconds = max(
                (self._progress.seconds_since(each) for each in received.seats), default=0
            )
        self._waiting.append((received, seconds))
        if self._task is None:
            self._task = asyncio.create_task(self._run())

    async def finish(self) -> None:
        """Wait until everything that was added is written."""
        if self._task is not None:
            await self._task

    async def _run(self) -> None:
        try:
            while self._waiting:
                batch, self._waiting = self._waiting[:MAX_BATCH], self._waiting[MAX_BATCH:]
                await self._store_batch(batch)
        finally:
            self._task = None

    async def _store_batch(self, batch: list[tuple[Received, float]]) -> None:
        try:
            staged, raced, new = await asyncio.to_thread(self._write, batch)
        except StoreError as error:
            self.problem = text_of(error)
            new = []
        else:
            self.problem = ""
            self._progress.apply(staged)
            self._races.results |= {each.key: each for each in raced}
        for received in new:
            self._on_exercise(received)
        for received, _ in batch:
            received.done(not self.problem)
        self._on_change()

    def _write(self, batch: list[tuple[Received, float]]) -> _Written:
        """Write a batch, and return the changes."""
        self._store.quota.check()
        new: list[Received] = []
        exercises: list[tuple[int, float, ExerciseResult]] = []
        raced: list[tuple[str, EpisodeResult]] = []
        with self._store.transaction() as database:
            for received, seconds in batch:
                row = (received.result.key, received.room, *_columns(received.result))
                cursor = database.execute(
                    "insert or ignore into results values (?, ?, ?, ?, ?)", row
                )
                if cursor.rowcount == 0:  # it came before
                    continue
                result = received.result
                if isinstance(result, ExerciseResult):
                    checked = _checked(result)
                    new.append(replace(received, result=checked))
                    exercises += [(seat, seconds, checked) for seat in received.seats]
                    if checked.event != "hint":
                        answer = [received.room, checked.exercise, checked.diagnosis]
                        database.execute(_COUNT_WRONG, [*answer, bool(checked.diagnosis)])
                elif self._races.takes(received.room, result):
                    raced.append((received.room, result))
            for room in {received.room for received, _ in batch}:
                database.execute(_FORGET_OLD, [room, room, MAX_RESULTS])
            staged = self._progress.stage(database, exercises)
            return _Written(staged, self._races.stage(database, raced), new)


def _columns(result: Result) -> tuple[str, str, float]:
    """Return scene, outcome and seconds of an episode; empty ones for an exercise."""
    if isinstance(result, EpisodeResult):
        return result.scene, result.outcome, result.seconds
    return "", "", 0.0


def _checked(result: ExerciseResult) -> ExerciseResult:
    """Return a result with a diagnosis that the course has; none if the answer is right."""
    if result.event != "wrong":
        return ExerciseResult(result.key, result.exercise, result.event)
    diagnosis = known_diagnosis(result.exercise, result.diagnosis)
    words_for(result.exercise, diagnosis)  # loads the lesson here and not in the event loop
    return ExerciseResult(result.key, result.exercise, result.event, diagnosis)
