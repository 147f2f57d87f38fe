"""A served world with our panel, and pages that speak the panel's protocol."""

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import Any, Self
from unittest.mock import patch

import viser
from websockets.exceptions import ConnectionClosed
from websockets.sync.connection import Connection
from websockets.typing import Subprotocol

from ai4u_edu import Scene
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.panel import PanelContext
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.viewer_client import ViewerClient
from ai4u_edu.recording import Recorder
from ai4u_edu.room import serve_world
from ai4u_edu.runtime import tick_monitor
from ai4u_edu.runtime.frame_budget import FrameBudget
from ai4u_edu.runtime.runner import Runner
from tests.load.clients import CAMERA
from tests.page.server.rooms import PATIENT, open_socket
from tests.waiting import LIMIT_S, Deadline, until

Message = dict[str, Any]


@dataclass
class PanelRoom:
    """A served scene."""

    runner: Runner
    viewer: Viewer
    editor: SceneEditor
    context: PanelContext
    url: str

    def page(self, query: str = "") -> "PanelPage":
        return PanelPage(self.url + "ws/panel" + query)


@contextmanager
def panel_room(
    scene: str = "box_chase", *, can_edit: bool = True, frames: FrameBudget | None = None
) -> Iterator[PanelRoom]:
    """Serve a scene of the library, paused."""
    loaded = Scene.load(scene)
    sim = loaded.build()
    recorder = Recorder(sim, scene=loaded.description)
    runner = Runner(sim, seed=1, recorder=recorder, frame_budget=frames)
    editor = SceneEditor(runner, loaded)
    runner.paused = True
    with patch.object(tick_monitor, "STALL_S", LIMIT_S):  # else a page is told of it
        runner.start()
        world = serve_world(runner, editor=editor if can_edit else None, timeouts=PATIENT)
        try:
            yield PanelRoom(runner, world.viewer, editor, world.context, world.url)
        finally:
            world.stop()
            runner.stop(LIMIT_S)


class PanelPage:
    """Client of the panel's socket."""

    def __init__(self, url: str, **options: Any) -> None:
        options.setdefault("max_size", None)
        self.socket = open_socket(url, **options)
        self.parts: dict[str, Message] = {}
        self.others: list[Message] = []
        self._id = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.socket.close()

    def send(self, message: Message) -> None:
        self.socket.send(json.dumps(message))

    def show(self, agent: str = "0", *tabs: str, **more: Any) -> None:
        self.send({"type": "show", "agent": agent, "tabs": list(tabs), **more})

    def do(self, command: str, **arguments: Any) -> Message:
        """Send a command, and return its answer."""
        self._id += 1
        self.send({"type": "do", "id": self._id, "command": command, **arguments})
        return self.receive(lambda m: m["type"] in {"done", "failed"} and m["id"] == self._id)

    def done(self, command: str, **arguments: Any) -> Message:
        """Send a command that has to succeed, and return its answer."""
        answer = self.do(command, **arguments)
        assert answer["type"] == "done", answer
        return answer

    def failed(self, command: str, **arguments: Any) -> Message:
        """Send a command that has to fail, and return its answer."""
        answer = self.do(command, **arguments)
        assert answer["type"] == "failed", answer
        return answer

    def part(
        self, name: str, condition: Callable[[Message], Any] = lambda _: True, **wanted: Any
    ) -> Message:
        """Return a part, as soon as its fields have these values and a condition holds."""

        def fits(message: Message) -> Any:
            return wanted.items() <= message.items() and condition(message)

        found = self.parts.get(name)
        if found is not None and fits(found):
            return found
        return self.receive(lambda m: m["type"] == "part" and m["name"] == name and fits(m))

    def receive(self, condition: Callable[[Message], Any]) -> Message:
        """Return the next message for which a condition holds; keep all parts."""
        deadline = Deadline()
        while True:
            message: Message = json.loads(self.socket.recv(deadline.left()))
            if message["type"] == "part":
                self.parts[message["name"]] = message
            else:
                self.others.append(message)
            if condition(message):
                return message

    def end(self) -> tuple[int, str]:
        """Wait for the close, and return its code and reason."""
        deadline = Deadline()
        while True:
            try:
                self.socket.recv(deadline.left())
            except ConnectionClosed as closed:
                return (closed.rcvd.code, closed.rcvd.reason) if closed.rcvd else (1006, "")


@contextmanager
def picture(room: PanelRoom, page_id: str) -> Iterator[ViewerClient]:
    """Open viser's socket of a page through the proxy, as its picture does."""
    address = f"{room.url}?page={page_id}"
    protocol = Subprotocol(f"viser-v{viser.__version__}")
    with open_socket(address, subprotocols=[protocol], max_size=None) as connection:
        connection.send(CAMERA)
        until(lambda: room.viewer.viewer_clients.find(page_id))
        client = room.viewer.viewer_clients.find(page_id)
        assert client is not None
        reader = threading.Thread(target=_read, args=(connection,), daemon=True)
        reader.start()
        yield client


def _read(connection: Connection) -> None:
    with suppress(ConnectionClosed):
        for _ in connection:
            pass
