"""axe-core finds nothing of any kind on whole pages, light and dark: play, its tabs, start."""

from collections.abc import Iterator
from typing import Literal

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect

from tests.browser.schemes import SCHEMES
from tests.browser.served_viser import record_texts
from tests.browser.test_panel_accessibility import NO_TRANSITION
from tests.browser.whole import button, open_tab, press, whole_page
from tests.chromium import until_on
from tests.playing import Played, played

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def server() -> Iterator[Played]:
    with played("maze", "--seed", "1", waits_for_key=True) as server:
        yield server


scheme = pytest.mark.parametrize("scheme", SCHEMES)


def findings(page: Page) -> list[str]:
    """Return all findings of axe-core in a page."""
    page.wait_for_function(NO_TRANSITION)  # a colour that is still on its way can be any
    return [
        f"{each['impact']} {each['id']}: {[node['html'][:160] for node in each['nodes']]}"
        for each in Axe().run(page).response["violations"]
    ]


@scheme
def test_the_page_of_a_world_has_no_finding(
    server: Played, chromium: Browser, subtests: pytest.Subtests, scheme: str
) -> None:
    with whole_page(chromium, server, color_scheme=scheme) as page:
        for tab in ("Drive", "Build", "World", "Past", "Teach"):
            with subtests.test(tab=tab):
                open_tab(page, tab)
                assert findings(page) == []
        with subtests.test(tab="Drive", network="watched"):
            open_tab(page, "Drive")
            texts = record_texts(page, ".ai4u-banner")
            press(page, "Watch it think")
            expect(button(page, "Stop watching")).to_be_visible()
            until_on(page, lambda: any("because" in each for each in texts()))
            assert findings(page) == []
            press(page, "Stop watching")
            expect(button(page, "Watch it think")).to_be_visible()


@scheme
def test_the_tab_code_has_no_finding(
    server: Played, chromium: Browser, subtests: pytest.Subtests, scheme: str
) -> None:
    with whole_page(chromium, server, color_scheme=scheme) as page:
        open_tab(page, "Code")
        expect(page.locator(".cm-content")).to_be_visible()
        for way in ("Python", "Blocks"):
            with subtests.test(way=way):
                press(page, way)
                shown = ".blocklySvg" if way == "Blocks" else ".cm-content"
                expect(page.locator(shown).first).to_be_visible()
                assert findings(page) == []


@scheme
def test_the_start_page_has_no_finding(
    server: Played, chromium: Browser, scheme: Literal["light", "dark"]
) -> None:
    page = chromium.new_page(color_scheme=scheme)
    page.goto(f"{server.url}start")
    expect(page.get_by_role("heading", level=1)).to_be_visible()
    assert findings(page) == []
    page.context.close()
