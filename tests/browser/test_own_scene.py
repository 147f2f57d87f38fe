"""A scene of one's own: from an empty plate to "You did it!", in the whole page."""

import math
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from ai4u_edu.page.viewer.scene.framing import frame_arena
from tests.browser.keys import CANVAS, Place, body, where
from tests.browser.whole import open_tab, press, whole_page
from tests.chromium import until_on
from tests.playing import Played, played
from tests.waiting import until

pytestmark = pytest.mark.browser

HALF_M = (8.0, 6.0)
"""Half the sides of the empty scene's plate."""


@pytest.fixture(scope="module")
def server() -> Iterator[Played]:
    with played("box_chase_ai4u") as server:
        server.open("my_scene")
        yield server


@pytest.fixture
def page(chromium: Browser, server: Played) -> Iterator[Page]:
    with whole_page(chromium, server) as page:
        yield page


def spot(page: Page, place: Place) -> Place:
    """Return where the picture shows a place (m) in the window (px), from above."""
    box = page.locator(CANVAS).bounding_box()
    assert box is not None
    (x, y) = HALF_M
    seen = frame_arena(((-x, -y), (x, y)), box["width"] / box["height"])
    scale = box["height"] / seen.height
    middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    return middle[0] + scale * (place[0] - seen.x), middle[1] - scale * (place[1] - seen.y)


def drag_out(page: Page, title: str, place: Place) -> None:
    """Drag a thing out of the palette with the mouse, and drop it at a place (m)."""
    entry = page.locator(".ai4u-palette-entry", has_text=title).bounding_box()
    assert entry is not None
    page.mouse.move(entry["x"] + 20, entry["y"] + 20)
    page.mouse.down()
    page.mouse.move(*spot(page, (0, 2)), steps=3)
    ghost = page.locator(".ai4u-ghost")
    expect(ghost).to_be_visible()
    page.mouse.move(*spot(page, place), steps=3)
    on_grid = round(place[0]), round(place[1])

    def is_there() -> bool:
        box = ghost.bounding_box()
        assert box is not None
        middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        return math.dist(middle, spot(page, on_grid)) < 2

    until_on(page, is_there)  # the camera fits the picture, which is lower now
    page.mouse.up()


def test_a_target_and_a_reward_make_a_scene_that_is_won(page: Page, server: Played) -> None:
    goal = page.locator(".ai4u-goal-text")
    expect(goal).to_contain_text("There is no goal yet.")
    tab = open_tab(page, "Build")
    # the first thing in the tab, beside the palette under the world
    expect(tab.locator("button").first).to_have_accessible_name("Add a sensor")
    drag_out(page, "Target", (4.2, 0.1))
    until(lambda: body(server, "target"))
    assert where(server, "target") == (4, 0)  # on the grid

    press(page, "Add a reward")
    page.locator("dialog[open] .ai4u-tile", has_text="Reach the target").first.click()
    expect(goal).to_contain_text("Reach the target.")

    page.keyboard.down("KeyW")
    expect(page.locator(".ai4u-banner", has_text="You did it!")).to_be_visible()
    page.keyboard.up("KeyW")
    (agent,) = server.snapshot()["agents"]
    assert agent["terminated"]
    assert agent["reward_terms"]["touch"] == 10

    # the sentence is changed by a click on it, and stays as it was written
    goal.locator("span").first.click()
    text = page.locator("dialog[open]").get_by_label("The task, in a sentence")
    expect(text).to_have_value("Reach the target.")
    text.fill("Find the yellow star.")
    press(page, "Save")
    expect(goal).to_contain_text("Find the yellow star.")
    # the new state may come before the answer that closes the dialog, which takes all keys
    expect(page.locator("dialog[open]")).to_have_count(0)
    page.keyboard.press("Control+KeyZ")
    expect(goal).to_contain_text("Reach the target.")
