"""axe-core finds nothing serious in the panel, for each tab, light and dark, Simple and Details."""

from collections.abc import Iterator

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect

from tests.browser.panel_page import PanelPage, panel_page, panel_room
from tests.browser.schemes import SCHEMES

pytestmark = pytest.mark.browser

CARDS = {"Drive": 0, "Build": 10, "World": 4, "Past": 2}
"""Number of cards of each tab."""
OPENED = {"Build": "Ray picture", "World": "cube"}
"""Cards that have a form when they are open."""
GRAVE = {"serious", "critical"}
NO_TRANSITION = "!document.getAnimations().some((each) => each instanceof CSSTransition)"


@pytest.fixture(scope="module", params=SCHEMES)
def page(chromium: Browser, request: pytest.FixtureRequest) -> Iterator[PanelPage]:
    with (
        panel_room() as room,
        panel_page(chromium, room, color_scheme=request.param, height=1000) as page,
    ):
        yield page


def findings(page: Page, part: str) -> list[str]:
    """Return axe-core's grave findings in the part of a page that a selector matches."""
    page.wait_for_function(NO_TRANSITION)  # a colour that is still on its way can be any
    violations = Axe().run(page, context=part).response["violations"]
    return [
        f"{each['id']}: {each['help']}: {[node['html'][:160] for node in each['nodes']]}"
        for each in violations
        if each["impact"] in GRAVE
    ]


@pytest.mark.parametrize(
    "mode",
    [pytest.param("Simple", marks=pytest.mark.nightly), "Details"],  # the latter shows more
)
@pytest.mark.parametrize("tab", CARDS)
def test_a_tab_has_no_grave_finding(page: PanelPage, tab: str, mode: str) -> None:
    page.button(mode).click()
    page.tab(tab).click()
    expect(page.tab(tab)).to_have_attribute("aria-selected", "true")
    page.page.evaluate("document.querySelectorAll('.ai4u-section').forEach(s => (s.open = true))")
    cards = page.page.locator(".ai4u-tabpanel:visible .ai4u-card-head")
    expect(cards).to_have_count(CARDS[tab])
    if card := OPENED.get(tab):
        head = cards.filter(has_text=card).first
        if head.get_attribute("aria-expanded") == "false":
            head.click()
        expect(page.page.locator(".ai4u-tabpanel:visible [data-open] label").first).to_be_visible()
    assert findings(page.page, ".ai4u-panel") == []


def test_notices_have_no_grave_finding(page: PanelPage) -> None:
    page.panel.send({"type": "note", "level": "error", "text": "The world has stopped."})
    expect(page.page.locator(".ai4u-notice[role=alert]")).not_to_be_empty()
    assert findings(page.page, ".ai4u-panel") == []


def test_the_scene_picker_has_no_grave_finding(page: PanelPage) -> None:
    scene = {"name": "sumo", "title": "Sumo", "goal": "Push it out.", "level": "easy", "minutes": 3}
    page.panel.replies["scenes"] = lambda _: {"items": [scene | {"is_saved": False}]}
    page.button("Box chase").click()
    expect(page.page.get_by_role("button", name="Sumo")).to_be_visible()
    assert findings(page.page, ".ai4u-dialog") == []
    page.page.keyboard.press("Escape")
    expect(page.page.get_by_role("dialog")).to_have_count(0)


def test_a_page_with_a_nameless_button_fails(page: PanelPage) -> None:
    page.page.evaluate(
        "document.querySelector('.ai4u-buttons').append(document.createElement('button'))"
    )
    found = findings(page.page, ".ai4u-panel")
    page.page.evaluate("document.querySelector('.ai4u-buttons > :last-child').remove()")
    assert any(finding.startswith("button-name") for finding in found)
