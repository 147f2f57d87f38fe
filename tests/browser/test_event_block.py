"""A sensor of events: added in the tab Build, and decided by in the tab Code, by blocks."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.blocks_keys import choose, go
from tests.browser.code_page import WORLD_WAITS, set_limits
from tests.browser.served_viser import record_texts
from tests.browser.test_blocks_drives import BlocksTab
from tests.browser.whole import card, open_tab, press, show_details, whole_page
from tests.playing import Played, played
from tests.waiting import until

pytestmark = pytest.mark.browser

SCENE = """
name: bump
title: Bump
goal: Touch the box.
controls: W forward
bodies:
  - {name: robot, shape: {type: circle, radius: 0.4}, tags: [agent], colour: blue}
  - {name: box, shape: {type: box, size: [1, 6]}, position: [3, 0], kind: static, colour: orange}
areas:
  - {name: goal, shape: {type: circle, radius: 0.4}, position: [-2, 0]}
agents:
  - id: "0"
    body: robot
    actuators:
      - {type: RBMoveActuator, move_amount: 2, turn_amount: 2, jump_power: 0, jump_forward_power: 0}
    brains:
      - type: LocalBrain
        controller: {type: WASDController, jump: [], jump_forward: []}
"""
SLOW = "--time-scale", "0.1"
"""A reading is there for one decision only: long enough for the panel to show it, and for a program
to decide by it, however busy the machine is."""
PROGRAM = (
    "def decide(percept):\n"
    "    forward = turn = 0\n"
    '    if percept["event"][0] > 0:\n'
    "        turn = 1\n"
    "    else:\n"
    "        forward = 1\n"
    '    return {"move": [forward, turn, 0, 0]}\n'
)


@pytest.fixture
def server(tmp_path: Path) -> Iterator[Played]:
    scene = tmp_path / "bump.yaml"
    scene.write_text(SCENE)
    with played(str(scene), *SLOW, *WORLD_WAITS) as server:
        yield server


@pytest.fixture
def page(chromium: Browser, server: Played) -> Iterator[Page]:
    with whole_page(chromium, server) as page:
        set_limits(page)
        yield page


def read(server: Played) -> list[float]:
    percept: dict[str, Any] = server.snapshot()["agents"][0]["percept"]
    return list(percept.get("event", ()))


def add_event(page: Page, server: Played) -> None:
    open_tab(page, "Build")
    press(page, "Add a sensor")
    page.locator("dialog[open] .ai4u-tile", has_text="Something happened").click()
    until(lambda: read(server) == [0.0])
    event = card(page, "Something happened").last
    event.get_by_label("target", exact=True).select_option("box")
    expect(event.locator(".ai4u-card-reads")).to_contain_text("target: box")


def test_a_touch_is_seen_as_a_reading_of_the_new_sensor(page: Page, server: Played) -> None:
    add_event(page, server)
    show_details(page)
    open_tab(page, "Drive")
    reading = page.locator(".ai4u-sensor", has_text="Something happened").locator(".ai4u-bar-row")
    expect(reading).to_contain_text("0")
    texts = record_texts(page, ".ai4u-sensor .ai4u-bar-row")
    page.keyboard.down("KeyW")
    until(lambda: any("1" in text for text in texts()))
    page.keyboard.up("KeyW")
    until(lambda: read(server) == [0.0])
    assert server.snapshot()["agents"][0]["pose"][0] > 1.5, "it stands at the box"


@pytest.mark.nightly
def test_blocks_decide_by_an_event(page: Page, server: Played) -> None:
    add_event(page, server)
    page.get_by_role("tab", name="Drive", exact=True).click()
    tab = BlocksTab(page)
    choose(page, "Control", "if, Empty, has 2 branches")
    choose(page, "Senses", "event has just happened")
    go(page, "ArrowUp", "if,")
    choose(page, "Actions", "turn")
    go(page, "ArrowDown", "End else")
    choose(page, "Actions", "forward")
    expect(tab.editor).to_contain_text("forward = 1")
    assert re.sub(r"( {8}turn = )[\d.]+", r"\g<1>1", tab.text) == PROGRAM
    assert server.snapshot()["agents"][0]["pose"][3] == 0
    tab.keys("Control+Enter")
    until(lambda: server.snapshot()["agents"][0]["pose"][3] != 0)
    assert server.snapshot()["agents"][0]["pose"][0] > 1.5, "it has driven to the box before"
