"""Programs of blocks in a served page, with the real Python: put together by keyboard alone."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.blocks_keys import choose, focused, go, set_number
from tests.browser.code_editor import WithEditor
from tests.browser.code_page import WORLD_WAITS, set_limits
from tests.browser.sent_frames import SentFrames
from tests.browser.served_viser import ready
from tests.browser.test_play import MIDDLE
from tests.chromium import new_page
from tests.playing import Played, played

pytestmark = [pytest.mark.browser, pytest.mark.nightly]

PROGRAM = (
    "def decide(percept):\n"
    "    forward = turn = 0\n"
    '    if percept["orientation"][0] > 0.95:\n'
    "        forward = 1\n"
    "    else:\n"
    "        turn = 0.3\n"
    '    return {"move": [forward, turn, 0, 0]}\n'
)


class BlocksTab(WithEditor):
    """The tab "Code" of a served page, reached with Tab and arrow keys."""

    def __init__(self, page: Page) -> None:
        self.page = page
        go(page, "Tab", "Drive")
        for _ in range(5):
            if focused(page) == "Code":
                break
            self.keys("ArrowRight")
        expect(page.get_by_role("button", name="Blocks")).to_be_visible()
        go(page, "Tab", "Blocks")
        self.keys("Enter")
        expect(page.locator("*:focus")).to_have_attribute("aria-label", re.compile("forever"))

    @property
    def state(self) -> Locator:
        return self.page.locator(".ai4u-code-state")

    def keys(self, *keys: str) -> None:
        for key in keys:
            self.page.keyboard.press(key)


@pytest.fixture
def page(chromium: Browser) -> Iterator[Page]:
    page = new_page(chromium, 1280, 900)
    problems: list[str] = []
    page.on("pageerror", lambda error: problems.append(str(error)))
    yield page
    page.context.close()
    assert problems == []


def opened(page: Page, server: Played) -> BlocksTab:
    page.goto(server.url)
    ready(page)
    set_limits(page)
    return BlocksTab(page)


def test_one_block_drives(page: Page) -> None:
    with played("maze", "--seed", "4", *WORLD_WAITS) as server:
        sent = SentFrames(page)
        tab = opened(page, server)
        before = server.snapshot()["agents"][0]["pose"]
        choose(page, "Actions", "forward")
        expect(tab.editor).to_contain_text("forward = 1")
        assert sent.take() == []  # no key drove
        assert server.snapshot()["agents"][0]["pose"] == before
        tab.keys("Control+Enter")
        expect(page.locator(".ai4u-blocks-ran")).to_have_count(2)


def test_blocks_reach_the_box_from_ten_starts(page: Page) -> None:
    with played("box_chase", "--seed", MIDDLE, *WORLD_WAITS) as server:
        tab = opened(page, server)
        choose(page, "Control", "if, Empty, has 2 branches")
        choose(page, "Numbers", "0, <")
        choose(page, "Senses", "orientation")
        tab.keys("ArrowRight", "ArrowRight")
        go(page, "ArrowRight", "Edit number")
        set_number(page, "0.95")
        go(page, "ArrowLeft", "dropdown: <")
        tab.keys("Enter", "ArrowDown", "ArrowDown", "Enter")
        go(page, "ArrowUp", "if,")
        choose(page, "Actions", "forward")
        go(page, "ArrowDown", "End else")
        choose(page, "Actions", "turn")
        go(page, "ArrowRight", "Edit number")
        set_number(page, "0.3")
        expect(tab.editor).to_contain_text("turn = 0.3")
        assert tab.text == PROGRAM
        go(page, "Shift+Tab", "Test")
        tab.keys("Enter")
        expect(tab.state).to_contain_text("10 of 10 reached the goal")
