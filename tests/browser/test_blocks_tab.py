"""The tab for blocks: an agent is changed while it lives."""

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.chromium import new_page
from tests.playing import Played, played
from tests.server.rooms import until

pytestmark = pytest.mark.browser

soon = partial(until, timeout=30)

SCENE = """
name: bare
title: A bare robot
goal: Find the box.
floors:
  - {name: plate, shape: {type: box, size: [12, 12]}}
bodies:
  - {name: robot, shape: {type: circle, radius: 0.5}, position: [-2, 0]}
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [2, 0]
    tags: [target]
agents:
  - id: "0"
    body: robot
    actuators:
      - {type: RBMoveActuator, move_amount: 2, turn_amount: 2}
    brains:
      - type: LocalBrain
        controller: {type: WASDRBMoveController}
"""
SCRIPT = """
def spin(percept):
    return {"move": [0, 1, 0, 0]}
"""


@pytest.fixture
def server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Played]:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    (tmp_path / "bare.yaml").write_text(SCENE)
    (tmp_path / "mine.py").write_text(SCRIPT)
    with played(
        str(tmp_path / "bare.yaml"), "--seed", "1", "--offer", str(tmp_path / "mine.py")
    ) as server:
        yield server


@pytest.fixture
def opened(chromium: Browser, server: Played) -> Iterator[Callable[[], Page]]:
    pages = []

    def open_page() -> Page:
        page = new_page(chromium)
        pages.append(page)
        page.set_default_timeout(60_000)
        page.goto(f"{server.url}?panel=viser")
        page.locator(".ai4u-driver", has_not_text="Connecting").wait_for()
        page.get_by_role("tab", name="Blocks").click()
        return page

    yield open_page
    for page in pages:
        page.context.close()
    assert "Traceback" not in "".join(server.told)


def agent(server: Played) -> dict[str, Any]:
    found: dict[str, Any] = server.snapshot()["agents"][0]
    return found


def choose(page: Page, label: str, option: str) -> None:
    page.get_by_label(label, exact=True).click()
    page.get_by_role("option", name=option).first.click()


def row(page: Page, label: str) -> Locator:
    """A labelled row of a form."""
    return page.locator("label", has_text=label).first.locator("xpath=ancestor::div[2]")


def press(page: Page, name: str) -> None:
    page.get_by_role("button", name=name, exact=True).last.click()


def add(page: Page, block: str) -> None:
    choose(page, "New", block)
    press(page, "Add")
    page.get_by_role("status").get_by_text(f"add {block}: it applies").wait_for()


def test_a_sensor_of_nine_rays_is_added_and_seen(
    opened: Callable[[], Page], server: Played
) -> None:
    page = opened()
    steps = agent(server)["steps"]
    add(page, "LinearRayCastingSensor")
    rays = row(page, "number of rays").locator("input")
    rays.fill("9")
    press(page, "Apply")
    soon(lambda: len(agent(server)["percept"].get("linear_ray_casting", [])) == 9)
    reading = agent(server)["percept"]["linear_ray_casting"]
    assert reading[4] == 1  # the box is ahead
    assert reading[0] == reading[8] == 0
    assert agent(server)["steps"] >= steps  # nothing was reset
    expect(rays).to_have_value("9")
    assert server.snapshot()["episode"] == 1


def test_a_bad_value_is_explained_beside_its_field(
    opened: Callable[[], Page], server: Played
) -> None:
    page = opened()
    add(page, "LinearRayCastingSensor")
    before = agent(server)["percept"]["linear_ray_casting"]
    row(page, "number of rays").locator("input").fill("0")
    row(page, "field of view").locator("input").fill("wide")
    press(page, "Apply")
    alert = page.get_by_role("alert").filter(has_text="expected at least 1, got 0")
    alert.wait_for()
    field, told = row(page, "number of rays").bounding_box(), alert.bounding_box()
    assert field is not None
    assert told is not None
    assert 0 < told["y"] - field["y"] < 60  # right below it
    page.get_by_role("alert").filter(has_text="expected a number, got 'wide'").wait_for()
    assert len(agent(server)["percept"]["linear_ray_casting"]) == len(before)
    row(page, "number of rays").locator("input").fill("5")
    row(page, "field of view").locator("input").fill("45")
    press(page, "Apply")
    expect(page.get_by_role("alert").filter(has_text=", got ")).to_have_count(0)
    soon(lambda: len(agent(server)["percept"]["linear_ray_casting"]) == 5)


