"""Keys drive, and nothing else does; whatever they drive, viser's camera stays where it is."""

import math
from typing import NamedTuple

import pytest
from playwright.sync_api import Page, expect

from ai4u_edu import BasicAgent
from ai4u_edu.blocks.keyboard import Stick
from tests.browser.served_viser import (
    SPEED,
    TURN,
    ServedViser,
    driver_status,
    frames,
    recorded_holds,
    viser_heard,
)
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.browser

DECISIONS = 9
"""Decisions during which a key is held."""
DECISION_S = 5 / 60
"""World time (s) of a decision of the robot in these tests."""


def held(site: ServedViser) -> list[str]:
    return site.room.held


def stays_still(site: ServedViser) -> bool:
    """Return True if the robot comes to rest, and stays there for 0.4 s of the world.

    Raises:
        AssertionError: it goes on; the text says where it was and what moved it.
    """
    until(lambda: did_not_move(site, 12))  # longer than two decisions take
    *rest, begin = site.pose()
    until(lambda: site.pose()[3] >= begin + 24)
    *pose, end = site.pose()
    assert pose == rest, f"{rest} at {begin}, {pose} at {end}, {held(site)}, {site.room.move}"
    return True


def did_not_move(site: ServedViser, ticks: int) -> bool:
    """Return True if the robot is after some ticks where it is now."""
    *pose, begin = site.pose()
    until(lambda: site.pose()[3] >= begin + ticks)
    return list(site.pose()[:3]) == pose


class Pose(NamedTuple):
    """Pose of the robot at the end of a decision."""

    x: float
    y: float
    heading: float


def stretch(site: ServedViser, code: str) -> list[Pose]:
    """Return the robot's poses after some decisions on end, in which a key is held."""
    agent = site.room.sim.agents[0]
    found: list[Pose] = []

    def note(agent: BasicAgent) -> None:
        if len(found) == DECISIONS:
            return
        if code in agent.keyboard.held():
            found.append(Pose(*agent.body.position, agent.body.heading))

    agent.end_of_step.connect(note)
    until(lambda: len(found) == DECISIONS)
    return found[2:]  # what was held in the decision before counts to its end


def test_w_drives_ahead_at_its_speed(site: ServedViser) -> None:
    page = site.page()
    page.keyboard.down("KeyW")
    first, *_, last = states = stretch(site, "KeyW")
    page.keyboard.up("KeyW")
    assert last.x - first.x == pytest.approx(SPEED * (len(states) - 1) * DECISION_S, rel=0.1)
    assert (last.y, last.heading) == (0, 0)


@pytest.mark.parametrize(("key", "sign"), [("KeyD", -1), ("KeyA", 1), ("ArrowRight", -1)])
def test_d_turns_clockwise_and_a_the_other_way(site: ServedViser, key: str, sign: int) -> None:
    page = site.page()
    page.keyboard.down(key)
    first, *_, last = states = stretch(site, key)
    page.keyboard.up(key)
    turned = (last.heading - first.heading + math.pi) % math.tau - math.pi
    assert turned == pytest.approx(sign * TURN * (len(states) - 1) * DECISION_S, rel=0.1)
    assert (last.x, last.y) == (0, 0)


def test_letting_go_stops_within_two_decisions(site: ServedViser) -> None:
    agent = site.room.sim.agents[0]
    moved: list[int] = []
    released: list[int] = []
    """Decision in which the release was known."""

    def note(agent: BasicAgent) -> None:
        if agent.last_action["move"][0]:
            moved.append(agent.steps)

    hold = agent.keyboard.hold

    def noted_hold(codes: list[str], stick: Stick) -> None:
        hold(codes, stick)
        if not codes:  # noted afterwards: this thread may stand still at any moment
            released.append(agent.steps)

    agent.end_of_step.connect(note)
    agent.keyboard.hold = noted_hold  # type: ignore[method-assign,assignment]
    page = site.page()
    page.keyboard.down("KeyW")
    until(lambda: len(moved) > 5)
    page.keyboard.up("KeyW")
    until(lambda: released)
    until(lambda: agent.steps > released[0] + 5)
    assert moved[-1] <= released[0] + 2
    assert stays_still(site)


def test_a_tap_is_never_missed(site: ServedViser) -> None:
    page = site.page()
    for _ in range(5):
        until(lambda: did_not_move(site, 12))
        x = site.pose()[0]
        page.keyboard.press("KeyW")
        until(lambda x=x: site.pose()[0] > x)  # type: ignore[misc]


@pytest.mark.parametrize(
    "loss",
    [
        "window.dispatchEvent(new Event('blur'))",
        "window.dispatchEvent(new PageTransitionEvent('pagehide'))",
        "Object.defineProperty(document, 'hidden', {get: () => true});"
        "document.dispatchEvent(new Event('visibilitychange'))",
    ],
)
def test_a_page_that_loses_sight_lets_go(site: ServedViser, loss: str) -> None:
    page = site.page()
    page.keyboard.down("KeyW")
    until(lambda: held(site) == ["KeyW"])
    page.evaluate(loss)
    until(lambda: held(site) == [])
    assert stays_still(site)


def test_a_pause_lets_go_until_the_key_is_pressed_anew(site: ServedViser) -> None:
    page = site.page()
    page.keyboard.down("KeyW")
    until(lambda: held(site) == ["KeyW"])
    site.room.runner.pause().result(LIMIT_S)
    expect(page.locator(".ai4u-banner", has_text="Paused")).to_be_visible()
    page.get_by_role("button", name="Resume").click()
    until(lambda: not site.room.runner.latest.paused)
    with recorded_holds(site.room) as holds:
        page.keyboard.down("KeyW")  # a browser repeats a key that is held
        page.keyboard.down("KeyD")
        until(lambda: held(site) == ["KeyD"])
        assert not any("KeyW" in codes for codes in holds)
    page.keyboard.up("KeyW")
    page.keyboard.down("KeyW")
    until(lambda: held(site) == ["KeyD", "KeyW"])


