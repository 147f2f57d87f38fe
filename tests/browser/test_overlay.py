"""The keys on the screen, the driver status and the banners."""

import re
from dataclasses import replace

import pytest
from playwright.sync_api import Locator, Page, expect

from ai4u_edu import ArrowController, BasicAgent, LocalBrain, RemoteBrain, WASDRBMoveController
from tests.browser.served_viser import (
    ServedViser,
    driver_status,
    frames,
    hide_panel,
    recorded_holds,
)
from tests.builders import still
from tests.chromium import until_on
from tests.page.server.rooms import free_port
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.browser


def cap(page: Page, name: str) -> Locator:
    return page.get_by_role("button", name=re.compile(rf"^{name} \("))


def centre(page: Page, name: str) -> tuple[float, float]:
    box = cap(page, name).bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_a_cap_lights_up_while_its_key_is_held_here_and_elsewhere(
    site: ServedViser,
) -> None:
    page, watcher = site.page(), site.page()
    for each in (page, watcher):
        expect(cap(each, "forward")).not_to_have_attribute("data-held", "")
    page.keyboard.down("ArrowUp")
    for each in (page, watcher):
        expect(cap(each, "forward")).to_have_attribute("data-held", "")
        expect(cap(each, "left")).not_to_have_attribute("data-held", "")
    page.keyboard.up("ArrowUp")
    for each in (page, watcher):
        expect(cap(each, "forward")).not_to_have_attribute("data-held", "")


def test_two_pages_and_one_seat(site: ServedViser) -> None:
    first, second = site.page(), site.page()
    expect(driver_status(first)).to_have_text("Press a key to drive")
    first.keyboard.down("KeyW")
    expect(driver_status(first)).to_have_text("You're driving")
    expect(driver_status(second)).to_have_text("Another page drives")
    with recorded_holds(site.room) as holds:
        second.keyboard.press("KeyS")
        second.get_by_role("button", name="Take over").click()
        expect(driver_status(second)).to_have_text("You're driving")
        expect(driver_status(first)).to_have_text("Another page drives")
        assert ["KeyS"] not in holds
    until(lambda: site.room.held == [])
    site.room.runner.pause().result(LIMIT_S)
    for each in (first, second):
        expect(driver_status(each)).to_have_text("Paused")
    site.room.runner.resume().result(LIMIT_S)
    second.keyboard.down("KeyD")
    until(lambda: site.room.held == ["KeyD"])
    site.close(second)
    expect(driver_status(first)).to_have_text("Press a key to drive")


def test_a_cap_can_be_pressed_with_the_mouse(site: ServedViser) -> None:
    page = site.page()
    page.mouse.move(*centre(page, "forward"))
    page.mouse.down()
    until(lambda: site.room.held == ["KeyW"])
    expect(cap(page, "forward")).to_have_attribute("data-held", "")
    page.mouse.up()
    until(lambda: site.room.held == [])
    page.mouse.down()
    until(lambda: site.room.held == ["KeyW"])
    page.mouse.move(640, 400)
    until(lambda: site.room.held == [])
    page.mouse.up()


def test_a_cap_is_a_button_for_whoever_uses_no_pointer(site: ServedViser) -> None:
    page = site.page()
    cap(page, "forward").focus()
    page.keyboard.press("Enter")
    until(lambda: site.pose()[0] > 0)
    until(lambda: site.room.held == [])


def test_caps_show_what_is_printed_on_this_keyboard(site: ServedViser) -> None:
    azerty = "navigator.keyboard.getLayoutMap = async () => new Map([['KeyW', 'z'], ['KeyA', 'q']])"
    page = site.page(prepare=lambda page: page.add_init_script(azerty))
    assert cap(page, "forward").locator("kbd").inner_text() == "Z"
    assert cap(page, "left").locator("kbd").inner_text() == "Q"
    assert cap(page, "right").locator("kbd").inner_text() == "D"


def test_another_brain_can_be_taken_over_and_one_elsewhere_too(site: ServedViser) -> None:
    page = site.page()
    agent = site.room.sim.agents[0]
    site.room.runner.submit(lambda: agent.use_brain(LocalBrain(controller=still)))
    expect(driver_status(page)).to_have_text("A script drives \u2013 press W to take over")
    expect(page.locator(".ai4u-keycap")).to_have_count(7)
    site.room.runner.submit(lambda: agent.use_brain(RemoteBrain(port=free_port())))
    expect(driver_status(page)).to_have_text(
        "A script elsewhere drives \u2013 press W to take over"
    )
    expect(page.locator(".ai4u-keycap")).to_have_count(7)
    expect(page.get_by_role("button", name="Take over")).to_be_visible()


