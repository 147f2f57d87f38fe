"""A start waits for a key, is repeated or drawn again; keys work after the panel was used."""

from functools import partial

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.sent_frames import SentFrames
from tests.browser.served_viser import ServedViser, driver_status, ready
from tests.chromium import new_page
from tests.playing import Played, played
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.browser


@pytest.fixture
def waits_for_key() -> bool:
    return True


def banner(page: Page) -> Locator:
    return page.locator(".ai4u-banner")


def tick(site: ServedViser) -> int:
    return site.room.runner.latest.tick


def waits(site: ServedViser) -> bool:
    latest = site.room.runner.latest
    return latest.tick == 0 and latest.waiting == "key"


def drives(site: ServedViser, page: Page) -> None:
    """Check that W drives now."""
    expect(driver_status(page)).not_to_have_text("Click the picture to drive")
    x = site.pose()[0]
    page.keyboard.down("KeyW")
    until(lambda: site.pose()[0] > x)
    page.keyboard.up("KeyW")


def test_a_key_starts_and_drives_and_r_repeats_the_start(site: ServedViser) -> None:
    page = site.page()
    expect(driver_status(page)).to_have_text("Press a key to start")
    expect(banner(page)).to_have_text("Press a key to start")
    assert waits(site)
    drives(site, page)
    expect(driver_status(page)).to_have_text("You're driving")
    expect(banner(page)).to_have_count(0)
    page.keyboard.press("KeyR")
    expect(driver_status(page)).to_have_text("Press a key to start")
    assert waits(site)
    assert site.room.runner.latest.seed == 1
    drives(site, page)


@pytest.mark.parametrize("key", ["Enter", "KeyQ"])
def test_a_key_that_drives_nothing_starts_too(site: ServedViser, key: str) -> None:
    page = site.page()
    expect(banner(page)).to_have_text("Press a key to start")
    page.keyboard.press(key)
    until(lambda: tick(site) > 0)
    expect(driver_status(page)).to_have_text("You're driving")


def test_keys_of_the_browser_and_of_the_help_do_not_start(
    site: ServedViser, subtests: pytest.Subtests
) -> None:
    sent: list[SentFrames] = []
    page = site.page(prepare=lambda page: sent.append(SentFrames(page)))
    expect(banner(page)).to_have_text("Press a key to start")
    for key in ("?", "Escape", "Tab", "Shift", "F9", "Control+KeyB"):
        with subtests.test(key):
            page.keyboard.press(key)
            page.keyboard.press("Escape")
            assert sent[0].take() == []
    assert waits(site)
    page.evaluate("document.activeElement.blur()")
    page.keyboard.press("KeyQ")
    assert len(sent[0].take()) == 1
    until(lambda: not waits(site))


def test_a_touch_screen_is_told_to_push_the_stick(site: ServedViser) -> None:
    page = site.page(touch=True)
    expect(driver_status(page)).to_have_text("Move the stick to start")
    expect(banner(page)).to_have_text("Move the stick to start")


def test_the_result_offers_the_same_start_and_a_new_one(site: ServedViser) -> None:
    page = site.page()
    runner, agent = site.room.runner, site.room.sim.agents[0]

    def end() -> None:
        page.keyboard.press("KeyW")
        until(lambda: tick(site) > 0)
        runner.submit(lambda: agent.add_reward(-1, request_done=True)).result(LIMIT_S)

    seeds = []
    for name in ("Try again", "New start", "Try again"):
        end()
        page.get_by_role("button", name=name).click()
        until(lambda: waits(site))
        seeds.append(runner.latest.seed)
    end()
    page.keyboard.press("KeyN")
    until(lambda: waits(site))
    assert seeds[0] == 1
    assert seeds[1] == seeds[2]
    assert len({*seeds, runner.latest.seed}) == 3


def test_another_page_says_that_a_player_has_to_start(site: ServedViser) -> None:
    page, other = site.page(), site.page()
    page.keyboard.press("KeyW")
    page.keyboard.press("KeyR")
    expect(banner(page)).to_have_text("Press a key to start")
    expect(banner(other)).to_have_text("Waits until a player presses a key")
    expect(driver_status(other)).to_have_text("Another page drives")


def has_seed(server: Played, seed: int) -> bool:
    return bool(server.snapshot()["seed"] == seed)


# -- the focus -----------------------------------------------------------------------------------


def test_keys_drive_again_after_the_panel_was_used(chromium: Browser) -> None:
    with played("box_chase", "--seed", "1", waits_for_key=True) as server:
        page = new_page(chromium)
        page.goto(server.url)
        ready(page)
        page.get_by_role("button", name="Details").click()
        seed = page.get_by_label("Seed", exact=True)
        for leave, ends in (("Enter", 7), ("Escape", 8), ("picture", 9)):
            seed.click()
            expect(driver_status(page).first).to_have_text("Click the picture to drive")
            seed.fill(str(ends))
            if leave == "picture":
                page.mouse.click(400, 300)
            else:
                page.keyboard.press(leave)
            expect(driver_status(page).first).to_have_text("Press a key to start")
            # the panel's socket and that of the keys don't wait for each other
            until(partial(has_seed, server, ends))
            page.keyboard.press("KeyW")
            until(lambda: server.snapshot()["tick"] > 0)
            page.keyboard.press("KeyR")
            until(lambda: server.snapshot()["waiting"] == "key")
        page.get_by_label("Speed", exact=True).select_option("2x")
        until(lambda: server.snapshot()["time_scale"] == 2)
        page.mouse.click(400, 300)
        page.keyboard.press("KeyW")
        until(lambda: server.snapshot()["tick"] > 0)
        page.context.close()


def test_the_notice_about_the_graphics_card_is_in_the_help(site: ServedViser) -> None:
    page = site.page(has_viser=True)
    notice = page.locator("#webgl-software-rendering")
    notice.wait_for(state="attached")
    expect(notice).to_be_hidden()
    page.get_by_role("button", name="Help").click()
    expect(page.get_by_text("Drawn without a graphics card")).to_be_visible()