MOVING = ["KeyW", "KeyA", "KeyS", "KeyD", "KeyQ", "KeyE"]
ARROWS = ["ArrowUp", "ArrowLeft", "ArrowDown", "ArrowRight"]


def test_visers_camera_does_not_move(site: ServedViser) -> None:
    page = site.page(has_viser=True)
    before = site.camera()
    for code in MOVING + ARROWS:
        page.keyboard.down(code)
        frames(page, 5)  # viser moves its camera with each frame while a key is held
        page.keyboard.up(code)
    page.keyboard.press("Control+KeyA")
    frames(page, 5)
    viser_heard(site, page)
    assert site.camera() == before


@pytest.mark.nightly
def test_without_our_script_it_would_have_moved(site: ServedViser) -> None:
    def leave_out(page: Page) -> None:
        page.route("**/web-*/page/main.js", lambda route: route.fulfill(body=""))

    page = site.page(has_viser=True, prepare=leave_out, wait=False)
    page.get_by_text("Name", exact=True).wait_for()
    before = site.camera()
    page.keyboard.down("KeyW")
    frames(page, 5)
    page.keyboard.up("KeyW")
    viser_heard(site, page)
    assert site.camera() != before


def test_typing_drives_nothing_and_arrives(site: ServedViser) -> None:
    page = site.page(has_viser=True)
    episode = site.room.runner.latest.episode
    with recorded_holds(site.room) as holds:
        page.get_by_role("textbox").first.click()
        page.keyboard.type("wasd r")
        until(lambda: site.name.value == "wasd r")
        expect(driver_status(page)).to_have_text("Click the picture to drive")
        page.mouse.click(400, 400)
        page.keyboard.down("KeyS")
        until(lambda: held(site) == ["KeyS"])
        assert [codes for codes in holds if codes != ["KeyS"]] == []
    assert site.room.runner.latest.episode == episode


def test_going_to_a_text_box_lets_go(site: ServedViser) -> None:
    page = site.page()
    page.keyboard.down("KeyW")
    until(lambda: held(site) == ["KeyW"])
    page.get_by_role("textbox").first.focus()
    until(lambda: held(site) == [])
    assert stays_still(site)


def test_leaving_the_text_box_drives_again(site: ServedViser) -> None:
    page = site.page()
    page.get_by_role("textbox").first.click()
    page.mouse.click(400, 400)
    page.keyboard.down("KeyW")
    until(lambda: held(site) == ["KeyW"])


def test_another_layout_drives_by_place(site: ServedViser) -> None:
    page = site.page()
    event = "new KeyboardEvent('{kind}', {{code: '{code}', key: '{key}', bubbles: true}})"
    for code, key in (("KeyW", "z"), ("KeyA", "q")):
        pressed = event.format(kind="keydown", code=code, key=key)
        page.evaluate(f"document.body.dispatchEvent({pressed})")
        until(lambda code=code: held(site) == [code])  # type: ignore[misc]
        released = event.format(kind="keyup", code=code, key=key)
        page.evaluate(f"document.body.dispatchEvent({released})")
        until(lambda: held(site) == [])
    with recorded_holds(site.room) as holds:
        for code, key in (("KeyZ", "w"), ("KeyW", "z")):
            pressed = event.format(kind="keydown", code=code, key=key)
            page.evaluate(f"document.body.dispatchEvent({pressed})")
        until(lambda: holds)
        assert holds[0] == ["KeyW"]


@pytest.mark.parametrize("modifier", ["Control", "Meta", "Alt"])
def test_chords_drive_nothing_and_let_go(site: ServedViser, modifier: str) -> None:
    page = site.page()
    with recorded_holds(site.room) as holds:
        page.keyboard.press(f"{modifier}+KeyD")
        page.keyboard.down("KeyW")
        until(lambda: held(site) == ["KeyW"])
        page.keyboard.down(modifier)
        page.keyboard.down("KeyD")
        until(lambda: held(site) == [])
        assert not any("KeyD" in codes for codes in holds)


def test_space_jumps_and_presses_no_button_that_was_clicked_before(
    site: ServedViser,
) -> None:
    page = site.page(has_viser=True)
    page.get_by_role("button", name="Press me").click()
    until(lambda: len(site.clicks) == 1)
    page.evaluate("addEventListener('click', () => (window.isClicked = true), { capture: true })")
    page.keyboard.down("Space")
    until(lambda: held(site) == ["Space"])
    page.keyboard.up("Space")  # a browser clicks a button when Space is released
    until(lambda: held(site) == [])
    assert not page.evaluate("window.isClicked")
    viser_heard(site, page)
    assert len(site.clicks) == 1


def test_who_walks_by_tab_presses_buttons_with_space(site: ServedViser) -> None:
    page = site.page()
    page.get_by_role("textbox").first.focus()
    page.keyboard.press("Tab")
    button = page.get_by_role("button", name="Press me")
    expect(button).to_be_focused()
    with recorded_holds(site.room) as holds:
        page.keyboard.press("Space")
        expect(button).to_have_attribute("data-clicks", "1")
        page.keyboard.down("KeyW")
        until(lambda: held(site) == ["KeyW"])
        assert not any("Space" in codes for codes in holds)


def test_restart_begins_a_new_episode(site: ServedViser) -> None:
    page = site.page()
    episode = site.room.runner.latest.episode
    page.keyboard.press("KeyR")
    until(lambda: site.room.runner.latest.episode == episode + 1)
