"""Names in scene files can't inject HTML or scripts into the page."""

import html
import re
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

import httpx
import msgspec
import viser
import zstandard
from gymnasium.spaces import Box
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.sync.connection import Connection
from websockets.typing import Subprotocol

from ai4u_edu import (
    Actuator,
    BasicAgent,
    BoxShape,
    CircleShape,
    ControlRequestor,
    LocalBrain,
    RayCastingSensor,
    RewardFunc,
    Sensor,
    World,
)
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server import ServerThread, lock_viser_port, room_app
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.panel.remote_lines import lines
from tests.builders import still
from tests.viewer.pages import Page, until

EVIL = "</td><img src=x onerror=alert(1)>{alert(2)}\n```\n<script>alert(3)</script>"


class Odd(Sensor):
    """Reads text that would be a script."""

    def space(self) -> Any:
        from gymnasium.spaces import Text

        return Text(200)

    def read(self, body: Any, view: Any) -> str:
        return EVIL


class Push(Actuator):
    """Does nothing."""

    def space(self) -> Box:
        return Box(-1.0, 1.0, (2,))

    def act(self, body: Any, action: tuple[float, ...]) -> None:
        pass


class Pay(RewardFunc):
    """Pays one."""

    def on_update(self, body: Any, view: Any) -> float:
        return 1.0


class Evil(LocalBrain):
    """Is called what would be a script."""

    def title(self) -> str:
        return EVIL


def evil_sim(action_name: str = EVIL) -> ControlRequestor:
    world = World()
    world.add_area("goal", BoxShape(size=(1, 1)), position=(5, 5), label=EVIL[5:33])
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", BoxShape(size=(1, 1)), position=(3, 0), tags=("target",))
    agent = BasicAgent(
        body="robot",
        sensors=[
            Odd(perception_key=EVIL),
            RayCastingSensor(perception_key="eyes", group_code={"target": 2}),
        ],
        actuators=[Push(action_name=action_name)],
        rewards=[Pay(name=EVIL)],
        brains=[Evil(controller=still)],
    )
    return ControlRequestor(world, [agent], goal=EVIL, success=EVIL)


def contents(message: Any) -> list[str]:
    """The HTML and markdown in a message of viser's, wherever it is."""
    if isinstance(message, dict):
        own = [message["content"]] if isinstance(message.get("content"), str) else []
        own += [message["_markdown"]] if isinstance(message.get("_markdown"), str) else []
        return own + [each for value in message.values() for each in contents(value)]
    if isinstance(message, list | tuple):
        return [each for value in message for each in contents(value)]
    return []


def _unpacked(frame: str | bytes) -> Any:
    """viser's messages: two lengths, msgpack in zstd, and arrays behind it."""
    assert isinstance(frame, bytes)
    plain, packed = (int.from_bytes(frame[at : at + 8], "little") for at in (0, 8))
    raw = zstandard.ZstdDecompressor().decompress(frame[16 : 16 + packed], plain)
    return msgspec.msgpack.decode(raw)


class Reader(Page):
    """Keeps all HTML and markdown that it is told."""

    def __init__(self, connection: Connection) -> None:
        self.pieces: list[str] = []
        super().__init__(connection)

    def _read(self) -> None:
        with suppress(ConnectionClosed):
            for frame in self._connection:
                self.pieces += contents(_unpacked(frame))


@contextmanager
def reader(url: str) -> Iterator[Reader]:
    """A page, by the way that all pages take."""
    with connect(
        url.replace("http", "ws", 1),
        origin=url.rstrip("/"),  # type: ignore[arg-type]  # a NewType of str
        subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
        max_size=None,
        compression=None,
        proxy=None,
    ) as connection:
        here = Reader(connection)
        here.report_camera()
        yield here


def test_no_name_becomes_html() -> None:
    sim = evil_sim()
    runner = Runner(sim, seed=1)
    viewer = Viewer(runner, title=EVIL)
    lock_viser_port(viewer.server)
    runner.start()
    viewer.start()
    try:
        with ServerThread(room_app(runner, viser_port=viewer.port, title=EVIL)) as server:
            document = httpx.get(server.url).text
            health = httpx.get(server.url + "healthz")
            with reader(server.url) as page:
                until(lambda: any("```python" in piece for piece in page.pieces))
                until(lambda: any("Reward" in piece for piece in page.pieces))
                runner.submit(lambda: setattr(runner, "error", EVIL)).result(5)
                until(lambda: any("Stopped" in piece for piece in page.pieces))
                pieces = list(page.pieces)
    finally:
        viewer.stop()
        runner.stop()
    assert f"<title>{html.escape(EVIL)}</title>" in document
    assert "onerror" not in document.replace(html.escape(EVIL), "")
    assert health.headers["Content-Type"] == "application/json"
    markdown = [piece for piece in pieces if "```python" in piece]
    rest = [piece for piece in pieces if "```python" not in piece]
    for piece in rest:
        assert "<img" not in piece, piece
        assert "<script" not in piece, piece
    assert sum("&lt;img" in piece for piece in rest) >= 4  # they are shown: as what they are
    assert any("Stopped" in piece and "&lt;img" in piece for piece in rest)
    assert len(markdown) >= 1
    for piece in markdown:
        assert piece.count("\n```") == 2
        assert re.fullmatch(r"(?s).*```python\n.*\n```\n", piece)


def test_a_name_ends_neither_the_line_nor_the_code() -> None:
    names = (EVIL, "x=[1])\nimport os#", "a b", "class", "'''", "\u2028", "move); quit(")
    for name in names:
        agent = evil_sim(name).agents[0]
        agent_lines = lines("http://teacher:8080/?token=a%20b", agent)
        text = agent_lines.split("```python\n")[1].rsplit("\n```", 1)[0]
        compile(text, "lines", "exec")
        assert text.splitlines()[4] == f"    robot.act({{{name!r}: [1, 0]}})"
        assert len(text.splitlines()) == 6


def test_the_lines_have_the_token_of_a_page_that_has_it() -> None:
    agent = evil_sim("move").agents[0]
    assert (
        "connect('http://teacher:8080/?token=a%20b', agent='0')\nfor percept in robot:\n"
        "    robot.act(move=[1, 0])\n"
    ) in lines("http://teacher:8080/?token=a%20b", agent)
