"""viser's own page in a real browser."""

import contextlib
import io
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from PIL import Image

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CircleShape,
    ControlRequestor,
    LocalBrain,
    World,
)
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.light import shown_colour, surface_colours
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot.raster import MARGIN_M, draw_snapshot
from ai4u_edu.snapshot.theme import FLOOR, VOID
from tests.waiting import LIMIT_S

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = pytest.mark.browser

STYLE = Path(__file__).parents[3] / "web" / "styles" / "page" / "page.css"
READY = "() => window.__viserMutable?.camera?.fov < 3 && !window.__viserMutable.firstMessageBatch"
"""The camera has its long lens: the scene has come, and it is framed."""


@contextlib.contextmanager
def opened(viewer: Viewer) -> "Iterator[Page]":
    """Open a viewer's page with the style of ours, which has the colour around the floors."""
    from tests.chromium import browser, new_page

    viewer.runner.start()
    viewer.start()
    with browser() as chromium:
        tab = new_page(chromium, 900, 560, draws=True)
        # viser takes rare frames for a slow machine, and draws fewer pixels from then on
        tab.goto(f"http://127.0.0.1:{viewer.port}?fixedDpr=1")
        tab.wait_for_function(READY)
        tab.add_style_tag(path=STYLE)
        yield tab


def colours(tab: "Page") -> np.ndarray:
    """The page as (height, width, 3) numbers 0..255."""
    return np.asarray(Image.open(io.BytesIO(tab.screenshot())).convert("RGB")).astype(int)


def share(pixels: np.ndarray, colour: tuple[int, int, int]) -> float:
    """The share of the page that has a colour, or one that the eye can't tell from it."""
    return float((np.abs(pixels - colour).max(axis=2) <= 4).mean())


def test_the_page_shows_the_arena(viewer: Viewer) -> None:
    from tests.chromium import until_on

    errors: list[str] = []
    with opened(viewer) as tab:
        tab.on("pageerror", lambda error: errors.append(str(error)))

        def is_drawn() -> bool:
            pixels = colours(tab)
            many = len(np.unique(pixels.reshape(-1, 3), axis=0)) > 100
            return many and share(pixels, FLOOR) > 0.1 and share(pixels, VOID) > 0.1

        until_on(tab, is_drawn)
        assert errors == []


@pytest.fixture
def close_up() -> Iterator[Viewer]:
    """A viewer of a large robot and its target on a small plate."""
    world = World()
    world.add_floor("plate", BoxShape(size=(8, 6)))
    world.add_body("robot", CircleShape(radius=1.2), position=(-0.8, -1), tags=("agent",))
    world.add_body("box", BoxShape(size=(1.2, 1.2)), position=(-3, -1), tags=("target",))
    agent = BasicAgent(body="robot", brains=[LocalBrain(controller=lambda _percept: {})])
    runner = Runner(ControlRequestor(world, [agent]), seed=1)
    viewer = Viewer(runner)
    yield viewer
    viewer.stop()
    runner.stop(LIMIT_S)


SPOTS = {
    "shell": (-1.0, 0.0),
    "base": (-0.965, 0.0),
    "tread": (0.0, 0.78),
    "white of the left eye": (0.48, 0.29),
    "white of the right eye": (0.48, -0.29),
    "pupil": (0.27, 0.29),
    "nose": (0.7, 0.0),
}
"""Places on the robot, in its radii; its target is behind it, so its pupils look back."""


def test_the_page_has_the_colours_of_the_pictures_without_a_browser(close_up: Viewer) -> None:
    from tests.chromium import until_on

    viewer, snapshot = close_up, close_up.runner.latest
    robot, box = snapshot.bodies
    spots = {name: (robot.x + 1.2 * x, robot.y + 1.2 * y) for name, (x, y) in SPOTS.items()}
    spots["shell"] = robot.x - 0.7, robot.y
    spots |= {"ring": (box.x + 0.366, box.y), "box": (box.x + 0.22, box.y)}
    spots |= {"floor": (-1.5, -2.5), "void": (-4.5, 0.5)}
    drawn = draw_snapshot(snapshot, longest=2000)
    (left, _), (right, high) = snapshot.static_scene.bounds
    scale = drawn.shape[1] / (right - left + 2 * MARGIN_M)
    columns = {name: int((x - left + MARGIN_M) * scale) for name, (x, _) in spots.items()}
    rows = {name: int((high + MARGIN_M - y) * scale) for name, (_, y) in spots.items()}
    meant = surface_colours([drawn[rows[name], columns[name]] for name in spots])
    # the page's film makes the most saturated colours a bit greyer
    wanted = dict(zip(spots, 255 * shown_colour(meant / 255), strict=True))

    with opened(viewer) as tab:

        def are_equal() -> bool:
            (page,), pixels = viewer.viewer_clients.values(), colours(tab)
            frame, middle = page.view.frame, np.array(pixels.shape[1::-1]) / 2
            found = {}
            for name, (x, y) in spots.items():
                per_metre = pixels.shape[0] / frame.height
                u, v = (middle + per_metre * np.array([x - frame.x, frame.y - y])).astype(int)
                found[name] = float(np.abs(pixels[v, u] - wanted[name]).max())
            print({name: far for name, far in found.items() if far > 12})
            return max(found.values()) <= 12

        until_on(tab, are_equal)
