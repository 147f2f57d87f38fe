"""A page without a browser that knows and uses every element of its panel."""

import random
import threading
from dataclasses import dataclass, field
from typing import Any, Self

import msgspec
import viser
import zstandard
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.typing import Origin, Subprotocol

TEXTS = ("", "a", "wall", "box", "Lesson 1", "0", "-1.5", "ünï", "<b>x</b>", "../../etc", "x" * 300)


@dataclass
class Element:
    """One GUI element: its viser message's kind, and its props as last told."""

    kind: str
    props: dict[str, Any] = field(default_factory=dict)
    value: Any = None

    def likely_value(self, rng: random.Random) -> Any:
        """Return a value such as the element's widget can send; None if it sends none."""
        props = self.props
        match self.kind:
            case "GuiButtonMessage":
                return True
            case "GuiButtonGroupMessage" | "GuiDropdownMessage":
                options = list(props.get("options") or ())
                return rng.choice(options) if options else None
            case "GuiCheckboxMessage":
                return rng.random() < 0.5
            case "GuiTextMessage":
                return rng.choice(TEXTS)
            case "GuiSliderMessage" | "GuiNumberMessage":
                return self._likely_number(rng)
            case "GuiVector2Message" | "GuiVector3Message":
                return [rng.uniform(-10, 10) for _ in range(int(self.kind[9]))]
        return None

    def _likely_number(self, rng: random.Random) -> float:
        low, high = self.props.get("min"), self.props.get("max")
        low = -5.0 if low is None else low
        high = low + 10.0 if high is None else high
        step = self.props.get("step") or 0.0
        value = rng.uniform(low, min(high, low + 1000.0))
        return low + round((value - low) / step) * step if step else value


class Panel:
    """One page's socket to viser, through the room's own port."""

    def __init__(self, url: str) -> None:
        self._socket = connect(
            url.replace("http", "ws", 1).rstrip("/"),
            subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
            origin=Origin(url.rstrip("/")),
            max_size=None,
            compression=None,
            proxy=None,
        )
        self._lock = threading.Lock()
        self._elements: dict[str, Element] = {}
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        self.say(
            "ViewerCameraMessage",
            wxyz=(0.0, 1.0, 0.0, 0.0),
            position=(3.0, 3.0, 30.0),
            fov=0.5,
            near=0.1,
            far=1000.0,
            image_height=600,
            image_width=900,
            look_at=(0.0, 0.0, 0.0),
            up_direction=(0.0, 1.0, 0.0),
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def is_open(self) -> bool:
        """True until either side has closed the socket."""
        return self._reader.is_alive()

    def close(self) -> None:
        """Leave, as a closed tab does."""
        self._socket.close()
        self._reader.join(5)

    def elements(self) -> dict[str, Element]:
        """Return all elements of the panel by their uuid."""
        with self._lock:
            return dict(self._elements)

    def labelled(self, label: str) -> list[str]:
        """Return the uuids of the elements with a label."""
        return [key for key, each in self.elements().items() if each.props.get("label") == label]

    def say(self, kind: str, **fields: Any) -> None:
        """Send one message to viser."""
        self._socket.send(msgspec.msgpack.encode({"type": kind, **fields}))

    def set_value(self, uuid: str, value: Any) -> None:
        """Set an element's value, as its widget does."""
        self.say("GuiUpdateMessage", uuid=uuid, updates={"value": value})

    def use_any(self, rng: random.Random) -> None:
        """Use a random element with a likely value."""
        elements = self.elements()
        if not elements:
            return
        uuid = rng.choice(list(elements))
        if elements[uuid].kind == "GuiFormMessage":
            self.say("GuiFormSubmitMessage", uuid=uuid)
            return
        value = elements[uuid].likely_value(rng)
        if value is not None:
            self.set_value(uuid, value)

    def _read(self) -> None:
        try:
            for frame in self._socket:
                assert isinstance(frame, bytes)
                with self._lock:
                    for message in unpacked(frame):
                        self._note(message)
        except ConnectionClosed:
            pass

    def _note(self, message: dict[str, Any]) -> None:
        kind = message.get("type", "")
        uuid = message.get("uuid")
        if kind == "GuiRemoveMessage":
            self._elements.pop(str(uuid), None)
        elif kind == "GuiUpdateMessage" and uuid in self._elements:
            element, updates = self._elements[uuid], dict(message["updates"])
            if "value" in updates:
                element.value = updates.pop("value")
            element.props.update(updates)
        elif kind.startswith("Gui") and "props" in message and uuid:
            self._elements[uuid] = Element(kind, dict(message["props"]), message.get("value"))


def unpacked(frame: bytes) -> list[dict[str, Any]]:
    """Return the messages in a frame of viser's server."""
    size = int.from_bytes(frame[8:16], "little")
    plain = zstandard.ZstdDecompressor().decompress(
        frame[16 : 16 + size], max_output_size=int.from_bytes(frame[:8], "little")
    )
    messages: list[dict[str, Any]] = msgspec.msgpack.decode(plain)["messages"]
    return messages
