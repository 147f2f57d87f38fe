"""A class on disk: its code, its rooms and its seats, in one SQLite file."""

import sqlite3
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from secrets import token_urlsafe
from typing import Self

from ai4u_edu.base.atomic_write import make_folder
from ai4u_edu.base.errors import SetupError

FILE = "class.sqlite3"
VERSION = 1
"""Version of the tables; a file with another one is not opened."""
_TABLES = """
create table settings (name text primary key, value text not null) strict;
create table rooms (id text primary key, scene text not null) strict;
create table seats (
    number integer primary key,
    name text not null unique,
    colour text not null,
    room text not null references rooms (id),
    token_hash blob not null unique,
    request text not null unique,
    state text not null check (state in ('in', 'left', 'kicked', 'banned'))
) strict;
"""


@dataclass(frozen=True)
class SeatRow:
    """A seat, as it is stored."""

    number: int
    name: str
    colour: str
    room: str
    token_hash: bytes
    request: str
    """Id that the browser gave to its join request, so that a repeated one gets the same seat."""
    state: str


@dataclass(frozen=True)
class RoomRow:
    """A room, as it is stored."""

    id: str
    scene: str


class ClassStore:
    """The class's file. Thread-safe; what a method has written is on disk when it returns.

    Args:
        folder: of the class; created if needed.

    Raises:
        SetupError: the folder can't be written to, or holds a class of another version.
    """

    def __init__(self, folder: Path) -> None:
        make_folder(folder, "the class's folder")
        self._lock = threading.Lock()
        path = folder / FILE
        try:
            self._database = sqlite3.connect(path, check_same_thread=False, isolation_level=None)
            self._database.execute("pragma journal_mode = wal")
            self._database.execute("pragma synchronous = full")
            self._database.execute("pragma foreign_keys = on")
            (version,) = self._database.execute("pragma user_version").fetchone()
            if version == 0:
                self._database.executescript(
                    f"begin; {_TABLES} pragma user_version = {VERSION}; commit"
                )
        except sqlite3.Error as error:
            raise SetupError(
                f"expected a class's file at {path}, and couldn't use it: {error}"
            ) from None
        if version not in (0, VERSION):
            raise SetupError(
                f"{path} was made by another version of ai4u-edu (tables {version}, expected "
                f"{VERSION}); use another --folder"
            )

    def close(self) -> None:
        """Close the file."""
        self._database.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def setting(self, name: str, default: str = "") -> str:
        """Return a setting of the class."""
        with self._lock:
            row = self._database.execute(
                "select value from settings where name = ?", [name]
            ).fetchone()
        return default if row is None else str(row[0])

    def set_setting(self, name: str, value: str) -> None:
        """Store a setting of the class."""
        with self._transaction() as database:
            database.execute("insert or replace into settings values (?, ?)", [name, value])

    def rooms(self) -> list[RoomRow]:
        """Return all rooms, in the order in which they were made."""
        with self._lock:
            rows = self._database.execute("select id, scene from rooms order by rowid").fetchall()
        return [RoomRow(*row) for row in rows]

    def seats(self) -> list[SeatRow]:
        """Return all seats, by number."""
        with self._lock:
            rows = self._database.execute(
                "select number, name, colour, room, token_hash, request, state from seats "
                "order by number"
            ).fetchall()
        return [SeatRow(*row) for row in rows]

    def add_seat(self, seat: SeatRow, new_room: RoomRow | None) -> None:
        """Store a new seat, and its room if that is new too: both or nothing."""
        with self._transaction() as database:
            if new_room is not None:
                database.execute("insert into rooms values (?, ?)", [new_room.id, new_room.scene])
            database.execute(
                "insert into seats values (?, ?, ?, ?, ?, ?, ?)",
                [
                    *(seat.number, seat.name, seat.colour, seat.room),
                    *(seat.token_hash, seat.request, seat.state),
                ],
            )

    def update_seat(self, seat: SeatRow) -> None:
        """Store a seat's new name, token and state."""
        with self._transaction() as database:
            database.execute(
                "update seats set name = ?, token_hash = ?, state = ? where number = ?",
                [seat.name, seat.token_hash, seat.state, seat.number],
            )

    @contextmanager
    def _transaction(self) -> Iterator[sqlite3.Connection]:
        with self._lock:
            self._database.execute("begin immediate")
            try:
                yield self._database
            except BaseException:
                self._database.execute("rollback")
                raise
            self._database.execute("commit")


def teacher_token(store: ClassStore) -> str:
    """Return the secret of the teacher's page, which is made once for each class."""
    token = store.setting("teacher_token")
    if not token:
        token = token_urlsafe(24)
        store.set_setting("teacher_token", token)
    return token
