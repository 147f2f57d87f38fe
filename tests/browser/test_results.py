"""The result of an episode that a person won: time, best time, tone, and the next scene."""

import re
import time

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.plain_page import WITHOUT_VISER
from tests.browser.served_viser import ServedViser, connected, ready
from tests.chromium import new_page
from tests.playing import played
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.browser

COUNT_TONES = """
window.tones = 0;
window.AudioContext = class extends AudioContext {
  constructor() { super(); window.tones += 1; }
};
"""


def win(site: ServedViser, page: Page, after_s: float) -> str:
    """Reach the goal a time after the reset; return the banner's text."""
    episode = site.room.runner.latest.episode
    page.keyboard.press("KeyR")
    until(lambda: site.room.runner.latest.episode > episode)
    expect(page.locator(".ai4u-banner[data-kind=goal]")).to_have_count(0)
    agent = site.room.sim.agents[0]
    until(lambda: site.room.runner.latest.episode_time >= after_s)
    site.room.runner.submit(lambda: agent.add_reward(100, request_done=True, name="goal")).result(
        LIMIT_S
    )
    banner = page.locator(".ai4u-banner[data-kind=goal]")
    return str(banner.locator("strong").text_content())


@pytest.mark.nightly
def test_the_time_is_compared_with_the_best_one_of_this_browser(site: ServedViser) -> None:
    page = site.page()
    assert re.fullmatch(r"Reached the goal in \d\.\d s", win(site, page, 1.0))
    assert re.fullmatch(r"Reached the goal in 0\.\d s, your best", win(site, page, 0.2))
    page.reload()
    ready(page)
    slower = win(site, page, 1.5)
    assert re.fullmatch(r"Reached the goal in \d\.\d s \(your best: 0\.\d s\)", slower)


def test_a_tone_is_played_once_it_is_turned_on(site: ServedViser) -> None:
    page = site.page()
    page.add_init_script(COUNT_TONES)
    page.reload()
    ready(page)
    win(site, page, 0.0)
    assert page.evaluate("window.tones") == 0
    page.keyboard.press("?")
    page.get_by_label("Play a short tone when you reach the goal").check()
    page.get_by_role("button", name="Close").click()
    win(site, page, 0.0)
    time.sleep(0.3)  # a second one would come with one of the next messages
    assert page.evaluate("window.tones") == 1


def test_after_a_win_the_next_scene_is_one_click_away(chromium: Browser) -> None:
    with played("box_chase_ai4u") as server:
        page = new_page(chromium)
        WITHOUT_VISER.serve(page, server.url)
        page.goto(server.url)
        connected(page)
        page.keyboard.down("KeyS")  # seed 5: the box is right behind
        server.restart(5)
        page.get_by_role("button", name="Next scene").click()
        page.keyboard.up("KeyS")
        until(lambda: server.health()["scene"] not in ("", "Box chase, as in AI4U"))
        page.context.close()
