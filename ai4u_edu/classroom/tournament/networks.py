"""Networks that students hand in: the latest one of each seat, scene and part.

A network is data from somebody unknown. The class keeps its bytes; only a process of its own opens
them, see :mod:`ai4u_edu.classroom.tournament.network_check`.
"""

import re
import secrets
import sqlite3
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from threading import Lock
from typing import Literal

from ai4u_edu.base.atomic_write import reason, write_atomically
from ai4u_edu.classroom.errors import NetworkError, StoreError
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.classroom.tournament.network_scene import ALL, network_scenes
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text, packed, unpacked
from ai4u_edu.wire.class_link import MAX_NETWORK_BYTES

FOLDER = "networks"
"""Folder of networks in the class's folder, and in ZIP files with the work of a class."""
MAX_NETWORKS = 12
"""Limit of a seat's networks."""
MAX_FILE_NAME_CHARS = 60
MAX_REASON_CHARS = 300
_COLUMNS = "key, seat, scene, part, file, size, verdict, reason, request"
Verdict = Literal["open", "right", "refused"]


@dataclass(frozen=True)
class NetworkRow:
    """A network, as it is stored."""

    key: str
    """Name of its file, without the ending."""
    seat: int
    scene: str
    """Name of a scene of the library."""
    part: str
    """Role or side that it drives; empty for all agents."""
    file: str
    """Name of the student's file."""
    size: int
    """Bytes."""
    verdict: Verdict
    """``open``: to be checked; ``right``: it can play."""
    reason: str = ""
    """Reason for which it was refused."""
    request: str = ""
    """Key of the link's message that brought it; empty for one that a page sent."""

    @property
    def place(self) -> tuple[int, str, str]:
        """Seat, scene and part, of which the latest network counts."""
        return self.seat, self.scene, self.part


class Networks:
    """The networks of a class. Thread-safe; what a method has written is on disk when it returns.

    Args:
        store: of the class.
        on_change: called after each change, in the thread that makes it.
    """

    def __init__(self, store: ClassStore, on_change: Callable[[int], object]) -> None:
        self._store, self._on_change = store, on_change
        self._lock = Lock()
        self.read()

    def read(self) -> None:
        """Read all from the store."""
        rows = self._store.query(f"select {_COLUMNS} from networks order by rowid")  # noqa: S608
        self.rows = tuple(NetworkRow(*row) for row in rows)
        """All networks, in the order in which they came."""

    def clear(self) -> None:
        """Forget all in memory, because everything will be deleted."""
        with self._lock:
            self.rows = ()

    def delete(self, seat: int) -> None:
        """Delete the networks of a seat.

        Raises:
            StoreError: they can't be deleted; then nothing has changed.
        """
        with self._lock:
            gone = [each for each in self.rows if each.seat == seat]
            with self._store.transaction() as database:
                _delete(database, gone)
            self.rows = tuple(each for each in self.rows if each not in gone)
            for each in gone:
                self._unlink(each)

    def add(
        self, seat: int, scene: str, part: str, file: str, data: bytes, request: str = ""
    ) -> bool:
        """Keep a network in the place of one before that was not checked yet, or was refused.

        One that can play stays until the new one has been checked.

        Args:
            seat: number of the seat.
            scene: name of a scene of the library.
            part: role or side that it drives; empty for all agents.
            file: name of the student's file.
            data: its content.
            request: key of the link's message; a key that came before changes nothing.

        Returns:
            False for a key that came before.

        Raises:
            NetworkError: it can't be taken; a sentence for the student.
            StoreError: it can't be written.
        """
        check_network(scene, part, file, len(data))
        row = NetworkRow(
            secrets.token_hex(8),
            seat,
            scene,
            part,
            _file_name(file),
            len(data),
            "open",
            "",
            request,
        )
        with self._lock:
            replaced = [each for each in self.rows if each.place == row.place]
            if not replaced and sum(each.seat == seat for each in self.rows) >= MAX_NETWORKS:
                raise NetworkError(
                    _(
                        "The class keeps at most {most} networks of each student, and you have "
                        "handed in that many.",
                        most=MAX_NETWORKS,
                    )
                )
            gone = [each for each in replaced if each.verdict != "right"]
            self._write(row, data)
            try:
                is_new = self._insert(row, gone)
            except BaseException:
                self._unlink(row)
                raise
            if not is_new:
                self._unlink(row)
                return False
            self.rows = (*(each for each in self.rows if each not in gone), row)
            for each in gone:
                self._unlink(each)
        self._on_change(seat)
        return True

    def next_open(self, order: Callable[[int], float] = lambda _seat: 0.0) -> NetworkRow | None:
        """Return the network to check next: of those that wait, the one handed in first.

        Args:
            order: of the seats; networks of one with a smaller number come before.
        """
        waiting = (each for each in self.rows if each.verdict == "open")
        return min(waiting, key=lambda row: order(row.seat), default=None)

    def judge(self, row: NetworkRow, reason: str) -> None:
        """Note the verdict on a network; one that was replaced meanwhile has none.

        Args:
            row: the network.
            reason: for which it is refused; empty if it can play.

        Raises:
            StoreError: it can't be stored; then nothing has changed.
        """
        stored = packed(reason, MAX_REASON_CHARS)[:MAX_REASON_CHARS]
        judged = replace(row, verdict="refused" if reason else "right", reason=unpacked(stored))
        with self._lock:
            if row not in self.rows:
                return
            others = [each for each in self.rows if each.place == row.place and each != row]
            gone = [] if reason else others
            with self._store.transaction() as database:
                database.execute(
                    "update networks set verdict = ?, reason = ? where key = ?",
                    [judged.verdict, stored, row.key],
                )
                _delete(database, gone)
            kept = (each for each in self.rows if each not in gone)
            self.rows = tuple(judged if each == row else each for each in kept)
            for each in [*gone, *([judged] if reason else [])]:
                self._unlink(each)
        self._on_change(row.seat)

    def of_seat(self, seat: int) -> list[NetworkRow]:
        """Return a seat's networks, in the order in which they came."""
        return [each for each in self.rows if each.seat == seat]

    def playing(self, scene: str) -> list[NetworkRow]:
        """Return the networks that can play in a scene."""
        return [each for each in self.rows if each.scene == scene and each.verdict == "right"]

    def path_of(self, row: NetworkRow) -> Path:
        """Return the path of a network's file; a refused one has none."""
        return self._store.folder / FOLDER / f"{row.key}.onnx"

    def _write(self, row: NetworkRow, data: bytes) -> None:
        path = self.path_of(row)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(path, data)
        except OSError as error:
            text = _("The class can't save a network: {reason}.", reason=reason(error))
            raise StoreError(text) from None

    def _insert(self, row: NetworkRow, gone: list[NetworkRow]) -> bool:
        values = (
            row.key,
            *row.place,
            row.file,
            row.size,
            row.verdict,
            packed(row.reason),
            row.request,
        )
        with self._store.transaction() as database:
            if row.request:
                # as with any result, a key that came is known for ever
                cursor = database.execute(
                    "insert or ignore into results values (?, '', ?, 'network', 0)",
                    [row.request, row.scene],
                )
                if cursor.rowcount == 0:
                    return False
            _delete(database, gone)
            database.execute(
                f"insert into networks ({_COLUMNS}) values (?, ?, ?, ?, ?, ?, ?, ?, ?)",  # noqa: S608
                values,
            )
        return True

    def _unlink(self, row: NetworkRow) -> None:
        with suppress(OSError):  # it counts for nothing, and goes with the folder
            self.path_of(row).unlink(missing_ok=True)


