"""A page without a browser: speaks viser's protocol."""

import contextlib
import threading
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

import msgspec
import viser
import zstandard
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.sync.connection import Connection
from websockets.typing import Subprotocol

from ai4u_edu.page.server.viser_lockdown import PROXY_SECRET, PROXY_SECRET_HEADER
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.sense_overlay import SenseOverlay
from ai4u_edu.page.viewer.viewer_client import AGENT_HEADER, DARK_HEADER
from ai4u_edu.runtime.runner import Runner
from tests.waiting import LIMIT_S, until

P = TypeVar("P")


class Page:
    """Reads whatever viser sends, and says what a test wants said."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self.received = 0
        """Bytes."""
        self.look_at: list[float] = []
        """Where its camera looks, as it was told last; empty before that."""
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def say(self, kind: str, **fields: Any) -> None:
        self._connection.send(msgspec.msgpack.encode({"type": kind, **fields}))

    def report_camera(
        self,
        position: tuple[float, float, float] = (3.0, 3.0, 3.0),
        size: tuple[int, int] = (960, 800),
    ) -> None:
        self.say(
            "ViewerCameraMessage",
            wxyz=(0.0, 1.0, 0.0, 0.0),
            position=position,
            fov=1.0,
            near=0.1,
            far=1000.0,
            image_height=size[1],
            image_width=size[0],
            look_at=(position[0], position[1], 0.0),
            up_direction=(0.0, 1.0, 0.0),
        )

    def click(self, node: str, instance: int | None, owner: str = "") -> None:
        """Clicks on a thing in the scene; an owner has those that are on one page only."""
        self.say(
            "SceneNodeClickMessage",
            name=node,
            instance_index=instance,
            ray_origin=(0.0, 0.0, 1.0),
            ray_direction=(0.0, 0.0, -1.0),
            screen_pos=(0.5, 0.5),
            modifier=None,
            owner=owner,
        )

    def _read(self) -> None:
        unpacker = zstandard.ZstdDecompressor()
        with contextlib.suppress(ConnectionClosed):
            for message in self._connection:
                self.received += len(message)
                assert isinstance(message, bytes)
                packed = message[16 : 16 + int.from_bytes(message[8:16], "little")]
                for each in msgspec.msgpack.decode(unpacker.decompress(packed))["messages"]:
                    if each["type"] == "SetCameraLookAtMessage" and not each["initial"]:
                        self.look_at = each["look_at"]


@contextlib.contextmanager
def page(viewer: Viewer, agent: str = "", *, dark: bool = False) -> Iterator[Page]:
    """Opens a page; it is about an agent, percent-encoded, as the proxy tells it."""
    protocol = Subprotocol(f"viser-v{viser.__version__}")
    with connect(
        f"ws://127.0.0.1:{viewer.port}",
        additional_headers={
            AGENT_HEADER: agent,
            DARK_HEADER: "1" if dark else "",
            PROXY_SECRET_HEADER: PROXY_SECRET,
        },
        subprotocols=[protocol],
        max_size=None,
        compression=None,
        open_timeout=LIMIT_S,
        ping_interval=None,  # a page on a busy machine may be silent for long
    ) as connection:
        here = Page(connection)
        here.report_camera()
        until(lambda: viewer.server.get_clients())
        yield here


def shown(viewer: Viewer) -> None:
    """Draws the latest snapshot on all pages, whatever was drawn when."""
    for part in viewer.parts:
        part.make_due()
        if isinstance(part.part, SenseOverlay):
            turns = part.part._turns
            turns._drawn_at.clear()
            turns._processor_clock = lambda: 0.0  # so that all pages have their turn
    viewer.draw(viewer.runner.latest)


def seen(viewer: Viewer, condition: Callable[[], Any]) -> None:
    """Waits until something is so after a picture."""

    def drawn() -> Any:
        shown(viewer)
        return condition()

    until(drawn)


def part_of(viewer: Viewer, kind: type[P]) -> P:
    """The viewer's part of that kind."""
    (part,) = (each.part for each in viewer.parts if isinstance(each.part, kind))
    return part


def publish(runner: Runner) -> None:
    """Take a snapshot of the world of a runner that stands still."""
    runner._publish()
