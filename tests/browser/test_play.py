"""The whole thing as a person has it: the command, its page, and the keys."""

import re
import signal
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.served_viser import connected, ready
from tests.chromium import new_page
from tests.playing import Played, played
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.browser

MIDDLE = "5"
"""A seed with which box_chase_ai4u puts the robot into the middle, looking along +x."""


@pytest.fixture(scope="module")
def shared() -> Iterator[Played]:
    with played("box_chase_ai4u") as server:
        yield server


@pytest.fixture
def server(shared: Played) -> Played:
    shared.restart(int(MIDDLE))
    return shared


@pytest.fixture(scope="module")
def opened(shared: Played, chromium: Browser) -> Iterator[Page]:
    page = new_page(chromium)
    page.goto(shared.url)
    ready(page)
    yield page
    page.context.close()


@pytest.fixture
def page(server: Played, opened: Page) -> Page:
    """A page of the server, which has begun an episode."""
    assert server.snapshot()["tick"] >= 0
    return opened


def agent(server: Played) -> dict[str, Any]:
    found: dict[str, Any] = server.snapshot()["agents"][0]
    return found


def hold(page: Page, key: str, met: Callable[[], bool]) -> None:
    page.keyboard.down(key)
    until(met)
    page.keyboard.up(key)


def test_off_the_plate_it_falls_and_r_restarts(server: Played, page: Page) -> None:
    assert agent(server)["pose"] == [0, 0, 0, 0]
    hold(page, "KeyW", lambda: agent(server)["terminated"])
    state = agent(server)
    assert state["reward_terms"]["fall"] == -1
    assert state["pose"][0] > 5
    assert state["pose"][1:2] == [0]
    page.get_by_text("You fell.").wait_for()
    until(lambda: agent(server)["pose"][2] < -1.5)  # and it goes on falling while one looks
    episode = server.snapshot()["episode"]
    page.keyboard.press("KeyR")
    until(lambda: not agent(server)["terminated"])
    assert server.snapshot()["episode"] == episode + 1
    assert agent(server)["pose"][2] == 0


def test_to_the_box_it_is_a_hundred_and_the_end(server: Played, page: Page) -> None:
    hold(page, "KeyS", lambda: agent(server)["terminated"])  # the box is right behind
    state = agent(server)
    assert state["reward_terms"]["touch"] == 100
    assert -3 < state["pose"][0] < -1.3  # where it touched, and as far as it coasted since
    page.get_by_text(re.compile(r"You did it! \d+\.\d s")).wait_for()


def test_the_page_shows_what_the_agent_senses(server: Played, page: Page) -> None:
    page.get_by_role("button", name="Details").click()
    for text in ("Box chase", "Ray picture", "Direction and distance", "My last action", "Rewards"):
        page.locator(".ai4u-panel").get_by_text(text, exact=False).first.wait_for()
    assert page.evaluate(
        "performance.getEntriesByType('resource').every(each => "
        "new URL(each.name).host === location.host || "
        "/^(blob|data):/.test(each.name))"
    )


def test_the_goal_is_told_until_somebody_drives(page: Page) -> None:
    page.reload()
    task = page.locator(".ai4u-banner[data-kind=task]")
    expect(task).to_contain_text("Reach the box and touch it.")
    connected(page)
    page.keyboard.press("KeyA")
    expect(task).to_have_count(0)
    expect(page.locator(".ai4u-goal-text")).to_contain_text("Reach the box and touch it.")


def test_there_are_no_keys_for_what_the_robot_can_not_do(page: Page) -> None:
    expect(page.locator(".ai4u-keycap")).to_have_count(5)
    expect(page.locator(".ai4u-keycap[data-action=jump]")).to_have_count(0)


def test_ctrl_c_ends_it_cleanly(chromium: Browser) -> None:
    with played("box_chase_ai4u") as server:
        page = new_page(chromium)
        page.goto(server.url)
        connected(page)
        server.process.send_signal(signal.SIGINT)
        assert server.process.wait(LIMIT_S) == 0
        page.context.close()
    assert "Traceback" not in "".join(server.told)


def test_a_taken_port_is_said(server: Played) -> None:
    import subprocess
    import sys

    port = server.url.rstrip("/").rsplit(":", 1)[1]
    command = [sys.executable, "-m", "ai4u_edu", "play", "--no-open", "--port", port]
    told = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT_S, check=False)
    assert told.returncode == 1
    assert told.stderr.startswith(f"error: port {port} is taken")
    assert "--port 0" in told.stderr