def check_network(scene: str, part: str, file: str, size: int) -> None:
    """Check what is known of a network without opening it.

    Args:
        scene: name of a scene.
        part: role or side that it is to drive; empty for all agents.
        file: name of its file.
        size: bytes.

    Raises:
        NetworkError: it can't be taken; a sentence for the student.
    """
    known = network_scenes().get(scene)
    if known is None:
        raise NetworkError(
            _(
                "scene: expected one of {names}, got {scene!r}.",
                names=", ".join(network_scenes()),
                scene=scene[:60],
            )
        )
    if part != ALL and part not in known.parts:
        raise NetworkError(
            _(
                "part: {scene} has these parts: {parts}; got {part!r}.",
                scene=library_text(known.title),
                parts=", ".join(known.parts) or _("none"),
                part=part[:60],
            )
        )
    if not file.lower().endswith(".onnx"):
        raise NetworkError(
            _(
                "Expected a network as an .onnx file, got {file!r}. A training writes one; so "
                "does: ai4u-edu export MODEL --out policy.onnx",
                file=file[-60:],
            )
        )
    if size == 0:
        text = _("This file is empty. Choose the .onnx file that your training wrote.")
        raise NetworkError(text)
    if size > MAX_NETWORK_BYTES:
        raise NetworkError(TOO_LARGE)


TOO_LARGE = _(
    "This file is too large: a network may have at most {size} MB. Train one with fewer or smaller "
    "layers.",
    size=MAX_NETWORK_BYTES // 2**20,
)


def _delete(database: sqlite3.Connection, rows: list[NetworkRow]) -> None:
    database.executemany("delete from networks where key = ?", [(each.key,) for each in rows])


def _file_name(text: str) -> str:
    r"""Return a file's name without its folder and without strange characters.

    >>> _file_name("C:\\nets\\<b>my net.onnx")
    '_b_my net.onnx'
    """
    name = re.sub(r"[^\w .()-]", "_", re.split(r"[\\/]", text)[-1])
    return name[-MAX_FILE_NAME_CHARS:].strip() or "network.onnx"
