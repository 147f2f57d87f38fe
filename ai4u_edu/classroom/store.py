"""A class on disk, in one SQLite file: its code, rooms and seats, and the tables of its results.

Results, progress, assignments, programs, stars and races are read and written by the modules that
own them, through :meth:`ClassStore.query` and :meth:`ClassStore.transaction`.
"""

import sqlite3
import threading
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from secrets import token_urlsafe
from typing import Any, Self

from ai4u_edu.base.atomic_write import make_folder
from ai4u_edu.base.errors import SetupError
from ai4u_edu.classroom.errors import StoreError

FILE = "class.sqlite3"
TEACHER_SETTING = "teacher_token"
"""Name of the setting with the secret of the teacher's page."""
VERSION = 7
"""Version of the tables; a file with another one is not opened."""
_TABLES = """
create table settings (name text primary key, value text not null) strict;
create table rooms (id text primary key, scene text not null) strict;
create table seats (
    number integer primary key,
    name text not null unique,
    colour text not null,
    room text not null references rooms (id),
    state text not null check (state in ('in', 'left', 'kicked', 'banned'))
) strict;
create table tokens (
    hash blob primary key,
    seat integer not null references seats (number),
    request text not null unique
) strict;
create table results (
    key text primary key,
    room text not null,
    scene text not null,
    outcome text not null,
    seconds real not null
) strict;
create table progress (
    seat integer not null,
    exercise text not null,
    state text not null check (state in ('tried', 'hint', 'solved')),
    tries integer not null,
    hints integer not null,
    seconds real not null,
    primary key (seat, exercise)
) strict;
create table diagnoses (
    seat integer not null,
    diagnosis text not null,
    exercise text not null,
    count integer not null,
    primary key (seat, diagnosis, exercise)
) strict;
create table assignments (
    room text primary key,
    id text not null,
    title text not null,
    scene text not null,
    seed integer,
    lesson text not null,
    program text not null
) strict;
create table programs (
    seat integer not null references seats (number),
    scene text not null,
    agent text not null,
    source text not null,
    changed_at real not null,
    primary key (seat, scene, agent)
) strict;
create table stars (
    seat integer not null references seats (number),
    scene text not null,
    count integer not null,
    primary key (seat, scene)
) strict;
create table networks (
    key text primary key,
    seat integer not null references seats (number),
    scene text not null,
    part text not null,
    file text not null,
    size integer not null,
    verdict text not null check (verdict in ('open', 'right', 'refused')),
    reason text not null,
    request text not null
) strict;
create table tournaments (
    id text primary key,
    scene text not null,
    title text not null,
    phase text not null check (phase in ('open', 'running', 'over', 'cancelled', 'failed')),
    problem text not null
) strict;
create table races (
    id text primary key,
    title text not null,
    scene text not null,
    seed integer not null,
    phase text not null check (phase in ('countdown', 'running', 'over')),
    is_board_hidden integer not null
) strict;
create table race_results (
    key text primary key,
    race text not null references races (id),
    room text not null,
    outcome text not null,
    seconds real not null,
    verdict text not null check (verdict in ('open', 'right', 'refused', 'none')),
    reason text not null
) strict;
"""


@dataclass(frozen=True)
class SeatRow:
    """A seat, as it is stored."""

    number: int
    name: str
    colour: str
    room: str
    state: str