def test_off_on_remove_undo_and_redo(opened: Callable[[], Page], server: Played) -> None:
    page = opened()
    add(page, "BearingSensor")
    soon(lambda: "bearing" in agent(server)["percept"])
    press(page, "Off")
    soon(lambda: "bearing" not in agent(server)["percept"])
    press(page, "On")
    soon(lambda: "bearing" in agent(server)["percept"])
    press(page, "Remove")
    soon(lambda: "bearing" not in agent(server)["percept"])
    press(page, "Undo")
    soon(lambda: "bearing" in agent(server)["percept"])
    press(page, "Redo")
    soon(lambda: "bearing" not in agent(server)["percept"])
    for _ in range(4):
        page.wait_for_timeout(200)
        press(page, "Undo")
    page.get_by_text("redo: add BearingSensor").wait_for()
    press(page, "Undo")
    page.get_by_text("there is nothing to undo").wait_for()


def test_how_often_an_agent_decides_is_changed_in_a_form(
    opened: Callable[[], Page], server: Played
) -> None:
    page = opened()
    page.get_by_role("button", name="Agent's settings").click()
    steps = row(page, "max steps per episode").locator("input")
    steps.fill("-5")
    press(page, "Apply")
    page.get_by_role("alert").filter(has_text="expected at least 0, got -5").first.wait_for()
    steps.fill("3")
    row(page, "skip frame").locator("input").fill("9")
    press(page, "Apply")
    told = page.get_by_text("change agent 0: it applies at the next decision").first
    told.wait_for(timeout=40_000)
    soon(lambda: agent(server)["truncated"])
    page.get_by_role("tab", name="Agent").click()
    page.get_by_text("10 ticks").first.wait_for(timeout=40_000)


def test_who_drives_is_swapped_live(opened: Callable[[], Page], server: Played) -> None:
    page = opened()
    episode = server.snapshot()["episode"]
    choose(page, "Driven by", "mine.py: spin")
    soon(lambda: agent(server)["action"].get("move") == [0, 1, 0, 0])
    assert "ScriptController" in agent(server)["brain"]
    choose(page, "Driven by", "WASDRBMoveController")
    soon(lambda: "WASDRBMoveController" in agent(server)["brain"])
    assert server.snapshot()["episode"] == episode
    press(page, "Undo")
    soon(lambda: "ScriptController" in agent(server)["brain"])
    expect(page.get_by_label("Driven by", exact=True)).to_have_value("mine.py: spin")


@pytest.mark.timeout(240)  # two pages draw in turns where there is no graphics card
def test_each_page_has_its_own_form_and_sees_what_the_other_did(
    opened: Callable[[], Page], server: Played
) -> None:
    mine = opened()
    add(mine, "BearingSensor")
    target = row(mine, "target").locator("input").first
    expect(target).to_have_value("box")
    theirs = opened()
    theirs.get_by_text("undo: add BearingSensor").wait_for()
    assert theirs.locator("label", has_text="target").count() == 0
    press(theirs, "Undo")
    soon(lambda: "bearing" not in agent(server)["percept"])
    mine.get_by_text("redo: add BearingSensor").wait_for()
    expect(mine.locator("label", has_text="target")).to_have_count(0, timeout=30_000)


def test_what_a_killed_server_left_is_offered(
    chromium: Browser, server: Played, opened: Callable[[], Page], tmp_path: Path
) -> None:
    page = opened()
    add(page, "BearingSensor")
    soon(lambda: list((tmp_path / "state").rglob("*.unsaved")))
    page.close()
    server.process.kill()
    with played(str(tmp_path / "bare.yaml")) as again:
        soon(lambda: any("is there: ai4u-edu play --restore" in line for line in again.told))
        page = new_page(chromium)
        page.set_default_timeout(60_000)
        page.goto(f"{again.url}?panel=viser")
        page.get_by_role("tab", name="Blocks").click()
        page.get_by_text("An unsaved scene from").wait_for()
        press(page, "Bring it back")
        soon(lambda: "bearing" in agent(again)["percept"])
        page.context.close()
    with played("--restore") as again:
        assert "bearing" in agent(again)["percept"]
