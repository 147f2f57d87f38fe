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
MAX_DEVICE_CHARS = 64
_ALL = "select seat, scene, agent, source, version, device, saved_at from programs"
_OF_SEAT = _ALL + " where seat = ?"
_LATEST_FIRST = " order by version desc"


@dataclass(frozen=True)
class ProgramRow:
    """A program, as it is stored."""

    seat: int
    scene: str
    agent: str
    """Id of the agent that it drives."""
    source: str
    version: int
    """Number of the save, counted over all programs of the class; a later one is greater."""
    device: str
    """Random id of the browser that saved it."""
    saved_at: float
    """Time by this machine's clock (s since 1970), to be shown to people; it decides nothing."""


class Programs:
    """The programs in the class's file. Thread-safe, as the file is.

    Args:
        store: of the class.
        clock: returns seconds since 1970; to be replaced in tests.
    """

    def __init__(self, store: ClassStore, clock: Callable[[], float] = time.time) -> None:
        self._store, self._clock = store, clock

    def save(
        self, seat: int, scene: str, agent: str, source: str, *, base: int, device: str
    ) -> int:
        """Store a seat's program, unless another device has stored one that this one never saw.

        Saves are counted, as clocks differ between devices and may be set at any time.

        Args:
            seat: number of the seat.
            scene: name of the scene.
            agent: id of the agent.
            source: the program.
            base: latest version that the device has seen; 0 for none.
            device: id of the browser.

        Returns:
            The version, which is on disk.

        Raises:
            NewerProgramError: another device has stored a later version.
            ProgramNotKeptError: the seat has too many programs.
            StoreError: it can't be written.
        """
        with self._store.transaction() as database:
            stored = database.execute(
                "select version, device from programs where seat = ? and scene = ? and agent = ?",
                [seat, scene, agent],
            ).fetchone()
            if stored is not None and stored[0] > base and stored[1] != device:
                raise NewerProgramError("The class has a newer program, from another device.")
            (count,) = database.execute(
                "select count(*) from programs where seat = ?", [seat]
            ).fetchone()
            if stored is None and count >= MAX_PROGRAMS:
                raise ProgramNotKeptError(
                    f"The class keeps at most {MAX_PROGRAMS} programs of each student, and you "
                    "have that many. This one stays in this browser; download it."
                )
            version: int = database.execute(
                "insert or replace into programs values (?, ?, ?, ?, "
                "(select coalesce(max(version), 0) + 1 from programs), ?, ?) returning version",
                [seat, scene, agent, source, device, self._clock()],
            ).fetchone()[0]
        return version

    def find(self, seat: int, scene: str, agent: str) -> ProgramRow | None:
        """Return a seat's program; None if there is none."""
        values = [seat, scene, agent]
        rows = self._store.query(_OF_SEAT + " and scene = ? and agent = ?", values)
        return ProgramRow(*rows[0]) if rows else None

    def of_seat(self, seat: int) -> list[ProgramRow]:
        """Return a seat's programs, the one that was saved last first."""
        rows = self._store.query(_OF_SEAT + _LATEST_FIRST, [seat])
        return [ProgramRow(*row) for row in rows]

    def latest_of(self, seat: int) -> ProgramRow | None:
        """Return the program of a seat that was saved last; None if there is none."""
        rows = self._store.query(_OF_SEAT + _LATEST_FIRST + " limit 1", [seat])
        return ProgramRow(*rows[0]) if rows else None

    def latest_of_all(self) -> list[ProgramRow]:
        """Return the program of each seat that was saved last, the latest first."""
        of_each = " where version in (select max(version) from programs group by seat)"
        return [ProgramRow(*row) for row in self._store.query(_ALL + of_each + _LATEST_FIRST)]

    def age_of(self, program: ProgramRow) -> float:
        """Return the seconds since a program was saved, by a clock that may have been set since."""
        return max(0.0, self._clock() - program.saved_at)