@dataclass(frozen=True)
class TokenRow:
    """A device that holds a seat, as it is stored."""

    hash: bytes
    seat: int
    request: str
    """Id that the browser gave to its join request, so that a repeated one gets the same seat."""


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
        self.folder = folder
        self._lock = threading.Lock()
        self._database = _opened(folder / FILE)

    def close(self) -> None:
        """Close the file."""
        self._database.close()

    def begin_anew(self) -> None:
        """Delete the file with everything in it, and begin another one.

        Raises:
            StoreError: it can't be deleted, or no other one can be made.
        """
        with self._lock:
            self._database.close()
            try:
                for ending in ("", "-wal", "-shm", "-journal"):
                    (self.folder / f"{FILE}{ending}").unlink(missing_ok=True)
                self._database = _opened(self.folder / FILE)
            except (OSError, SetupError) as error:
                raise StoreError(f"The class's file can't be deleted: {error}") from None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def setting(self, name: str, default: str = "") -> str:
        """Return a setting of the class."""
        rows = self.query("select value from settings where name = ?", [name])
        return str(rows[0][0]) if rows else default

    def set_setting(self, name: str, value: str) -> None:
        """Store a setting of the class."""
        with self.transaction() as database:
            database.execute("insert or replace into settings values (?, ?)", [name, value])

    def rooms(self) -> list[RoomRow]:
        """Return all rooms, in the order in which they were made."""
        return [RoomRow(*row) for row in self.query("select id, scene from rooms order by rowid")]

    def seats(self) -> list[SeatRow]:
        """Return all seats, by number."""
        rows = self.query("select number, name, colour, room, state from seats order by number")
        return [SeatRow(*row) for row in rows]

    def tokens(self) -> list[TokenRow]:
        """Return the devices of all seats, the oldest first."""
        rows = self.query("select hash, seat, request from tokens order by rowid")
        return [TokenRow(*row) for row in rows]

    def add_seat(self, seat: SeatRow, token: TokenRow, new_room: RoomRow | None) -> None:
        """Store a new seat with its device, and its room if that is new too: all or nothing."""
        with self.transaction() as database:
            if new_room is not None:
                database.execute("insert into rooms values (?, ?)", [new_room.id, new_room.scene])
            database.execute(
                "insert into seats values (?, ?, ?, ?, ?)",
                [seat.number, seat.name, seat.colour, seat.room, seat.state],
            )
            database.execute(
                "insert into tokens values (?, ?, ?)", [token.hash, token.seat, token.request]
            )

    def update_seat(self, seat: SeatRow, tokens: Iterable[TokenRow] | None = None) -> None:
        """Store a seat's new name and state, and its devices if they are given."""
        with self.transaction() as database:
            database.execute(
                "update seats set name = ?, state = ? where number = ?",
                [seat.name, seat.state, seat.number],
            )
            if tokens is None:
                return
            database.execute("delete from tokens where seat = ?", [seat.number])
            rows = [(each.hash, each.seat, each.request) for each in tokens]
            database.executemany("insert into tokens values (?, ?, ?)", rows)

    def query(self, sql: str, values: Sequence[object] = ()) -> list[tuple[Any, ...]]:
        """Return the rows of a query.

        Raises:
            StoreError: the file can't be read.
        """
        with self._lock:
            try:
                return self._database.execute(sql, values).fetchall()
            except sqlite3.Error as error:
                raise StoreError(f"The class's file can't be read: {error}") from None

    @contextmanager
    def transaction(self) -> Iterator[sqlite3.Connection]:
        """Give the database for changes, all of which are on disk at the end, or none.

        Raises:
            StoreError: they can't be written, say because the disk is full.
        """
        with self._lock:
            try:
                self._database.execute("begin immediate")
                try:
                    yield self._database
                    self._database.execute("commit")
                except BaseException:
                    if self._database.in_transaction:
                        self._database.execute("rollback")
                    raise
            except sqlite3.Error as error:
                raise StoreError(
                    f"The class can't save anything now: {error}. Is its disk full?"
                ) from None


def _opened(path: Path) -> sqlite3.Connection:
    """Return a connection to a class's file, which is made if there is none.

    Raises:
        SetupError: it can't be used, or is of another version.
    """
    try:
        database = sqlite3.connect(path, check_same_thread=False, isolation_level=None)
        database.execute("pragma journal_mode = wal")
        database.execute("pragma synchronous = full")
        database.execute("pragma foreign_keys = on")
        (version,) = database.execute("pragma user_version").fetchone()
        if version == 0:
            database.executescript(f"begin; {_TABLES} pragma user_version = {VERSION}; commit")
    except sqlite3.Error as error:
        raise SetupError(
            f"expected a class's file at {path}, and couldn't use it: {error}"
        ) from None
    if version not in (0, VERSION):
        raise SetupError(
            f"{path} was made by another version of ai4u-edu (tables {version}, expected "
            f"{VERSION}); use another --folder"
        )
    return database


def teacher_token(store: ClassStore) -> str:
    """Return the secret of the teacher's page, which is made once for each class."""
    token = store.setting(TEACHER_SETTING)
    if not token:
        token = token_urlsafe(24)
        store.set_setting(TEACHER_SETTING, token)
    return token
