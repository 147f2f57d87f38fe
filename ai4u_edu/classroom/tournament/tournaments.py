"""The present tournament of a class, as it is stored."""

import secrets
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from ai4u_edu.classroom.store import ClassStore

FOLDER = "tournaments"
"""Folder of tournaments in the class's folder, and in ZIP files with the work of a class."""
DISMISSED = "dismissed_tournament"
Phase = Literal["open", "running", "over", "cancelled", "failed"]
"""``open``: students hand in networks, and it was not started yet."""


@dataclass(frozen=True)
class TournamentRow:
    """A tournament."""

    id: str
    scene: str
    """Name of a scene of the library."""
    title: str
    """Title of the scene."""
    phase: Phase
    problem: str = ""
    """Reason for which it failed."""


class Tournaments:
    """The tournaments of a class, of which the last one is the present one.

    Belongs to the event loop.

    Args:
        store: of the class.
    """

    def __init__(self, store: ClassStore) -> None:
        self._store = store
        self.folder = store.folder / FOLDER
        """Folder of all tournaments."""
        self.read()

    def read(self) -> None:
        """Take the last tournament from the store."""
        self.now: TournamentRow | None = None
        rows = [TournamentRow(*row) for row in self._store.query(_ALL)]
        if rows and rows[-1].id != self._store.setting(DISMISSED):
            self.now = rows[-1]

    def all(self) -> list[TournamentRow]:
        """Return all tournaments, the first one first; a thread may do it."""
        return [TournamentRow(*row) for row in self._store.query(_ALL)]

    def begin(self, scene: str, title: str) -> None:
        """Begin another tournament, for which students hand in networks.

        Raises:
            StoreError: it can't be stored; then nothing has changed.
        """
        row = TournamentRow(secrets.token_hex(8), scene, title, "open")
        with self._store.transaction() as database:
            database.execute(
                "insert into tournaments values (?, ?, ?, ?, ?)",
                (row.id, row.scene, row.title, row.phase, row.problem),
            )
        self.now = row

    def change(self, phase: Phase, problem: str = "") -> None:
        """Change the present tournament's phase.

        Raises:
            StoreError: it can't be stored; then nothing has changed.
        """
        if self.now is None:
            return
        row = replace(self.now, phase=phase, problem=problem)
        with self._store.transaction() as database:
            database.execute(
                "update tournaments set phase = ?, problem = ? where id = ?",
                (phase, problem, row.id),
            )
        self.now = row

    def delete(self, rows: Iterable[TournamentRow]) -> None:
        """Delete tournaments with their results; a thread may do it.

        Raises:
            StoreError: one can't be deleted.
        """
        for row in rows:
            names = [f"{FOLDER}/{path.name}" for path in (self.folder_of(row), self.work_of(row))]
            self._store.delete_folders(*names)
            if row == self.now:
                self.now = None
            with self._store.transaction() as database:
                database.execute("delete from tournaments where id = ?", [row.id])
        if self.now is None and (left := self.all()):  # none of before is shown again
            self._store.set_setting(DISMISSED, left[-1].id)

    def dismiss(self) -> None:
        """Show no tournament any more; its results stay in the store.

        Raises:
            StoreError: it can't be stored; then nothing has changed.
        """
        if self.now is not None:
            self._store.set_setting(DISMISSED, self.now.id)
        self.now = None

    def folder_of(self, tournament: TournamentRow) -> Path:
        """Return the folder of a tournament's results, as ``ai4u-edu tournament`` has it."""
        return self.folder / tournament.id

    def work_of(self, tournament: TournamentRow) -> Path:
        """Return the folder of what else a tournament needs, such as the journal."""
        return self.folder / f"{tournament.id}.work"


_ALL = "select id, scene, title, phase, problem from tournaments order by rowid"
