"""Process of one room of a class: ``ai4u-edu play`` without a terminal, behind the class's port."""

import signal
import threading
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from multiprocessing.connection import Connection
from pathlib import Path

from starlette.applications import Starlette

from ai4u_edu.base.atomic_write import make_folder
from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.base.process_signals import ask_to_end
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.classroom.room_watch import limit_own_files
from ai4u_edu.classroom.scene_file import SceneFile, last_scene, last_seed
from ai4u_edu.locale import gettext as _
from ai4u_edu.member import ClassLinkSettings
from ai4u_edu.missions import mission_map
from ai4u_edu.page.server import Rules, serve
from ai4u_edu.page.server.app import RoomMount
from ai4u_edu.page.server.limits.timeouts import DEFAULT_TIMEOUTS, Timeouts
from ai4u_edu.room import Room, RoomSettings
from ai4u_edu.runtime.process_tuning import released_memory, tuned_process

HOST = "127.0.0.1"
ROOMS_PATH = "/r/"
MAX_FRAMES_PER_S = 15.5
"""Most pictures a second of each page: usually after each fourth of 60 ticks. A class has many
rooms and few cores."""
MIN_FRAMES_PER_S = 15.0
"""Pictures a second if ticks are late."""


@dataclass(frozen=True)
class RoomOrder:
    """Everything that a process needs to know to serve a room."""

    id: str
    scene: str
    folder: Path
    """Folder of the room's files."""
    token: str
    """Secret that the class sends with each request; no browser gets it."""
    blocks: tuple[Path, ...] = ()
    """Python files with the teacher's blocks."""
    class_url: str = ""
    """Address of the class, to which the room opens its link with the token; empty for none."""
    is_shared: bool = False
    """True if several students are in it: then no program of one may halt or restart the world of
    all, unless it drives the only agent."""
    receive_timeout_ms: int = 2000
    """Time for which the world waits for a program's or a script's answer."""
    timeouts: Timeouts = DEFAULT_TIMEOUTS
    """Time limits of the room's server."""
    missions: Path | None = None
    """Folder with the teacher's missions; None for none."""


@dataclass(frozen=True)
class RoomReady:
    """Answer of a process that serves its room: the ports of its server and of its viser."""

    port: int
    viser_port: int


@dataclass(frozen=True)
class RoomFailed:
    """Answer of a process that can't serve its room."""

    reason: str


def path_of(room: str) -> str:
    """Return the path of a room's page, without a slash at the end.

    >>> path_of("a1")
    '/r/a1'
    """
    return f"{ROOMS_PATH}{room}"


def run_room(order: RoomOrder, parent: Connection) -> None:
    """Serve a room until the other end of the connection is closed or SIGTERM comes.

    Args:
        order: the room.
        parent: gets a :class:`RoomReady` or :class:`RoomFailed`.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C in the class's terminal is for the class
    limit_own_files()
    make_folder(order.folder, _("what a room keeps"))
    settings = RoomSettings(
        scene=last_scene(order.folder, order.scene),
        seed=last_seed(order.folder),
        # the class checks both: the name under which a browser has the page is in its requests
        allowed_hosts=("*",),
        rules=_rules(order),
        missions=mission_map(order.missions),
        missions_folder=order.missions,
        saved_scenes=order.folder / "scenes",
        class_link=ClassLinkSettings(order.class_url, order.token) if order.class_url else None,
        learns_in_class=True,
        class_folder=order.folder,
        work=order.folder,
        viser_secret=order.token,
        frames_per_s=MAX_FRAMES_PER_S,
        min_frames_per_s=MIN_FRAMES_PER_S,
    )
    try:
        for file in order.blocks:
            load_blocks(file)
        room = Room(settings)
    except AI4UError as error:
        parent.send(RoomFailed(text_of(error)))
        return
    threading.Thread(target=_end_with, args=[parent], name="parent", daemon=True).start()
    scene_file = SceneFile(order.folder, room.editor, room.runner)
    with tuned_process(), released_memory(), room, scene_file:
        app = Starlette(routes=[RoomMount(path_of(order.id), app=room.page.app)])
        ports = partial(RoomReady, viser_port=room.page.viewer.port)
        ready = partial(_tell, parent, ports)
        serve(app, HOST, 0, on_ready=ready, timeouts=order.timeouts)


def _rules(order: RoomOrder) -> Rules:
    own = not order.is_shared
    return Rules(
        receive_timeout=order.receive_timeout_ms,
        token=order.token,
        seeded_resets=own,
        lockstep=own,
    )


def _tell(parent: Connection, ports: Callable[[int], RoomReady], url: str) -> None:
    parent.send(ports(_port(url)))


def _end_with(parent: Connection) -> None:
    """End this process when the other end is closed: its owner has ended it, or was killed."""
    try:
        parent.recv_bytes()
    except (EOFError, OSError):
        ask_to_end()


def _port(url: str) -> int:
    return int(url.rstrip("/").rpartition(":")[2])
