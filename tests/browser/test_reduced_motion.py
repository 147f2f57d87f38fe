"""With ``prefers-reduced-motion``, nothing in our part of the page moves by itself."""

import pytest
from playwright.sync_api import Browser, expect

from tests.browser.panel_page import PanelPage, panel_page, panel_room

pytestmark = pytest.mark.browser

MOVING = """() => [...document.querySelectorAll("[class^=ai4u], [class^=ai4u] *")].filter(each => {
    const { animationName, transitionDuration } = getComputedStyle(each);
    return animationName !== "none" || transitionDuration.split(", ").some(s => parseFloat(s) > 0);
}).map(each => each.outerHTML.slice(0, 80))"""
"""Elements that have an animation or a transition."""

# real time: that of the page's own limit, which is taken away
NO_LIMIT = """const { setTimeout } = window;
window.setTimeout = (act, ms, ...rest) => ms === 5000 ? 0 : setTimeout(act, ms, ...rest);"""
"""The page ends its opening by itself after 5 s, which may pass here on a slow machine."""


def moving(page: PanelPage) -> list[str]:
    """Return what moves in any tab, in the help and in the scene picker."""
    found: list[str] = []
    for tab in ("Drive", "Build", "World", "Past"):
        page.tab(tab).click()
        expect(page.tab(tab)).to_have_attribute("aria-selected", "true")
        found += page.page.evaluate(MOVING)
    page.page.get_by_role("button", name="Help", exact=True).click()
    found += page.page.evaluate(MOVING)
    page.page.keyboard.press("Escape")
    page.button("Box chase").click()
    page.page.get_by_role("dialog").wait_for()
    found += page.page.evaluate(MOVING)
    return found


@pytest.mark.parametrize("preference", ["reduce", "no-preference"])
def test_only_whoever_has_nothing_against_it_sees_motion(
    chromium: Browser, preference: str
) -> None:
    with (
        panel_room() as room,
        panel_page(chromium, room, reduced_motion=preference) as page,
    ):
        is_reduced = preference == "reduce"
        assert (moving(page) == []) == is_reduced
        # the page has sent other commands since
        assert page.panel.commands("reduce_motion") == ([{"on": True}] if is_reduced else [])


@pytest.mark.parametrize("preference", ["reduce", "no-preference"])
def test_a_page_opens_with_a_tilt_unless_motion_is_reduced(
    chromium: Browser, preference: str
) -> None:
    with (
        panel_room() as room,
        panel_page(chromium, room, reduced_motion=preference) as page,
    ):
        page.page.add_init_script(NO_LIMIT)
        page.reset()
        opening = page.page.locator("html[data-ai4u-opening]")
        begun = [] if preference == "reduce" else [{"on": True}]
        page.tab("Build").focus()
        page.page.keyboard.press("Shift")
        ended = [{"on": False}] * len(begun)
        page.until(lambda: page.panel.commands("opening") == begun + ended)
        expect(opening).to_have_count(len(begun))
        page.page.mouse.click(5, 5)  # once only
        page.panel.change("view", opening="running")
        page.panel.change("view", opening="over")
        expect(opening).to_have_count(0)
        page.panel.drop()
        page.until(lambda: len(page.panel.urls) == 2)
        page.tab("Build").click()
        page.until(lambda: page.panel.shown["tabs"][0] == "blocks")
        assert page.panel.commands("opening") == begun + ended
