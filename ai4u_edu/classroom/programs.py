"""Programs that students write in their pages: the present one of each seat, scene and agent.

A program is text. Nothing of the class reads it as Python: it runs in the student's browser only.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass

from ai4u_edu.classroom.errors import NewerProgramError, ProgramNotKeptError
from ai4u_edu.classroom.store import ClassStore

MAX_PROGRAM_CHARS = 100_000
MAX_PROGRAMS = 50
"""Limit of a seat's programs."""
MAX_SCENE_NAME_CHARS = 200
MAX_AGENT_NAME_CHARS = 100
FOLDER = "programs"
"""Folder of programs in ZIP files with the work of a class."""
_OF_SEAT = "select seat, scene, agent, source, changed_at from programs where seat = ?"
_LATEST_FIRST = " order by changed_at desc, rowid desc"


@dataclass(frozen=True)
class ProgramRow:
    """A program, as it is stored."""

    seat: int
    scene: str
    agent: str
    """Id of the agent that it drives."""
    source: str
    changed_at: float
    """Time of the last change by this machine's clock (s since 1970)."""


class Programs:
    """The programs in the class's file. Thread-safe, as the file is.

    Args:
        store: of the class.
        clock: returns seconds since 1970; to be replaced in tests.
    """

    def __init__(self, store: ClassStore, clock: Callable[[], float] = time.time) -> None:
        self._store, self._clock = store, clock

    def save(self, seat: int, scene: str, agent: str, source: str, age_s: float) -> None:
        """Store a seat's program, unless a newer one is stored; it is on disk on return.

        Args:
            seat: number of the seat.
            scene: name of the scene.
            agent: id of the agent.
            source: the program.
            age_s: seconds since it was changed; devices' clocks differ, so no time is told.

        Raises:
            NewerProgramError: another device has stored a program that was changed later.
            ProgramNotKeptError: the seat has too many programs.
            StoreError: it can't be written.
        """
        changed_at = self._clock() - age_s
        with self._store.transaction() as database:
            stored = database.execute(
                "select changed_at from programs where seat = ? and scene = ? and agent = ?",
                [seat, scene, agent],
            ).fetchone()
            if stored is not None and stored[0] > changed_at:
                raise NewerProgramError("The class has a newer program, from another device.")
            (count,) = database.execute(
                "select count(*) from programs where seat = ?", [seat]
            ).fetchone()
            if stored is None and count >= MAX_PROGRAMS:
                raise ProgramNotKeptError(
                    f"The class keeps at most {MAX_PROGRAMS} programs of each student, and you "
                    "have that many. This one stays in this browser; download it."
                )
            database.execute(
                "insert or replace into programs values (?, ?, ?, ?, ?)",
                [seat, scene, agent, source, changed_at],
            )

    def find(self, seat: int, scene: str, agent: str) -> ProgramRow | None:
        """Return a seat's program; None if there is none."""
        values = [seat, scene, agent]
        rows = self._store.query(_OF_SEAT + " and scene = ? and agent = ?", values)
        return ProgramRow(*rows[0]) if rows else None

    def of_seat(self, seat: int) -> list[ProgramRow]:
        """Return a seat's programs, the one that was changed last first."""
        rows = self._store.query(_OF_SEAT + _LATEST_FIRST, [seat])
        return [ProgramRow(*row) for row in rows]

    def latest_of(self, seat: int) -> ProgramRow | None:
        """Return the program of a seat that was changed last; None if there is none."""
        rows = self._store.query(_OF_SEAT + _LATEST_FIRST + " limit 1", [seat])
        return ProgramRow(*rows[0]) if rows else None

    def age_of(self, program: ProgramRow) -> float:
        """Return the seconds since a program was changed."""
        return max(0.0, self._clock() - program.changed_at)
