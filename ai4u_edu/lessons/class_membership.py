"""``join_class`` and ``leave_class``: a notebook as a member of a class.

Without ``join_class`` nothing is sent anywhere, and nothing that could send is loaded.
"""

import atexit
import secrets
from pathlib import Path
from threading import RLock
from typing import TYPE_CHECKING, Literal
from urllib.parse import quote

from ai4u_edu.lessons.notebook_output import card, put
from ai4u_edu.lessons.progress_file import FOLDER

if TYPE_CHECKING:
    from ai4u_edu.lessons.class_connection import ClassConnection
    from ai4u_edu.lessons.live import Live
    from ai4u_edu.member import Seat

SEAT_FILE = "class.json"
"""File with the notebook's seat, in the folder of the progress."""

_connection: "ClassConnection | None" = None
_world: "Live | None" = None
"""The world that is shown."""
_lock = RLock()
"""Guards both; a world ends in a thread of its own when its page is gone."""


def join_class(
    url: str = "", code: str = "", *, name_choice: int = 1, service: str = "ai4u-class"
) -> None:
    """Join a class: the teacher sees the results of your checks and the world that you show.

    After a restart of the kernel, the same call gives the same seat. On a JupyterHub with a class,
    call it without arguments: the hub tells the class who you are.

    Args:
        url: address of the class, such as ``"http://192.168.0.10:8080"``; empty on a JupyterHub.
        code: the code on the board; empty on a JupyterHub.
        name_choice: number of the name to get among those that the class offers, from 1.
        service: name of the class's service on a JupyterHub that has several.
    """
    from ai4u_edu.lessons.class_connection import ClassConnection
    from ai4u_edu.member import NotJoinedError

    _connect(None)
    try:
        seat, folder = _take_seat(url, code, name_choice, service)
    except NotJoinedError as error:
        text = f"{error} Then run this cell again. Your checks work without a class, too."
        put(card("vermillion", "Not joined.", [text]), f"Not joined. {text}")
        return
    _connect(ClassConnection(seat, folder))
    text = (
        f"You are {seat.name}. Your teacher sees the results of your checks, and the world that "
        "you show. `leave_class()` ends that."
    )
    put(card("blue", "Joined.", [text]), f"Joined. {text}")


def _take_seat(url: str, code: str, name_choice: int, service: str) -> "tuple[Seat, Path]":
    """Return the notebook's seat, and the folder for its files.

    Raises:
        NotJoinedError: the class gives none.
    """
    from ai4u_edu.member import SeatFile, join_at_hub

    seats = SeatFile(Path.cwd() / FOLDER / SEAT_FILE)
    if url:
        seat = seats.take(url, code, name_choice, "notebook")
        return seat, seats.folder(seat)
    # the token is another one after each start of the server; what was not delivered has to stay
    return join_at_hub(service), seats.path.parent / f"class-at-hub-{quote(service, safe='')}"


def leave_class() -> None:
    """Leave the class: nothing more is sent. Your seat is kept for the next ``join_class``."""
    is_member = _connection is not None
    _connect(None)
    text = "You have left the class. Nothing is sent any more."
    if not is_member:
        text = "You are in no class."
    put(card("grey", "Class.", [text]), text)


def report_event(
    exercise: str, event: Literal["right", "wrong", "hint"], diagnosis: str = ""
) -> None:
    """Tell the class of a check or a hint, if there is a class.

    Args:
        exercise: its id.
        event: result of the check, or that a hint was read.
        diagnosis: id of the mistake that was found, such as ``04.2/narrow``.
    """
    if _connection is not None:
        from ai4u_edu.wire.class_link import ExerciseResult

        key = secrets.token_urlsafe(12)
        _connection.client.renew()  # another notebook of this seat may have taken its place
        _connection.client.send_result(ExerciseResult(key, exercise, event, diagnosis))


def class_trouble() -> str:
    """Return a sentence on why the class can't be told at present; empty if it can."""
    return "" if _connection is None else _connection.client.problem


def current_connection() -> "ClassConnection | None":
    """Return the connection with the class; None without a class."""
    return _connection


def set_world(world: "Live | None") -> None:
    """Note which world is shown; in a class it appears on the teacher's page."""
    global _world
    with _lock:
        if _world is not None:
            _world.leave_class()
        _world = world
        if world is not None and _connection is not None:
            world.join_class(_connection)


def _connect(connection: "ClassConnection | None") -> None:
    """End the connection, and begin another one."""
    global _connection
    with _lock:
        if _world is not None:
            _world.leave_class()
        if _connection is not None:
            _connection.stop()
        _connection = connection
        if connection is not None:
            connection.start()
            if _world is not None:
                _world.join_class(connection)


@atexit.register
def _leave_at_exit() -> None:
    _connect(None)
