"""A scene is shared by a link: copied on one page, and opened on another."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from ai4u_edu.page.editing.sharing import read_shared, shared_link
from ai4u_edu.scenes import Scene
from tests.browser.plain_page import WITHOUT_VISER
from tests.browser.served_viser import connected
from tests.chromium import new_page
from tests.playing import Played, played
from tests.waiting import until

pytestmark = pytest.mark.browser

LINK = shared_link(Scene.load("maze"), 77).fragment


@pytest.fixture(scope="module")
def server() -> Iterator[Played]:
    with played("box_chase", "--seed", "1") as server:
        yield server


@pytest.fixture
def page(chromium: Browser, server: Played) -> Iterator[Page]:
    page = new_page(chromium, permissions=["clipboard-read", "clipboard-write"])
    WITHOUT_VISER.serve(page, server.url)
    yield page
    page.context.close()


def test_a_damaged_link_says_so(server: Played, page: Page) -> None:
    page.goto(f"{server.url}#{LINK[:80]}")
    told = page.get_by_role("dialog", name="The shared scene can't be opened")
    expect(told).to_contain_text("The link is damaged")
    told.get_by_role("button", name="Close").click()
    expect(told).to_be_hidden()


def test_the_present_scene_is_copied_as_a_link(server: Played, page: Page) -> None:
    page.goto(server.url)
    connected(page)
    page.get_by_role("button", name="Help").click()
    page.get_by_role("button", name="Copy link").click()
    expect(page.get_by_text("Link copied.")).to_be_visible()
    link = page.evaluate("navigator.clipboard.readText()")
    assert link.startswith(f"{server.url}#scene=")
    assert read_shared(link) == (Scene.load("box_chase"), 1)


def test_where_nothing_may_be_copied_the_link_is_shown(server: Played, page: Page) -> None:
    page.add_init_script("Object.defineProperty(navigator, 'clipboard', {value: undefined})")
    page.goto(server.url)
    connected(page)
    page.get_by_role("button", name="Help").click()
    page.get_by_role("button", name="Copy link").click()
    box = page.get_by_role("textbox", name="Link")
    assert read_shared(box.input_value()).scene == Scene.load("box_chase")
    assert box.evaluate("box => box.selectionEnd - box.selectionStart") == len(box.input_value())


def test_a_link_is_opened_after_a_question(chromium: Browser) -> None:
    with played("box_chase", "--seed", "1") as server:  # of its own, since it replaces the scene
        page = new_page(chromium)
        WITHOUT_VISER.serve(page, server.url)
        opens_a_link(page, server)
        page.context.close()


def opens_a_link(page: Page, server: Played) -> None:
    page.goto(f"{server.url}#{LINK}")
    question = page.get_by_role("dialog", name="Open the shared scene “Maze”?")
    expect(question).to_be_visible()
    assert "#" not in page.url  # so that reloading asks no more
    page.keyboard.press("Escape")
    expect(question).to_be_hidden()
    assert server.health()["scene"] == "Box chase"
    page.evaluate("hash => (location.hash = hash)", LINK)
    question.get_by_role("button", name="Open").click()
    until(lambda: server.health()["scene"] == "Maze")
    until(lambda: server.snapshot()["seed"] == 77)
    expect(question).to_be_hidden()
