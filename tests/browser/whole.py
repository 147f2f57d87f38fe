"""A page with the panel of a real ``ai4u-edu play``, and how tests use it."""

import contextlib
import io
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.served_viser import connected, frames, record_texts
from tests.chromium import new_page, until_on
from tests.playing import Played

FOREMOST = "dialog[open], body:not(:has(dialog[open])) .ai4u-panel"
"""Selector of the window, or of the panel if there is none."""
Picture = npt.NDArray[np.uint8]
# real time: it only says how often viser draws; tests wait for what is drawn
DRAW_SELDOM = """
const frame = requestAnimationFrame.bind(self);
const waiting = new Map();
let count = 0;
self.requestAnimationFrame = (draw) => {
    const id = (count += 1);
    const once = (time) => waiting.delete(id) && draw(time);
    waiting.set(id, setTimeout(() => frame(once), 250));
    return id;
};
self.cancelAnimationFrame = (id) => {
    clearTimeout(waiting.get(id));
    waiting.delete(id);
};
"""
"""Page script that lets viser draw four times a second at most: without a graphics card, drawing as
often as it can takes a core."""


@contextlib.contextmanager
def whole_page(
    chromium: Browser, server: Played, query: str = "", *, draws: bool = False, **options: Any
) -> Iterator[Page]:
    """Open a page of a server; neither its scripts nor the server may fail.

    Args:
        draws: WebGL draws the world.
        options: more of ``Browser.new_context``.
    """
    page = new_page(chromium, draws=draws, reduced_motion="reduce", **options)
    if draws:
        page.add_init_script(DRAW_SELDOM)
        # viser takes rare frames for a slow machine, and clears its canvas to draw fewer pixels
        query += ("&" if "?" in query else "?") + "fixedDpr=1"
    problems: list[str] = []
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.goto(server.url + query)
    connected(page)
    page.locator(".ai4u-panel .ai4u-facts").wait_for()
    page.locator(".ai4u-panel [role=tab][aria-selected=true]").wait_for()
    yield page
    page.context.close()
    assert problems == []
    assert "Traceback" not in "".join(server.told)


def press(page: Page, name: str) -> None:
    """Click a button of the panel or of its window."""
    button(page, name).click()


def button(page: Page, name: str) -> Locator:
    """Return a visible button of the panel, or of its window while one is open."""
    return page.locator(FOREMOST).get_by_role("button", name=name, exact=True)


def open_tab(page: Page, name: str) -> Locator:
    """Open a tab; return its panel."""
    page.get_by_role("tab", name=name, exact=True).click()
    return page.get_by_role("tabpanel", name=name, exact=True)


def show_details(page: Page) -> None:
    """Have the panel show everything."""
    press(page, "Details")
    expect(button(page, "Details")).to_have_attribute("aria-pressed", "true")


def card(page: Page, title: str) -> Locator:
    """Return the card of a block, body or episode."""
    return page.locator("article.ai4u-card:visible").filter(
        has=page.locator("strong", has_text=title)
    )


def unfold(page: Page, title: str) -> Locator:
    """Open a card; return it."""
    found = card(page, title).last
    head = found.locator(".ai4u-card-head").first
    if head.get_attribute("aria-expanded") == "false":
        head.click()
    expect(head).to_have_attribute("aria-expanded", "true")
    return found


def recorded_notices(page: Page) -> Callable[[], list[str]]:
    """Return a function that returns the results and errors that the panel says from now on."""
    return record_texts(page, ".ai4u-notice")


def scene_picture(page: Page) -> Picture:
    """Return the picture left of the panel, above the keys: (height, width, 3)."""
    clip: Any = {"x": 200, "y": 80, "width": 640, "height": 480}
    return np.asarray(Image.open(io.BytesIO(page.screenshot(clip=clip))).convert("RGB"))


def share(picture: Picture, colour: tuple[int, int, int], slack: int = 25) -> float:
    """Return the share of a picture that has about that colour (0..1)."""
    close = np.abs(picture.astype(int) - np.array(colour)).max(axis=-1) <= slack
    return float(close.mean())


def until_drawn(page: Page, condition: Callable[[Picture], bool]) -> Picture:
    """Wait until the picture of the world meets a condition; return it."""
    pictures: list[Picture] = []

    def is_met() -> bool:
        pictures[:] = [scene_picture(page)]
        return condition(pictures[0])

    until_on(page, is_met)
    return pictures[0]


def until_settled(page: Page) -> Picture:
    """Wait until the picture of the world is the same for some frames; return it."""
    before = scene_picture(page)

    def is_same(picture: Picture) -> bool:
        nonlocal before
        frames(page, 4)
        is_settled, before = bool((picture == before).all()), picture
        return is_settled

    return until_drawn(page, is_same)
