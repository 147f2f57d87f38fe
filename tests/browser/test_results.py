"""The result of an episode that a person won: time, best time, sounds, and the next scene."""

import json

import pytest
from playwright.sync_api import Browser, Page, WebSocket, expect

from ai4u_edu import BasicAgent
from tests.browser.plain_page import WITHOUT_VISER
from tests.browser.served_viser import ServedViser, connected, ready
from tests.chromium import new_page, until_on
from tests.playing import played
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.browser

COUNT_TONES = """
window.tones = 0;
window.OscillatorNode = class extends OscillatorNode {
  constructor(...given) { super(...given); window.tones += this.type === "triangle" ? 1 : 0; }
};
"""


def win(site: ServedViser, page: Page, decisions: int) -> str:
    """Reach the goal some decisions (1/12 s each) after a reset; return the banner's text."""
    paid_at = decisions - 1  # the episode ends one decision later
    agent = site.room.sim.agents[0]
    before = agent.episode

    def pay(agent: BasicAgent) -> None:
        if agent.episode == before + 1 and agent.steps == paid_at:
            agent.add_reward(100, request_done=True, name="goal")

    old = "document.querySelector('.ai4u-banner')?.toggleAttribute('data-old', true)"
    page.evaluate(old)
    banner = page.locator(".ai4u-banner[data-kind=goal]:not([data-old])")
    agent.end_of_step.connect(pay)  # in the world's thread, which alone knows the moment
    page.keyboard.press("KeyR")
    text = str(banner.locator("strong").text_content())
    agent.end_of_step.disconnect(pay)
    return text


@pytest.mark.nightly
def test_the_time_is_compared_with_the_best_one_of_this_browser(site: ServedViser) -> None:
    page = site.page()
    assert win(site, page, 12) == "You did it! 1.0 s"
    assert win(site, page, 6) == "You did it! 0.5 s \u2013 your best"
    page.reload()
    ready(page)
    assert win(site, page, 18) == "You did it! 1.5 s (your best: 0.5 s)"


def test_times_of_scenes_and_drivers_are_apart(site: ServedViser) -> None:
    page = site.page()
    found = page.evaluate(
        """async () => {
            const { KEYS, PROGRAM, Results, timeText } = await import("./web/page/results.js");
            const results = new Results();
            let episode = 0;
            const win = (seconds, task, by) => timeText(results.of(
                { outcome: "goal", title: "Any", episode: (episode += 1), seconds }, task, by));
            localStorage.setItem("ai4u-best-times", JSON.stringify({ "Box chase": 3, chase: 2 }));
            return [
                win(9, "chase", KEYS), win(1, "chase", PROGRAM), win(8, "chase", KEYS),
                win(2, "chase", PROGRAM), win(20, "donut", KEYS),
                results.best("chase", KEYS), results.best("donut", PROGRAM),
            ];
        }"""
    )
    assert found == [
        " 9.0 s",
        " 1.0 s",
        " 8.0 s \u2013 your best",
        " 2.0 s (your program's best: 1.0 s)",
        " 20.0 s",
        8,
        None,
    ]


def test_a_win_sounds_once_unless_it_is_muted(site: ServedViser) -> None:
    page = site.page()
    page.add_init_script(COUNT_TONES)
    frames: list[str] = []

    def listen(socket: WebSocket) -> None:
        socket.on("framereceived", lambda frame: frames.append(str(frame)))

    page.on("websocket", listen)
    page.reload()
    ready(page)
    page.get_by_role("button", name="Turn the sound off").click()
    win(site, page, 6)
    assert page.evaluate("window.tones") == 0
    page.get_by_role("button", name="Turn the sound on").click()
    win(site, page, 6)
    frames.clear()
    site.room.runner.pause().result(LIMIT_S)
    until_on(page, lambda: any(json.loads(frame).get("paused") for frame in frames))
    site.room.runner.resume().result(LIMIT_S)
    page.keyboard.press("KeyR")
    expect(page.locator(".ai4u-banner[data-kind=goal]")).to_have_count(0)
    # the page was told of the same result again, and has handled that
    assert page.evaluate("window.tones") == 4  # its notes


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
        until(lambda: server.health()["scene"] not in ("", "Box chase, hard start"))
        page.context.close()
