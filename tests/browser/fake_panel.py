"""The panel's WebSocket as the page sees it, fed with parts from a file."""

import json
import re
from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from playwright.sync_api import Page, WebSocketRoute

Json = dict[str, Any]
Reply = Callable[[Json], Json]
PARTS: dict[str, Json] = json.loads(Path(__file__).with_name("panel_parts.json").read_text())
"""One part of each name."""


@dataclass
class FakePanel:
    """The server's side of the panel of one page.

    Attributes:
        parts: the parts that it sends when the page connects, by name.
        received: every message of the page.
        replies: functions that return what is added to a command's answer, by the command's name.
    """

    parts: dict[str, Json] = field(default_factory=lambda: deepcopy(PARTS))
    received: list[Json] = field(default_factory=list)
    replies: dict[str, Reply] = field(default_factory=dict)
    urls: list[str] = field(default_factory=list)
    _socket: WebSocketRoute | None = None

    def reset(self) -> None:
        """Forget what came, and take the parts of the file again; the page will be left."""
        self._socket = None  # what the page before says now is no message of the next one
        self.parts = deepcopy(PARTS)
        self.received.clear()
        self.replies.clear()
        self.urls.clear()

    def attach(self, page: Page) -> None:
        """Take the page's panel socket; call it before the page is opened."""
        page.route_web_socket(re.compile(r"/ws/panel"), self._connect)

    def send(self, message: Json) -> None:
        """Send a message to the page."""
        assert self._socket is not None, "the page has not connected"
        self._socket.send(json.dumps(message))

    def change(self, name: str, **changes: Any) -> None:
        """Send a part with changes."""
        self.parts[name] |= changes
        self.send(self.parts[name])

    def let_network_drive(self) -> None:
        """Let a network drive in the person's place."""
        (agent,) = self.parts["scene"]["agents"]
        self.change("scene", agents=[agent | {"driver": "Trained network", "is_person": False}])

    def drop(self) -> None:
        """Lose the connection."""
        assert self._socket is not None
        self._socket.close(code=1011)

    def commands(self, name: str) -> list[Json]:
        """Return the arguments of each command of a name that came."""
        return [
            {key: value for key, value in each.items() if key not in {"type", "id", "command"}}
            for each in self.received
            if each.get("command") == name
        ]

    @property
    def shown(self) -> Json:
        """The last message about what the page looks at."""
        return [each for each in self.received if each["type"] == "show"][-1]

    def _connect(self, socket: WebSocketRoute) -> None:
        self._socket = socket
        self.urls.append(socket.url)
        socket.on_message(lambda text: self._receive(socket, text))
        for part in self.parts.values():
            socket.send(json.dumps(part))

    def _receive(self, socket: WebSocketRoute, text: str | bytes) -> None:
        if socket is not self._socket:
            return
        message = json.loads(text)
        self.received.append(message)
        if message["type"] == "show":  # the real one sends the form of what is chosen now
            for name in message["tabs"]:
                socket.send(json.dumps(self.parts[name]))
            return
        reply = self.replies.get(message["command"])
        answer = {"type": "done", "id": message["id"], "text": "", "items": []}
        answer |= {} if reply is None else reply(message)
        socket.send(json.dumps(answer))
