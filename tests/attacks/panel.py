"""A page without a browser, that sends every command of its panel and every message of viser's."""

import json
import random
import threading
import uuid
from collections import Counter
from collections.abc import Mapping
from contextlib import suppress
from typing import Any, Self
from urllib.parse import urljoin

import msgspec
import viser
import zstandard
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection
from websockets.typing import Origin, Subprotocol

from tests.attacks.arguments import (
    ODD_SHARE,
    Known,
    Message,
    arguments,
    draw_command,
    show_message,
    spoilt,
)
from tests.page.server.rooms import open_socket
from tests.waiting import LIMIT_S

POINT = (0.0, 0.0, 0.0)
MAX_WAITING = 3
"""Commands under way after which a page seldom sends another one."""
PATIENT_SHARE = 0.95
"""Probability of sending no further command then."""
FILE_COMMANDS = ("lay_picture", "load_text", "open_recording")


class Panel:
    """One page's sockets to its panel and to viser, through the room's own port.

    A thread for each socket reads; the others' calls only send.

    Args:
        url: of the world, or of a class's room.
        headers: with the cookies of someone who may enter the room.
    """

    def __init__(self, url: str, headers: Mapping[str, str] | None = None) -> None:
        self.known = Known()
        self.answers: Counter[str] = Counter()
        """Answers to commands so far: "done" and "failed"."""
        self._waiting: dict[int, Message] = {}
        """Commands without an answer, by id."""
        self._id = 0
        self._nodes: set[str] = set()
        page = uuid.uuid4()
        protocols = [Subprotocol(f"viser-v{viser.__version__}")]
        self._viser = _opened(
            url, f"?page={page}", subprotocols=protocols, additional_headers=headers
        )
        self._panel = _opened(url, f"ws/panel?page={page}", additional_headers=headers)
        self._readers = [
            threading.Thread(target=target, daemon=True)
            for target in (self._read_panel, self._read_viser)
        ]
        for reader in self._readers:
            reader.start()
        self.say("ViewerCameraMessage", **CAMERA)
        for command in ("drivers", "scenes", "download"):
            self.do(command)
        self.do("gallery", kind="sensors")
        self.send({"type": "show", "agent": "0", "tabs": ["agent", "blocks", "world", "past"]})

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def is_open(self) -> bool:
        """True until either side has closed a socket."""
        return all(reader.is_alive() for reader in self._readers)

    def close(self) -> None:
        """Leave, as a closed tab does."""
        for socket in (self._panel, self._viser):
            socket.close()
        for reader in self._readers:
            reader.join(LIMIT_S)

    def say(self, kind: str, **fields: Any) -> None:
        """Send one message to viser."""
        self._viser.send(msgspec.msgpack.encode({"type": kind, **fields}))

    def send(self, message: Message) -> None:
        """Send one message to the panel's socket."""
        self._panel.send(json.dumps(message))

    def do(self, command: str, **fields: Any) -> None:
        """Send a command."""
        self.send(self._command(command, fields))

    def use_any(self, rng: random.Random) -> None:
        """Send a random message: a command most of the time, odd ones among them."""
        share = rng.random()
        if share < 0.1 or (len(self._waiting) > MAX_WAITING and share < PATIENT_SHARE):
            self._use_picture(rng)
            return
        if share < 0.2:
            message = show_message(self.known, rng)
        else:
            name = draw_command(rng)
            message = self._command(name, arguments(name, self.known, rng))
            if name in FILE_COMMANDS:
                message |= {"size": self._upload(rng)}
        if rng.random() < ODD_SHARE:
            self._waiting.pop(message.get("id", 0), None)
            self._panel.send(spoilt(message, rng))
        else:
            self.send(message)

    def _command(self, name: str, fields: Message) -> Message:
        self._id += 1
        message = {"type": "do", "id": self._id, "command": name, **fields}
        self._waiting[self._id] = message
        return message

    def _upload(self, rng: random.Random) -> int:
        """Send a file, and return its size."""
        data = self.known.scene_file.encode() if rng.random() < 0.5 else rng.randbytes(1000)
        self._panel.send(data)
        return len(data)

    def _use_picture(self, rng: random.Random) -> None:
        """Move the camera, click or drag something, or set a widget that is not there."""
        name = rng.choice(sorted(self._nodes) or ["/bodies0"])
        node = {"name": name, "instance_index": rng.choice((None, 0, 1, 50)), "modifier": None}
        here = tuple(rng.uniform(-10, 10) for _ in range(3))
        match rng.randrange(4):
            case 0:
                self.say("ViewerCameraMessage", **CAMERA | {"look_at": here})
            case 1:
                ray = {"ray_origin": here, "ray_direction": (0.0, 0.0, -1.0)}
                self.say("SceneNodeClickMessage", **node, **ray, screen_pos=(0.5, 0.5))
            case 2:
                places = {"start_position": POINT, "end_position": here, "button": "left"}
                places |= {"start_screen_pos": (0.5, 0.5), "end_screen_pos": (0.6, 0.4)}
                for phase in ("start", "update", "end")[: rng.randint(1, 3)]:
                    self.say("SceneNodeDragMessage", **node, **places, phase=phase)
            case _:
                self.say("GuiUpdateMessage", uuid="none", updates={"value": True})

    def _read_panel(self) -> None:
        with suppress(ConnectionClosed):
            for text in self._panel:
                message = json.loads(text)
                if message["type"] == "part":
                    self.known.note_part(message)
                elif message["type"] in {"done", "failed"}:
                    self.answers[message["type"]] += 1
                    asked = self._waiting.pop(message["id"], None)
                    if message["type"] == "done" and asked is not None:
                        self.known.note_answer(asked, message)

    def _read_viser(self) -> None:
        with suppress(ConnectionClosed):
            for frame in self._viser:
                assert isinstance(frame, bytes)
                names = (message.get("name") for message in unpacked(frame))
                self._nodes = self._nodes | {name for name in names if isinstance(name, str)}


CAMERA: Message = {
    "wxyz": (0.0, 1.0, 0.0, 0.0),
    "position": (3.0, 3.0, 30.0),
    "fov": 0.5,
    "near": 0.1,
    "far": 1000.0,
    "image_height": 600,
    "image_width": 900,
    "look_at": POINT,
    "up_direction": (0.0, 1.0, 0.0),
}


def unpacked(frame: bytes) -> list[Message]:
    """Return the messages in a frame of viser's server."""
    size = int.from_bytes(frame[8:16], "little")
    plain = zstandard.ZstdDecompressor().decompress(
        frame[16 : 16 + size], max_output_size=int.from_bytes(frame[:8], "little")
    )
    messages: list[Message] = msgspec.msgpack.decode(plain)["messages"]
    return messages


def _opened(url: str, path: str, **options: Any) -> ClientConnection:
    return open_socket(
        url + path,
        origin=Origin(urljoin(url, "/").rstrip("/")),
        max_size=None,
        compression=None,
        **options,
    )
