"""Several agents in one scene: whose page it is, whom it looks at, and whose end it tells."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.chromium import new_page
from tests.playing import Played, played

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def server() -> Iterator[Played]:
    with played("sumo", "--seed", "1") as server:
        yield server


def opened(chromium: Browser, server: Played, query: str = "") -> Page:
    page = new_page(chromium)
    page.goto(server.url + (f"{query}&" if query else "?") + "panel=viser")
    page.locator(".ai4u-driver", has_not_text="Connecting").wait_for()
    page.get_by_text("Senses", exact=True).wait_for()
    return page


def name_of_the_agent_in_the_panel(page: Page) -> str:
    return page.locator(".ai4u p").first.inner_text()


def test_a_page_opens_with_its_own_agent_and_can_look_at_another(
    chromium: Browser, server: Played
) -> None:
    first, second = opened(chromium, server), opened(chromium, server, "?agent=orange")
    assert name_of_the_agent_in_the_panel(first) == "blue"
    assert name_of_the_agent_in_the_panel(second) == "orange"
    second.locator(".mantine-Select-input").last.click()
    second.get_by_role("option", name="blue").click()
    expect(second.locator(".ai4u p").first).to_have_text("blue")
    assert name_of_the_agent_in_the_panel(first) == "blue"
    for page in (first, second):
        page.context.close()


def test_each_page_tells_the_end_of_its_own_agent(chromium: Browser, server: Played) -> None:
    mine, theirs = opened(chromium, server), opened(chromium, server, "?agent=orange")
    mine.keyboard.press("KeyR")  # orange may have come near by now
    mine.keyboard.down("KeyS")  # out of the ring, backwards
    expect(mine.locator(".ai4u-banner")).to_contain_text("You lost. \u221210", timeout=20_000)
    expect(theirs.locator(".ai4u-banner")).to_contain_text("orange wins! +10", timeout=20_000)
    mine.keyboard.up("KeyS")
    mine.keyboard.press("KeyR")
    expect(mine.locator(".ai4u-banner")).to_have_count(0)
    for page in (mine, theirs):
        page.context.close()
