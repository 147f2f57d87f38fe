"""A protected world asks a person for its token."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from ai4u_edu.page.server import Rules
from ai4u_edu.page.server.limits import attempts
from tests.browser.fit import loaded_fonts
from tests.chromium import new_page
from tests.page.server.rooms import Room, served

pytestmark = pytest.mark.browser

TOKEN = "open sesame; Zoë и"


@pytest.fixture
def room() -> Iterator[Room]:
    with served(rules=Rules(token=TOKEN)) as room:
        yield room


@pytest.fixture
def page(chromium: Browser) -> Iterator[Page]:
    page = new_page(chromium)
    yield page
    page.context.close()


def enter(page: Page, text: str) -> None:
    page.get_by_label("Token").fill(text)
    page.keyboard.press("Enter")


@pytest.mark.parametrize("given", [TOKEN, " {}?token=open%20sesame%3B%20Zo%C3%AB%20%D0%B8 "])
def test_the_right_token_opens_the_world(room: Room, page: Page, given: str) -> None:
    page.add_init_script("window.firstHash = location.hash")  # viser takes it out
    page.goto(f"{room.url}?agent=0#there")
    expect(page.get_by_label("Token")).to_be_focused()
    assert loaded_fonts(page) == ["Atkinson Hyperlegible Next"], "nobody needs a token for it"
    enter(page, "guess")
    expect(page.get_by_role("alert")).to_have_text("That token is wrong.")
    enter(page, given.format(room.url))
    page.locator("#root").wait_for(state="attached")  # the page of before forbids eval
    assert page.url.partition("#")[0] == f"{room.url}?agent=0"
    assert page.evaluate("window.firstHash") == "#there"
    assert "token" not in page.evaluate(
        "JSON.stringify(performance.getEntriesByType('navigation'))"
    )


def test_a_wrong_token_in_the_address_does_not_stay_there(room: Room, page: Page) -> None:
    page.goto(f"{room.url}?token=guess&agent=0")
    expect(page.get_by_role("alert")).to_have_text("That token is wrong.")
    expect(page).to_have_url(f"{room.url}?agent=0")


def test_attempts_are_limited(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(attempts, "MAX_WRONG", 2)
    monkeypatch.setattr(attempts, "FORGOTTEN_PER_S", 0.001)
    with served(rules=Rules(token=TOKEN)) as room:
        page.goto(room.url)
        for _ in range(2):
            enter(page, "guess")
            expect(page.get_by_role("button", name="Open")).to_be_enabled()
        enter(page, "guess")
        expect(page.get_by_role("alert")).to_contain_text("Too many wrong tokens")
        page.goto(f"{room.url}?token=guess")
        expect(page.get_by_role("alert")).to_contain_text("Too many wrong tokens")
