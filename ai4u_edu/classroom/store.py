"""A class on disk, in one SQLite file: its code, rooms and seats, and the tables of its results.

Results, progress, assignments, programs, stars and races are read and written by the modules that
own them, through :meth:`ClassStore.query` and :meth:`ClassStore.transaction`.
"""

import logging
import os
import shutil
import sqlite3
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from secrets import token_urlsafe
from typing import Any, Self, TypeVar

from pydantic import BaseModel, ValidationError

from ai4u_edu.base.atomic_write import make_folder, make_private, reason
from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.base.file_lock import FileLock, LockedError
from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.folder_quota import MAX_GB, FolderQuota
from ai4u_edu.locale import gettext as _

Model = TypeVar("Model", bound=BaseModel)
_logger = logging.getLogger(__name__)

FILE = "class.sqlite3"
LOCK_FILE = "class.lock"
_ENDINGS = ("", "-wal", "-shm", "-journal")
"""Endings of the files of the database, to be put after its name."""
TEACHER_SETTING = "teacher_token"
"""Name of the setting with the secret of the teacher's page."""
VERSION = 13
"""Version of the tables; a file of a later one is not opened, and neither is one from which
:data:`_STEPS` do not lead here."""
ROOMS = "rooms"
"""Folder in the class's folder with one for each room."""
PRESENT_ROOM = "present_room_"
"""Beginning of the name of a setting with the room that a seat used last."""
_MISSION_TABLES = """create table missions (
    seat integer not null references seats (number),
    mission text not null,
    steps integer not null,
    stars integer not null,
    primary key (seat, mission)
) strict;
create table mission_places (
    seat integer primary key references seats (number),
    mission text not null,
    step integer not null,
    is_done integer not null,
    hint text not null,
    hints integer not null
) strict;
"""
_TABLES = f"""
create table settings (name text primary key, value text not null) strict;
create table rooms (id text primary key, scene text not null) strict;
create table seats (
    number integer primary key,
    name text not null unique,
    colour text not null,
    room text not null references rooms (id),
    state text not null check (state in ('in', 'left', 'kicked', 'banned')),
    opened integer not null
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
create index results_of_room on results (room);
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
create table wrong_answers (
    room text primary key,
    exercise text not null,
    diagnosis text not null,
    count integer not null
) strict;
create table assignments (
    room text primary key,
    id text not null,
    title text not null,
    scene text not null,
    seed integer,
    lesson text not null,
    program text not null,
    mission text not null default ''
) strict;
create table programs (
    seat integer not null references seats (number),
    scene text not null,
    agent text not null,
    source text not null,
    version integer not null,
    device text not null,
    saved_at real not null,
    primary key (seat, scene, agent)
) strict;
create table program_runs (
    seat integer primary key references seats (number),
    state text not null check (state in ('running', 'mistake', 'ended')),
    kind text not null,
    text text not null,
    line integer not null
) strict;
create table program_mistakes (
    seat integer not null references seats (number),
    kind text not null,
    text text not null,
    count integer not null,
    primary key (seat, kind)
) strict;
create table stars (
    seat integer not null references seats (number),
    scene text not null,
    count integer not null,
    primary key (seat, scene)
) strict;
{_MISSION_TABLES}create table networks (
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
create table trainings (
    room text primary key,
    key text not null,
    training text not null,
    files text not null
) strict;
create table practices (
    key text primary key,
    room text not null,
    state text not null
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


_STEPS = {
    12: f"{_MISSION_TABLES}alter table assignments add column mission text not null default '';",
}
"""Changes that make tables of a version into those of the next one."""
_TABLES_OF_WORK = (
    *("programs", "program_runs", "program_mistakes"),
    *("stars", "missions", "mission_places", "networks", "progress", "diagnoses"),
)
"""Tables with the work of seats."""


@dataclass(frozen=True)
class SeatRow:
    """A seat, as it is stored."""

    number: int
    name: str
    colour: str
    room: str
    state: str
    is_opened: bool = False
    """True once its room was opened, or a world of its own was connected."""


@dataclass(frozen=True)
class TokenRow:
    """A device that holds a seat, as it is stored."""

    hash: bytes
    seat: int
    request: str
    """Digest of the id that the browser gave to its join request, so that a repeated one gets the
    same seat."""


@dataclass(frozen=True)
class RoomRow:
    """A room, as it is stored."""

    id: str
    scene: str


class ClassStore:
    """The class's file. Thread-safe; what a method has written is on disk when it returns.

    It has secrets, so that nobody but its owner may read it. One process at a time has the folder,
    by a lock that ends with the process.

    Args:
        folder: of the class; created if needed.
        max_gb: limit of the folder's size (GB).

    Raises:
        SetupError: the folder can't be written to, holds a class of another version, or another
            class runs in it.
    """

    def __init__(self, folder: Path, max_gb: float = MAX_GB) -> None:
        make_folder(folder, _("what a class keeps"), is_private=True)
        self.folder, self.quota = folder, FolderQuota(folder, max_gb)
        self._lock = threading.Lock()
        self._folder_lock = _locked(folder)
        try:
            self._database = _opened(folder / FILE)
        except BaseException:
            self._folder_lock.release()
            raise

    def close(self) -> None:
        """Close the file."""
        self._database.close()
        self._folder_lock.release()

    def begin_anew(self) -> None:
        """Delete the file with everything in it, and begin another one.

        Raises:
            StoreError: it can't be deleted, or no other one can be made.
        """
        with self._lock:
            self._database.close()
            try:
                for ending in _ENDINGS:
                    (self.folder / f"{FILE}{ending}").unlink(missing_ok=True)
                self._database = _opened(self.folder / FILE)
            except (OSError, SetupError) as error:
                raise StoreError(
                    _("The class's file can't be deleted: {problem}", problem=text_of(error))
                ) from None

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

    def setting_or(self, name: str, make: Callable[[], str]) -> str:
        """Return a setting, which is made and stored if there is none: the same to all threads."""
        value = self.setting(name)
        if value:
            return value
        with self.transaction() as database:
            # read again: another thread may have stored one since
            row = database.execute("select value from settings where name = ?", [name]).fetchone()
            value = str(row[0]) if row else ""
            if not value:
                value = make()
                database.execute("insert or replace into settings values (?, ?)", [name, value])
        return value

    def setting_as(self, name: str, model: type[Model]) -> Model:
        """Return a setting that is JSON; the model's default if there is none, or another text."""
        try:
            return model.model_validate_json(self.setting(name) or "{}")
        except ValidationError:
            _logger.warning("the class's setting %r is damaged; it begins again", name)
            return model()

    def rooms(self) -> list[RoomRow]:
        """Return all rooms, in the order in which they were made."""
        return [RoomRow(*row) for row in self.query("select id, scene from rooms order by rowid")]

    def seats(self) -> list[SeatRow]:
        """Return all seats, by number."""
        rows = self.query(
            "select number, name, colour, room, state, opened from seats order by number"
        )
        return [
            SeatRow(number, name, colour, room, state, bool(opened))
            for number, name, colour, room, state, opened in rows
        ]

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
                "insert into seats values (?, ?, ?, ?, ?, ?)",
                [seat.number, seat.name, seat.colour, seat.room, seat.state, seat.is_opened],
            )
            database.execute(
                "insert into tokens values (?, ?, ?)", [token.hash, token.seat, token.request]
            )

    def update_seat(self, seat: SeatRow, tokens: Iterable[TokenRow] | None = None) -> None:
        """Store a seat's new name and state, and its devices if they are given."""
        with self.transaction() as database:
            database.execute(
                "update seats set name = ?, state = ?, opened = ? where number = ?",
                [seat.name, seat.state, seat.is_opened, seat.number],
            )
            if tokens is None:
                return
            database.execute("delete from tokens where seat = ?", [seat.number])
            rows = [(each.hash, each.seat, each.request) for each in tokens]
            database.executemany("insert into tokens values (?, ?, ?)", rows)

    def remove_unused_seat(self, seat: SeatRow) -> bool:
        """Delete a seat with its devices, and its room if nobody else has it.

        Returns:
            False if there is work of the seat; then it is kept.
        """
        with self.transaction() as database:
            for table in _TABLES_OF_WORK:
                found = f"select 1 from {table} where seat = ? limit 1"  # noqa: S608 - ours
                if database.execute(found, [seat.number]).fetchone():
                    return False
            database.execute("delete from tokens where seat = ?", [seat.number])
            database.execute("delete from seats where number = ?", [seat.number])
            database.execute(
                "delete from rooms where id = ? and id not in (select room from seats)",
                [seat.room],
            )
        return True

    def delete_seat(self, seat: SeatRow, rooms: Iterable[str]) -> None:
        """Delete everything of a seat and of rooms, so that nobody can read it from the file.

        Raises:
            StoreError: it can't be deleted; then nothing has changed.
        """
        with self.transaction() as database:
            database.execute("pragma defer_foreign_keys = on")
            columns = database.execute(
                "select t.name, c.name from pragma_table_list t, pragma_table_info(t.name) c "
                "where t.schema = 'main' and t.type = 'table' and c.name in ('seat', 'room') "
                "and t.name <> 'seats'"
            ).fetchall()
            for table, column in columns:  # of later tables, too
                values = [(seat.number,)] if column == "seat" else [(room,) for room in rooms]
                delete = f"delete from {table} where {column} = ?"  # noqa: S608 - ours
                database.executemany(delete, values)
            database.execute("delete from seats where number = ?", [seat.number])
            database.executemany("delete from rooms where id = ?", [(room,) for room in rooms])
            present = f"{PRESENT_ROOM}{seat.number}"
            database.execute("delete from settings where name = ?", [present])
        self.query("pragma wal_checkpoint(truncate)")  # the log has pages as they were before

    def room_folder(self, room: str) -> Path:
        """Return the folder of what a room keeps."""
        return self.folder / ROOMS / room

    def delete_folders(self, *names: str) -> None:
        """Delete folders of the class's folder that are there.

        Raises:
            StoreError: one can't be deleted.
        """
        for name in names:
            folder = self.folder / name
            try:
                if folder.exists():
                    shutil.rmtree(folder)
            except OSError as error:
                raise StoreError(
                    _(
                        "{folder} can't be deleted: {reason}. Delete it yourself.",
                        folder=str(folder),
                        reason=reason(error),
                    )
                ) from None

    def query(self, sql: str, values: Sequence[object] = ()) -> list[tuple[Any, ...]]:
        """Return the rows of a query.

        Raises:
            StoreError: the file can't be read.
        """
        with self._lock:
            try:
                return self._database.execute(sql, values).fetchall()
            except sqlite3.Error as error:
                raise StoreError(
                    _("The class's file can't be read: {cause}", cause=_cause(error))
                ) from None

    @contextmanager
    def transaction(self) -> Iterator[sqlite3.Connection]:
        """Give the database for changes, all of which are on disk at the end, or none.

        Raises:
            StoreError: they can't be written; its sentence says why.
        """
        with self._lock:
            try:
                # immediate: take the write lock now, and not with the first change in the middle
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
                    _("The class can't save anything now: {cause}", cause=_cause(error))
                ) from None


