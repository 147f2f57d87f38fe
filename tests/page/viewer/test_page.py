"""viser's own page in a real browser."""

import io
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import pytest
from PIL import Image

from ai4u_edu.page.viewer import Viewer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot.theme import FLOOR, VOID

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = pytest.mark.browser

READY = "() => window.__viserMutable?.camera?.fov < 3 && !window.__viserMutable.firstMessageBatch"
"""The camera has its long lens: the scene has come, and it is framed."""


@pytest.fixture
def tab(viewer: Viewer, runner: Runner) -> "Iterator[Page]":
    from tests.chromium import browser, new_page

    runner.start()
    viewer.start()
    with browser() as chromium:
        tab = new_page(chromium, 900, 560, draws=True)
        tab.goto(f"http://127.0.0.1:{viewer.port}")
        tab.wait_for_function(READY)
        yield tab


def colours(tab: "Page") -> np.ndarray:
    """The page as (height, width, 3) numbers 0..255."""
    return np.asarray(Image.open(io.BytesIO(tab.screenshot())).convert("RGB")).astype(int)


def share(pixels: np.ndarray, colour: tuple[int, int, int]) -> float:
    """The share of the page that has a colour, or one that the eye can't tell from it."""
    return float((np.abs(pixels - colour).max(axis=2) <= 4).mean())


def test_the_page_shows_the_arena(tab: "Page") -> None:
    from tests.chromium import until_on

    errors: list[str] = []
    tab.on("pageerror", lambda error: errors.append(str(error)))

    def is_drawn() -> bool:
        pixels = colours(tab)
        many = len(np.unique(pixels.reshape(-1, 3), axis=0)) > 100
        return many and share(pixels, FLOOR) > 0.1 and share(pixels, VOID) > 0.1

    until_on(tab, is_drawn)
    assert errors == []
