"""Progress of the seats in the exercises, and their mistakes: counted as results come.

Nothing is ever computed from a history: a result changes an entry in memory, and the entry is
stored together with the result's key.
"""

import sqlite3
import time
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Literal, cast

from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.wire.class_link import ExerciseResult

MAX_GAP_S = 900.0
"""Longest time between two results that counts as work."""
ExerciseState = Literal["tried", "hint", "solved"]


@dataclass(frozen=True)
class SeatProgress:
    """Progress of one seat in one exercise."""

    state: ExerciseState = "tried"
    tries: int = 0
    """Checks up to the first right one."""
    hints: int = 0
    """Hints read before it was solved."""
    seconds: float = 0.0
    """Time from the seat's result before, or from its arrival, to each result; see MAX_GAP_S."""


Place = tuple[int, str]
"""Number of a seat, and id of an exercise."""
Mistake = tuple[int, str, str]
"""Number of a seat, id of a diagnosis, and of the exercise."""


@dataclass(frozen=True)
class Staged:
    """Changes that are on disk and not yet in memory."""

    entries: dict[Place, SeatProgress]
    mistakes: Counter[Mistake]


class Progress:
    """Progress of a class in memory. Belongs to the event loop, except :meth:`stage`.

    Args:
        store: of the class.
        clock: returns seconds; to be replaced in tests.
    """

    def __init__(self, store: ClassStore, clock: Callable[[], float] = time.monotonic) -> None:
        self._store, self._clock = store, clock
        self.read()

    def read(self) -> None:
        """Read everything from the store."""
        self._seen: dict[int, float] = {}
        rows = self._store.query(
            "select seat, exercise, state, tries, hints, seconds from progress"
        )
        self.entries: dict[Place, SeatProgress] = {
            (seat, exercise): SeatProgress(*rest) for seat, exercise, *rest in rows
        }
        rows = self._store.query("select seat, diagnosis, exercise, count from diagnoses")
        self.mistakes: Counter[Mistake] = Counter(
            {cast("Mistake", tuple(key)): count for *key, count in rows}
        )

    def forget(self, seat: int) -> None:
        """Forget a seat that was deleted."""
        self._seen.pop(seat, None)
        self.entries = {key: each for key, each in self.entries.items() if key[0] != seat}
        kept = {key: count for key, count in self.mistakes.items() if key[0] != seat}
        self.mistakes = Counter(kept)

    def begin(self, seat: int) -> None:
        """Note that a seat has arrived: its time counts from now."""
        self._seen[seat] = self._clock()

    def seconds_since(self, seat: int) -> float:
        """Return the time to count for a seat's result of now."""
        now = self._clock()
        before = self._seen.get(seat, now)
        self._seen[seat] = now
        return min(MAX_GAP_S, now - before)

    def stage(
        self,
        database: sqlite3.Connection,
        results: Iterable[tuple[int, float, ExerciseResult]],
    ) -> Staged:
        """Write the changes that new results make; called in a thread, for one batch at a time.

        Args:
            database: in a transaction.
            results: number of the seat, seconds to count, and the result.
        """
        entries: dict[Place, SeatProgress] = {}
        mistakes: Counter[Mistake] = Counter()
        for seat, seconds, result in results:
            place = seat, result.exercise
            entry = entries.get(place) or self.entries.get(place)
            entries[place] = advanced(entry, result, seconds)
            if result.diagnosis and (entry is None or entry.state != "solved"):
                mistakes[seat, result.diagnosis, result.exercise] += 1
        database.executemany(
            "insert or replace into progress values (?, ?, ?, ?, ?, ?)",
            [(*place, e.state, e.tries, e.hints, e.seconds) for place, e in entries.items()],
        )
        database.executemany(
            "insert into diagnoses values (?, ?, ?, ?) "
            "on conflict do update set count = count + excluded.count",
            [(*mistake, count) for mistake, count in mistakes.items()],
        )
        return Staged(entries, mistakes)

    def apply(self, staged: Staged) -> None:
        """Take over changes that are on disk."""
        self.entries |= staged.entries
        self.mistakes.update(staged.mistakes)

    def by_seat(self) -> dict[str, dict[str, dict[str, object]]]:
        """Return the progress as the teacher's page gets it."""
        found: dict[str, dict[str, dict[str, object]]] = defaultdict(dict)
        for (seat, exercise), entry in self.entries.items():
            minutes = round(entry.seconds / 60, 1)
            told: dict[str, object] = {
                "state": entry.state,
                "tries": entry.tries,
                "minutes": minutes,
            }
            found[str(seat)][exercise] = told
        return dict(found)


def advanced(entry: SeatProgress | None, result: ExerciseResult, seconds: float) -> SeatProgress:
    """Return an entry after one more result; a solved one does not change.

    >>> wrong = ExerciseResult("k1234567", "04.2", "wrong", "04.2/narrow")
    >>> advanced(None, wrong, 30)
    SeatProgress(state='tried', tries=1, hints=0, seconds=30.0)
    """
    entry = entry or SeatProgress()
    if entry.state == "solved":
        return entry
    entry = replace(entry, seconds=entry.seconds + seconds)
    if result.event == "hint":
        return replace(entry, state="hint", hints=entry.hints + 1)
    state: ExerciseState = "solved" if result.event == "right" else entry.state
    return replace(entry, state=state, tries=entry.tries + 1)