def _opened(path: Path) -> sqlite3.Connection:
    """Return a connection to a class's file, which is made if there is none.

    Raises:
        SetupError: it can't be used, or is of another version.
    """
    try:
        _prepare_file(path)
        # any thread may use it, one at a time (`_lock`); transactions are begun by hand
        database = sqlite3.connect(path, check_same_thread=False, isolation_level=None)
        database.execute("pragma journal_mode = wal")
        # with WAL, less than full may lose the last commits at a power cut
        database.execute("pragma synchronous = full")
        database.execute("pragma foreign_keys = on")
        database.execute("pragma secure_delete = on")  # what is deleted is overwritten
        (version,) = database.execute("pragma user_version").fetchone()
        # in one transaction: after a kill in the middle, the next start makes the tables
        if version == 0:
            database.executescript(f"begin; {_TABLES} pragma user_version = {VERSION}; commit")
            version = VERSION
        while version in _STEPS:
            change = _STEPS[version]
            version += 1
            database.executescript(f"begin; {change} pragma user_version = {version}; commit")
    except sqlite3.Error as error:
        raise SetupError(
            _(
                "expected a class's file at {path}, and couldn't use it: {cause}",
                path=str(path),
                cause=_cause(error),
            )
        ) from None
    except OSError as error:
        raise SetupError(
            _(
                "expected a class's file at {path}, and couldn't use it: {reason}",
                path=str(path),
                reason=reason(error),
            )
        ) from None
    if version != VERSION:
        database.close()
        raise SetupError(
            _(
                "{path} was made by another version of ai4u-edu (tables {version}, expected "
                "{expected}); use another --folder",
                path=str(path),
                version=version,
                expected=VERSION,
            )
        )
    return database


