"""Every control can be read while it is pointed at, focused, pressed, chosen or disabled."""

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from ai4u_edu.page.server import Rules
from tests.browser.code_tab import CodePage
from tests.browser.contrast import low_contrasts
from tests.browser.panel_page import PanelPage, panel_page, panel_room
from tests.browser.wall_server import WallServer, wall_server
from tests.chromium import close_page, quick_page
from tests.page.server.rooms import Room, served

pytestmark = pytest.mark.browser

SCHEMES = ["light", "dark"]
CARDS = {"Drive": 0, "Build": 10, "World": 4, "Past": 2}
"""Number of cards of each tab."""
CLASS_PAGES = ["teacher", "projector", "check", "join"]
SCENE = {"name": "sumo", "title": "Sumo", "goal": "Push it out.", "level": "easy", "minutes": 3}
BLOCK = {"class": "OrientationSensor", "title": "Orientation", "summary": "Where it is."}


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with panel_room() as room:
        yield room


@pytest.fixture(params=SCHEMES)
def scheme(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def page(chromium: Browser, room: Room, scheme: Any) -> Iterator[PanelPage]:
    with panel_page(chromium, room, color_scheme=scheme, height=1000) as page:
        # viser is left out, which sets it; the dock and the banners follow it
        page.page.evaluate(
            "each => (document.documentElement.dataset.mantineColorScheme = each)", scheme
        )
        yield page


@pytest.fixture(scope="module")
def school() -> Iterator[WallServer]:
    with wall_server(3) as school:
        yield school


def assert_readable(page: Page, controls: int) -> None:
    assert "\n".join(low_contrasts(page, controls=controls)) == ""


def test_the_tabs(page: PanelPage, subtests: pytest.Subtests) -> None:
    page.button("Details").click()
    for tab, cards in CARDS.items():
        with subtests.test(tab):
            page.tab(tab).click()
            page.page.evaluate(
                "document.querySelectorAll('.ai4u-section').forEach(s => (s.open = true))"
            )
            heads = page.page.locator(".ai4u-tabpanel:visible .ai4u-card-head")
            expect(heads).to_have_count(cards)
            if cards and heads.first.get_attribute("aria-expanded") == "false":
                heads.first.click()
            assert_readable(page.page, controls=25)


def test_windows_banners_and_the_help(page: PanelPage, subtests: pytest.Subtests) -> None:
    page.panel.replies["scenes"] = lambda _: {
        "items": [SCENE | {"is_saved": False}, SCENE | {"name": "mine", "is_saved": True}]
    }
    page.panel.replies["gallery"] = lambda _: {
        "items": [BLOCK | {"reason": ""}, BLOCK | {"reason": "It needs a body."}]
    }
    with subtests.test("scenes"):
        page.button("Box chase").click()
        expect(page.page.get_by_role("button", name="Sumo").first).to_be_visible()
        assert_readable(page.page, controls=25)
        page.page.keyboard.press("Escape")
    with subtests.test("blocks"):
        page.tab("Build").click()
        page.page.get_by_role("button", name="Add a sensor").first.click()
        expect(page.page.locator(".ai4u-tile").first).to_be_visible()
        assert_readable(page.page, controls=25)
        page.page.keyboard.press("Escape")
    with subtests.test("help"):
        page.page.keyboard.press("?")
        expect(page.page.locator(".ai4u-binding").first).to_be_visible()
        assert_readable(page.page, controls=25)


def test_the_teachers_windows(
    chromium: Browser, school: WallServer, scheme: Any, subtests: pytest.Subtests
) -> None:
    page = quick_page(chromium, color_scheme=scheme)
    page.goto(f"{school.url}teacher")
    expect(page.get_by_role("list", name="Rooms").get_by_role("button")).to_have_count(3)
    for name in ("Assign a scene…", "Attention…", "Race…", "Projector…", "Real names…"):
        with subtests.test(name):
            page.get_by_role("button", name=name).click()
            page.locator("dialog[open]").wait_for()
            assert_readable(page, controls=10)
            page.keyboard.press("Escape")
    page.get_by_role("list", name="Rooms").get_by_role("button").first.click()
    page.locator("dialog[open]").wait_for()
    assert_readable(page, controls=10)
    close_page(page)


def test_the_page_that_asks_for_a_token(chromium: Browser, scheme: Any) -> None:
    with served(rules=Rules(token="secret")) as room:
        page = quick_page(chromium, color_scheme=scheme)
        page.goto(room.url)
        expect(page.get_by_label("Token")).to_be_visible()
        assert_readable(page, controls=2)
        close_page(page)


def test_the_tab_code(chromium: Browser, scheme: str) -> None:
    with CodePage.opened(chromium, scheme=scheme, color_scheme=scheme) as tab:
        expect(tab.page.locator(".cm-content")).to_be_visible()
        assert_readable(tab.page, controls=5)


@pytest.mark.parametrize("name", CLASS_PAGES)
def test_the_pages_of_a_class(
    chromium: Browser, school: WallServer, scheme: Any, name: str
) -> None:
    page = quick_page(chromium, color_scheme=scheme)
    page.goto(f"{school.url}{name}")
    if name == "teacher":
        expect(page.get_by_role("list", name="Rooms").get_by_role("button")).to_have_count(3)
    assert_readable(page, controls=0 if name == "projector" else 1)
    close_page(page)
