"""``join_class``, ``leave_class`` and ``submit``: a notebook as a member of a class.

Without ``join_class`` nothing is sent anywhere, and nothing that could send is loaded.
"""

import atexit
from pathlib import Path
from threading import RLock
from typing import TYPE_CHECKING, Literal

from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.lessons.notebook_output import card, put, tell
from ai4u_edu.lessons.progress_file import FOLDER
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

if TYPE_CHECKING:
    from ai4u_edu.lessons.live import Live
    from ai4u_edu.member.notebook import ClassConnection

CHECK_TIMEOUT_S = 60.0
"""Time for which the class's check is waited for; it goes on afterwards."""
NO_CLASS = _(
    'You are in no class. Join it first: `join_class("http://ADDRESS", "CODE")` with the address '
    "and the code on the board, on a JupyterHub `join_class()`. Then run this cell again. Without "
    "a class, networks play each other with: ai4u-edu tournament SCENE ONE.onnx OTHER.onnx"
)

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
    from ai4u_edu.member import NotJoinedError
    from ai4u_edu.member.notebook import join_notebook

    _connect(None)
    try:
        connection = join_notebook(url, code, name_choice, service, Path.cwd() / FOLDER)
    except NotJoinedError as error:
        text = _(
            "{error} Then run this cell again. Your checks work without a class, too.",
            error=text_of(error),
        )
        _tell("vermillion", _("Not joined."), text)
        return
    _connect(connection)
    text = _(
        "You are {name}. Your teacher sees the results of your checks, and the world that you "
        "show. `leave_class()` ends that.",
        name=connection.seat.name,
    )
    _tell("blue", _("Joined."), text)


def leave_class() -> None:
    """Leave the class: nothing more is sent. Your seat is kept for the next ``join_class``."""
    is_member = _connection is not None
    _connect(None)
    text = _("You have left the class. Nothing is sent any more.")
    if not is_member:
        text = _("You are in no class.")
    put(card("grey", _("Class."), [text]), translate(text))


def submit(scene: str, network: str | Path, *, part: str = "") -> None:
    """Hand in a trained network for a tournament of your class; the latest one counts.

    The class lets it play a game against itself before it takes it, and says so if it can't play.
    Without a connection it is kept, and sent later.

    Args:
        scene: name of the tournament's scene, such as ``"sumo"``.
        network: its ONNX file, such as ``"policy.onnx"``.
        part: role or side that the network drives, such as ``"keeper"`` in soccer; empty if it
            drives all of your robots.
    """
    connection = _connection
    if connection is None:
        _tell("grey", _("Not handed in."), NO_CLASS)
        return
    from ai4u_edu.member.notebook import network_in

    try:
        message = network_in(Path(network), scene, part)
    except SetupError as error:
        _tell("vermillion", _("Not handed in."), text_of(error))
        return
    answer = connection.hand_in(message, CHECK_TIMEOUT_S)
    title = _("{file} for {scene}", file=message.file, scene=scene)
    if part:
        title = _("{file} for {scene} ({part})", file=message.file, scene=scene, part=part)
    if answer.refusal:
        text = _("{title}: {refusal}", title=title, refusal=answer.refusal)
        _tell("vermillion", _("Not taken."), text)
    elif answer.is_checked:
        text = _("{title} can play in the tournament. The latest one counts.", title=title)
        _tell("green", _("Handed in."), text)
    elif answer.is_stored:
        text = _("{title} waits for its check. Run this cell again to hear more.", title=title)
        _tell("blue", _("Handed in."), text)
    else:
        text = _(
            "{problem} {title} is sent as soon as it can be.",
            problem=connection.client.problem,
            title=title,
        )
        _tell("blue", _("Kept."), text)


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
        _connection.report(exercise, event, diagnosis)


def class_trouble() -> str:
    """Return a sentence on why the class can't be reached at present; empty if it can."""
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


def _tell(colour: str, sign: str, text: str) -> None:
    tell(colour, sign, [text])


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