def _locked(folder: Path) -> FileLock:
    """Return the lock of a class's folder.

    Raises:
        SetupError: another process has it.
    """
    try:
        lock = FileLock(folder / LOCK_FILE)
    except LockedError:
        raise SetupError(
            _(
                "{folder}: another class runs in this folder; end that one first, or give "
                "this one another --folder",
                folder=str(folder),
            )
        ) from None
    except OSError as error:
        raise SetupError(
            _("{folder}: it can't be locked: {reason}", folder=str(folder), reason=reason(error))
        ) from None
    make_private(lock.path)
    return lock


def _prepare_file(path: Path) -> None:
    """Make a database's file if there is none, and let only its owner read it and what is beside.

    SQLite gives the files beside it the same permissions.
    """
    os.close(os.open(path, os.O_RDWR | os.O_CREAT, 0o600))
    for ending in _ENDINGS:
        make_private(path.with_name(f"{path.name}{ending}"))


_DAMAGED = _("The file is damaged. Put a copy in its place, or use another --folder.")
_CAUSES = {
    sqlite3.SQLITE_FULL: _("The disk is full. Make room on it."),
    sqlite3.SQLITE_IOERR: _("The disk can't be read or written. Is it full, or was it taken out?"),
    sqlite3.SQLITE_READONLY: _(
        "The file may not be written to. Allow it in the folder's settings."
    ),
    sqlite3.SQLITE_PERM: _("The file may not be written to. Allow it in the folder's settings."),
    sqlite3.SQLITE_CANTOPEN: _("The file can't be opened. Is its folder still there?"),
    sqlite3.SQLITE_BUSY: _("Another program has the file open. Close that program."),
    sqlite3.SQLITE_LOCKED: _("Another program has the file open. Close that program."),
    sqlite3.SQLITE_CORRUPT: _DAMAGED,
    sqlite3.SQLITE_NOTADB: _DAMAGED,
    sqlite3.SQLITE_CONSTRAINT: _("This is a mistake of ai4u-edu; please report it."),
}
"""Sentences about errors of SQLite, by their primary code."""


def _cause(error: sqlite3.Error) -> str:
    """Return what an error of SQLite says, and what to do about it if that is known."""
    code = getattr(error, "sqlite_errorcode", None)  # not set by the module's own errors
    # an extended code has the primary one in its lowest byte
    sentence = "" if code is None else _CAUSES.get(code & 0xFF, "")
    if not sentence:
        return f"{error}."
    return _("{sentence} ({problem})", sentence=sentence, problem=str(error))


def teacher_token(store: ClassStore) -> str:
    """Return the secret of the teacher's page, which is made once for each class."""
    return store.setting_or(TEACHER_SETTING, lambda: token_urlsafe(24))
