"""The world under a cell takes the keys by itself, so that they change none of the cells."""

import pytest
from playwright.sync_api import Browser, expect

from ai4u_edu.lessons.live import Live
from tests.chromium import new_page
from tests.lessons.test_in_lab import chromium, live, notebook
from tests.page.server.rooms import free_port
from tests.waiting import until

__all__ = ["chromium", "live"]  # fixtures
pytestmark = pytest.mark.browser


def test_keys_drive_without_a_click_and_the_notebook_says_who_has_them(
    chromium: Browser, live: Live
) -> None:
    page = new_page(chromium, 1366, 768)
    url = f"http://localhost:{free_port()}/"
    page.route(url + "proxy/**", lambda route: route.fulfill(status=404, body="none"))
    frame = notebook(page, url, live, base="/")
    frame.locator(".ai4u-keycap").first.wait_for()
    page.get_by_text("the keys go to the world").wait_for()
    before = live.runner.latest.bodies[0]
    page.keyboard.down("KeyW")
    until(lambda: live.runner.latest.bodies[0].x > before.x + 1)
    page.keyboard.up("KeyW")
    box = page.locator("iframe").bounding_box()
    assert box is not None
    assert box["y"] >= 0
    assert box["y"] + box["height"] <= 768
    asks = f"{live.port}/healthz"
    with page.expect_event("requestfinished", lambda each: asks in each.url):
        pass  # the notebook asks every 5 s whether the world is still there
    page.locator("iframe").evaluate("frame => frame.blur()")
    say = page.locator("[data-say]")
    expect(say).to_have_text("Click here to drive")
    say.click()
    page.get_by_text("the keys go to the world").wait_for()
    page.context.close()


def test_who_is_typing_keeps_the_keys(chromium: Browser, live: Live) -> None:
    page = new_page(chromium, 1366, 768)
    url = f"http://localhost:{free_port()}/"
    page.route(url + "proxy/**", lambda route: route.fulfill(status=404, body="none"))
    page.add_init_script(
        "addEventListener('DOMContentLoaded', () => {"
        "const cell = document.createElement('textarea'); document.body.append(cell); cell.focus();"
        "})"
    )
    frame = notebook(page, url, live, base="/")
    frame.locator(".ai4u-keycap").first.wait_for()
    page.get_by_text("Click here to drive").wait_for()
    page.keyboard.type("dd")
    assert page.locator("textarea").input_value() == "dd"
    page.context.close()
