"""Maps over the floor and the stand-in, on the page of a real ``ai4u-edu play``."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from ai4u_edu.base.colors import rgb
from tests.browser.keys import carry, take, where, whole
from tests.browser.whole import press, share, until_drawn, until_settled, whole_page
from tests.playing import Played, played
from tests.waiting import until

pytestmark = [pytest.mark.browser, pytest.mark.nightly]

HALF = 5.0
"""Half of the arena's side (m)."""


@pytest.fixture(scope="module")
def server() -> Iterator[Played]:
    arguments = ("--brain", "zoo", "--seed", "1", "--time-scale", "0.2")
    with played("box_chase", *arguments) as server:
        yield server


@pytest.fixture(scope="module")
def page(server: Played, chromium: Browser) -> Iterator[Page]:
    with whole_page(chromium, server, draws=True) as page:
        press(page, "Pause")
        until(lambda: server.snapshot()["paused"])
        press(page, "Try again")  # so that all runs of the test show the same moment
        until(lambda: server.snapshot()["tick"] == 0)
        whole(page)
        yield page


def test_arrows_and_colours_lie_on_the_floor_until_they_are_cancelled(page: Page) -> None:
    arrows = page.get_by_role("switch", name="Arrows: where it would go")
    arrows.click()
    page.get_by_label("Facing").select_option("box")
    until_drawn(page, lambda picture: share(picture, rgb("blue")) > 0.05)
    colours = page.get_by_role("switch", name="Colours: good and bad places")
    colours.click()
    expect(page.locator(".ai4u-map-progress:visible")).to_have_count(0)
    until_drawn(page, lambda picture: share(picture, rgb("#fee838"), 60) > 0.15)
    colours.click()
    arrows.click()
    until_drawn(page, lambda picture: share(picture, rgb("blue")) < 0.02)


def test_the_stand_in_is_dragged_and_the_robot_stays(server: Played, page: Page) -> None:
    before = where(server, "robot")
    seen = until_settled(page)
    page.get_by_role("switch", name="Try another place").click()
    x, y = page.get_by_label("x (m)"), page.get_by_label("y (m)")
    x.fill("1")
    y.fill("-3")
    expect(page.get_by_text("There it would do:")).to_be_visible()
    until_drawn(page, lambda picture: bool((picture != seen).any()))
    take(page, (1.0, -3.0), HALF)
    carry(page, (1.0, -3.0), (3.0, -3.5), HALF)
    page.mouse.up()
    until(lambda: abs(float(x.input_value()) - 3) < 0.4)
    assert abs(float(y.input_value()) + 3.5) < 0.4
    assert where(server, "robot") == before
    page.get_by_role("switch", name="Try another place").click()
    expect(x).to_be_hidden()
