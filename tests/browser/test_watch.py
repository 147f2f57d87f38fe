"""Watch it think and Beat it!, on the page of a real ``ai4u-edu play``."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.served_viser import record_texts
from tests.browser.whole import button, press, whole_page
from tests.chromium import until_on
from tests.playing import Played, played
from tests.waiting import until

pytestmark = pytest.mark.browser

BANNER = ".ai4u-banners:visible .ai4u-banner"


@pytest.fixture(scope="module")
def server() -> Iterator[Played]:
    with played("box_chase", "--seed", "1", waits_for_key=True) as server:
        yield server


@pytest.fixture
def page(server: Played, chromium: Browser) -> Iterator[Page]:
    with whole_page(chromium, server) as page:
        yield page


def test_watch_it_think_then_beat_it(server: Played, page: Page) -> None:
    texts = record_texts(page, ".ai4u-banner")
    press(page, "Watch it think")
    banner = page.locator(BANNER)
    until_on(page, lambda: any(re.match(r"\s*It .* because .* box .*", each) for each in texts()))
    expect(button(page, "Stop watching")).to_be_visible()
    # the banner says how it ended, and what to do next
    expect(banner.locator("strong")).to_contain_text("The network did it!")
    buttons = banner.get_by_role("button")
    expect(buttons).to_have_text(["Beat it!", "Watch again", "Stop watching"])
    buttons.first.click()
    expect(banner).to_contain_text("to start")
    expect(button(page, "Watch it think")).to_be_visible()
    until(lambda: server.snapshot()["waiting"] == "key")
    page.keyboard.down("KeyS")  # backwards, off the plate or into the box
    expect(banner.locator("strong")).to_contain_text(
        re.compile(
            r"The network got there in \d\.\d s\.|You beat it by|was \d\.\d s faster|As fast"
        )
    )
    page.keyboard.up("KeyS")


def test_a_key_gives_the_robot_back_and_its_time_is_no_best(server: Played, page: Page) -> None:
    press(page, "Watch it think")
    expect(button(page, "Stop watching")).to_be_visible()
    expect(page.locator(BANNER)).to_contain_text("because")
    page.keyboard.press("KeyW")
    expect(button(page, "Watch it think")).to_be_visible()
    expect(page.get_by_text("You're driving").first).to_be_visible()
    press(page, "Watch it think")
    expect(button(page, "Stop watching")).to_be_visible()
    press(page, "Stop watching")
    expect(page.locator(BANNER)).to_contain_text("to start")
    until(lambda: server.snapshot()["waiting"] == "key")


def test_a_scene_without_a_network_has_no_such_buttons(chromium: Browser) -> None:
    with played("sumo", waits_for_key=True) as server, whole_page(chromium, server) as page:
        expect(button(page, "Try again")).to_be_visible()
        expect(page.locator(".ai4u-watch")).to_be_hidden()
