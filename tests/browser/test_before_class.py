"""The pages that a student's device opens before it is in the class: check and join."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.wall_data import CODE
from tests.browser.wall_server import WallServer, wall_server
from tests.chromium import close_page, quick_page
from tests.waiting import until

pytestmark = pytest.mark.browser


@pytest.fixture
def school() -> Iterator[WallServer]:
    with wall_server(1) as server:
        yield server


@pytest.fixture
def page(chromium: Browser) -> Iterator[Page]:
    page = quick_page(chromium)
    yield page
    close_page(page)


def test_check_says_yes_or_what_stands_between(page: Page, school: WallServer) -> None:
    page.goto(f"{school.url}check")
    expect(page.get_by_role("status")).to_have_text("Yes, this device can join.")
    line = page.get_by_role("listitem").filter(has_text="Keys arrive")
    expect(line).to_contain_text("Press an arrow key or W now.")
    page.keyboard.press("KeyW")
    expect(line).to_contain_text("yes")
    page.route_web_socket("**/check/socket", lambda socket: socket.close())
    page.reload()
    expect(page.get_by_text("A proxy or firewall")).to_be_visible()


def test_a_move_code_takes_the_names_away(page: Page, school: WallServer) -> None:
    page.goto(f"{school.url}join?code={CODE}")
    expect(page.locator("#code")).to_have_value(CODE)
    page.get_by_role("button", name="Continue from another device").click()
    expect(page.get_by_text("Choose your name here")).to_be_hidden()
    page.get_by_label("Code on your other device").fill("K7QPM")
    page.keyboard.press("Enter")
    until(lambda: school.commands != [])
    assert school.commands[0]["code"] == "K7QPM"
    assert school.commands[0]["name"] == ""
    page.wait_for_url("**/privacy")  # the room; Playwright may not close a page on its way