def test_the_caps_lie_as_the_keys_do(site: ServedViser) -> None:
    page = site.page()
    agent = site.room.sim.agents[0]
    for controller, left in ((WASDRBMoveController(), "A"), (ArrowController(), "←")):
        brain = LocalBrain(controller=controller)
        site.room.runner.submit(lambda brain=brain: agent.use_brain(brain))  # type: ignore[misc]
        expect(cap(page, "left").locator("kbd")).to_have_text(left)
        forward, back, left_one, right = (
            centre(page, name) for name in ("forward", "back", "left", "right")
        )
        assert forward[0] == pytest.approx(back[0], abs=1)
        assert forward[1] < back[1]
        assert left_one[0] < back[0] < right[0]
        assert centre(page, "jump")[0] > right[0]


def test_the_end_of_an_episode_and_a_new_one(site: ServedViser) -> None:
    page = site.page()
    agent = site.room.sim.agents[0]

    def pay(amount: float) -> None:
        site.room.runner.submit(
            lambda: agent.add_reward(amount, request_done=True, name="goal")
        ).result(LIMIT_S)

    banner = page.locator(".ai4u-banner")
    pay(100)
    expect(banner).to_contain_text("You did it!")  # nobody drove, so there is no time
    expect(banner).to_contain_text("Press R to play again.")
    expect(banner.get_by_role("button")).to_have_text(["Play again", "New start", "Next scene"])
    page.keyboard.press("KeyR")
    expect(banner).to_have_count(0)
    pay(-1)
    expect(banner).to_contain_text("The try is over. Press R to try again.")
    page.get_by_role("button", name="Try again").click()
    expect(banner).to_have_count(0)


def test_over_the_small_picture_of_a_phone_s_open_panel_banners_are_low(site: ServedViser) -> None:
    page = site.page(width=390, height=844)
    page.evaluate(
        "Object.assign(document.documentElement.dataset, "
        "{ ai4uPanel: 'open', ai4uLayout: 'sheet' })"
    )
    agent, runner = site.room.sim.agents[0], site.room.runner
    banner = page.locator(".ai4u-banner")
    runner.submit(lambda: agent.add_reward(100, request_done=True, name="goal")).result(LIMIT_S)
    expect(banner.get_by_role("button")).to_have_text(["Play again"])  # the panel has the others
    box = banner.bounding_box()
    assert box is not None
    assert box["y"] + box["height"] < 60


def test_an_error_is_told_as_text_and_can_be_reset(site: ServedViser) -> None:
    page = site.page()

    def broken(_: BasicAgent) -> None:
        raise RuntimeError("<img src=x onerror=alert(1)> is no number")

    event = site.room.sim.agents[0].end_of_step
    event.connect(broken)
    alert = page.locator(".ai4u-banners[role=alert]")
    expect(alert).to_contain_text("RuntimeError: <img src=x onerror=alert(1)> is no number")
    event.disconnect(broken)
    alert.get_by_role("button", name="Reset").click()
    expect(alert).to_be_empty()
    event.connect(broken)
    expect(alert).to_contain_text("is no number")
    event.disconnect(broken)
    page.keyboard.press("KeyR")
    expect(alert).to_be_empty()


def test_a_click_counts_though_the_words_beside_its_button_change(site: ServedViser) -> None:
    page, runner = site.page(), site.room.runner

    def show(moment: str) -> None:
        runner.show_past(replace(runner.latest, past=moment)).result(LIMIT_S)
        expect(page.locator(".ai4u-banner")).to_contain_text(f"Past: {moment}")

    show("episode 1, step 1 of 9")
    page.get_by_role("button", name="Back to live").hover()
    page.mouse.down()
    show("episode 1, step 2 of 9")
    page.mouse.up()
    expect(page.locator(".ai4u-banner")).to_have_count(0)
    assert not runner.latest.past


def test_an_agent_that_is_not_there_is_told(site: ServedViser) -> None:
    page = site.page("?agent=7", wait=False)
    expect(page.locator(".ai4u-banners[role=alert]")).to_contain_text("there is no such agent")


def test_the_caps_are_free_and_the_middle_is_too(site: ServedViser) -> None:
    page = site.page(has_viser=True)
    hide_panel(page)
    inside = "([x, y]) => document.elementFromPoint(x, y)?.closest('.ai4u-keycap')?.dataset.action"
    for width, height in [(390, 844), (844, 390), (1280, 800)]:
        page.set_viewport_size({"width": width, "height": height})
        frames(page)
        for name, action in (("forward", "forward"), ("back", "backward"), ("restart", "restart")):
            until_on(page, lambda: page.evaluate(inside, centre(page, name)) == action)  # noqa: B023
        tag = "([x, y]) => document.elementFromPoint(x, y).tagName"
        until_on(page, lambda: page.evaluate(tag, [width / 2, height / 2]) == "CANVAS")  # noqa: B023
