"""Ink and speech bubbles in the page's picture."""

import io
from collections.abc import Iterator
from fnmatch import fnmatch
from typing import Any

import numpy as np
import pytest
import viser
from PIL import Image

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.page.viewer.backend.broadcast import VISER_VERSION
from ai4u_edu.page.viewer.backend.local_server import LocalServer
from ai4u_edu.page.viewer.scene.ground import INK_PIXELS, DrawnInk
from ai4u_edu.page.viewer.scene.labels import SpeechBubbles
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.theme import ink_pixels, latest_said
from ai4u_edu.world.ink import TILE_M, ink_code

BLUE = ink_code("blue")


@pytest.fixture
def server() -> Iterator[LocalServer]:
    server = LocalServer("traces")
    yield server
    server.stop()


def nodes(server: LocalServer, pattern: str) -> list[str]:
    """Return the names of scene nodes; viser adds their parents by itself."""
    return sorted(name for name in server.scene._handle_from_node_name if fnmatch(name, pattern))


def messages(server: LocalServer) -> int:
    return server._websock_server._broadcast_buffer.message_counter


def test_only_tiles_that_have_changed_are_sent(server: LocalServer) -> None:
    sim = Scene.load("draw_figure").build()
    sim.reset(1)
    ink, drawn = sim.world.ink, DrawnInk(server)

    def draw() -> int:
        before = messages(server)
        snapshot = capture_snapshot(sim)
        drawn.build(snapshot.static_scene)
        drawn.draw(snapshot)
        return messages(server) - before

    assert draw() == 0
    ink.draw((0.5, 0.5), (0.6, 0.5), 0.0, 0.2, BLUE)
    ink.draw((-0.5, 0.5), (-0.6, 0.5), 0.0, 0.2, BLUE)
    assert draw() > 0
    assert nodes(server, "/ink/*/*/*") == ["/ink/0/-1/0", "/ink/0/0/0"]
    assert draw() == 0
    ink.draw((1.5, 0.5), (1.6, 0.5), 0.0, 0.2, BLUE)
    assert draw() == 1
    sim.reset(2)
    draw()
    assert nodes(server, "/ink/*/*/*") == []


@pytest.mark.parametrize("version", [VISER_VERSION, "another"])
def test_a_tile_that_changes_is_the_picture_of_its_ink(
    server: LocalServer, monkeypatch: pytest.MonkeyPatch, version: str
) -> None:
    monkeypatch.setattr(viser, "__version__", version)
    sim = Scene.load("draw_figure").build()
    sim.reset(1)
    ink, drawn = sim.world.ink, DrawnInk(server)
    for number, colour in enumerate(["blue", "orange", "none"]):
        start = 0.5 + 0.2 * number, 0.5
        ink.draw(start, (1.0, 0.7), 0.0, 0.2, ink_code(colour))
        snapshot = capture_snapshot(sim)
        drawn.build(snapshot.static_scene)
        drawn.draw(snapshot)
    (name,) = nodes(server, "/ink/*/*/*")
    image: Any = server.scene._handle_from_node_name[name]
    sent = Image.open(io.BytesIO(image._data)).convert("RGBA")
    (tile,) = ink.image().tiles.values()
    expected = ink_pixels(tile).repeat(INK_PIXELS, axis=0).repeat(INK_PIXELS, axis=1)
    shown = np.asarray(sent)
    assert np.array_equal(shown[..., 3], expected[..., 3])
    assert np.array_equal(shown[expected[..., 3] > 0], expected[expected[..., 3] > 0])
    assert 0 < expected[..., 3].mean() < 255


def test_a_tile_lies_where_its_ink_is(server: LocalServer) -> None:
    sim = Scene.load("draw_figure").build()
    sim.reset(1)
    sim.world.ink.draw((0.1, 3.1), (0.15, 3.1), 0.0, 0.1, BLUE)
    drawn, snapshot = DrawnInk(server), capture_snapshot(sim)
    drawn.build(snapshot.static_scene)
    drawn.draw(snapshot)
    (name,) = nodes(server, "/ink/*/*/*")
    image = server.scene._handle_from_node_name[name]
    assert image.position[:2].tolist() == [TILE_M / 2, TILE_M / 2]


def test_a_speech_bubble_comes_and_goes(server: LocalServer) -> None:
    sim = Scene.load("call").build()
    words = {"speak": [1.0]}
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: words))
    sim.agents[1].use_brain(LocalBrain(controller=lambda _: {}))
    sim.reset(1)
    assert latest_said(capture_snapshot(sim)) == 0
    sim.step()
    assert latest_said(capture_snapshot(sim)) == 1
    bubbles = SpeechBubbles(server)
    bubbles.draw(capture_snapshot(sim))
    number = [body.name for body in capture_snapshot(sim).bodies].index(sim.agents[0].body.name)
    assert nodes(server, "/speech/*") == [f"/speech/{number}", f"/speech/light {number}"]
    words.clear()
    for _ in range(10):
        sim.step()
    bubbles.draw(capture_snapshot(sim))
    assert nodes(server, "/speech/*") == []
