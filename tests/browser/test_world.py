"""The tab for the world: things are dragged, added and deleted; scenes are chosen and kept."""

import math
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.keys import body, carry, drag, take, where, whole
from tests.browser.served_viser import ready
from tests.chromium import new_page
from tests.playing import Played, played
from tests.server.rooms import until

pytestmark = pytest.mark.browser

HALF = 6.0
SCENE = """
name: bare
title: A bare robot
floors:
  - {name: plate, shape: {type: box, size: [12, 12]}}
bodies:
  - {name: robot, shape: {type: circle, radius: 0.5}, position: [-2, 0]}
  - name: wall
    shape: {type: box, size: [2, 0.3]}
    position: [2, 0]
    kind: static
    tags: [wall]
agents:
  - id: "0"
    body: robot
    actuators:
      - {type: RBMoveActuator, move_amount: 2, turn_amount: 2}
    brains:
      - type: LocalBrain
        controller: {type: WASDRBMoveController}
"""


@pytest.fixture
def server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Played]:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    (tmp_path / "bare.yaml").write_text(SCENE)
    with played(str(tmp_path / "bare.yaml"), "--seed", "1") as server:
        yield server


@pytest.fixture
def opened(chromium: Browser, server: Played) -> Iterator[Callable[[], Page]]:
    pages = []

    def open_page() -> Page:
        page = new_page(chromium)
        pages.append(page)
        page.goto(f"{server.url}?panel=viser")
        ready(page)
        page.get_by_role("tab", name="World").click()
        return page

    yield open_page
    for page in pages:
        page.context.close()
    assert "Traceback" not in "".join(server.told)


def near(server: Played, name: str, x: float, y: float) -> bool:
    return math.dist(where(server, name), (x, y)) < 0.15


def press(page: Page, name: str) -> None:
    page.get_by_role("button", name=name, exact=True).last.click()


def row(page: Page, label: str) -> Locator:
    """The box that stands beside a label of a form."""
    labels = page.locator("label").get_by_text(label, exact=True)
    return labels.first.locator("xpath=ancestor::div[2]").locator("input")


def moving(page: Page) -> None:
    page.get_by_role("checkbox", name="Move things").click()
    whole(page)


def test_the_mouse_moves_and_turns_a_wall_while_the_time_stands_still(
    opened: Callable[[], Page], server: Played
) -> None:
    page = opened()
    press(page, "Pause")
    until(lambda: server.snapshot()["paused"])
    drag(page, (2, 0), (2, 3), HALF)  # not switched on: nothing moves but the camera
    assert where(server, "wall") == (2, 0)
    moving(page)
    take(page, (2, 0), HALF)
    carry(page, (2, 0), (3, -3), HALF)
    until(lambda: near(server, "wall", 3, -3))  # while it is held
    page.get_by_text("undo: move wall").wait_for(state="detached")
    page.mouse.up()
    page.get_by_text("undo: move wall").wait_for()
    assert near(server, "wall", 3, -3)
    until(lambda: page.get_by_label("Thing", exact=True).input_value() == "wall")
    page.wait_for_timeout(500)
    x, y = where(server, "wall")
    drag(page, (x + 1.6, y), (x, y + 1.6), HALF)  # by its knob
    until(lambda: abs((body(server, "wall") or [0.0] * 4)[3] - math.pi / 2) < 0.01)
    assert where(server, "wall") == (x, y)
    for _ in range(2):
        press(page, "Undo")
        page.wait_for_timeout(300)
    until(lambda: where(server, "wall") == (2, 0))
    assert server.snapshot()["paused"]


def carry_wall(page: Page, server: Played) -> None:
    """Has the wall in the hand, somewhere else, while the world stands still."""
    press(page, "Pause")
    until(lambda: server.snapshot()["paused"], timeout=40)
    moving(page)
    take(page, (2, 0), HALF)
    carry(page, (2, 0), (3, -3), HALF)
    until(lambda: near(server, "wall", 3, -3), timeout=40)


def test_escape_puts_back_what_is_held_and_the_mouse_holds_nothing_then(
    opened: Callable[[], Page], server: Played
) -> None:
    page = opened()
    carry_wall(page, server)
    page.keyboard.press("Escape")
    until(lambda: where(server, "wall") == (2, 0), timeout=40)
    carry(page, (3, -3), (0, -3), HALF, steps=2)  # the button is still down
    page.mouse.up()
    press(page, "Undo")
    page.get_by_text("there is nothing to undo").first.wait_for(timeout=40_000)
    assert where(server, "wall") == (2, 0)


def test_a_page_that_is_closed_in_the_middle_lets_go(
    opened: Callable[[], Page], server: Played
) -> None:
    page = opened()
    carry_wall(page, server)
    page.close()
    other = opened()
    other.get_by_text("undo: move wall").wait_for(timeout=40_000)
    assert near(server, "wall", 3, -3)
    press(other, "Undo")
    until(lambda: where(server, "wall") == (2, 0), timeout=40)


def test_a_robot_is_dragged_while_the_time_runs_and_no_wall_onto_it(
    opened: Callable[[], Page], server: Played
) -> None:
    page = opened()
    moving(page)
    drag(page, (-2, 0), (-3, 3), HALF)
    until(lambda: near(server, "robot", -3, 3))
    page.get_by_text("undo: move robot").wait_for()
    press(page, "Pause")  # while the time runs, a robot is pushed out of the way
    until(lambda: server.snapshot()["paused"])
    drag(page, (2, 0), where(server, "robot"), HALF)
    page.get_by_text(re.compile("overlaps? body 'robot'")).first.wait_for()
    until(lambda: where(server, "wall") == (2, 0))
    press(page, "Undo")
    until(lambda: near(server, "robot", -2, 0))
    page.keyboard.down("KeyW")  # the keys still drive
    press(page, "Resume")
    until(lambda: where(server, "robot")[0] > -1.5)
    page.keyboard.up("KeyW")


def test_a_thing_is_added_changed_and_deleted(opened: Callable[[], Page], server: Played) -> None:
    page = opened()
    press(page, "Box")
    until(lambda: body(server, "box"))
    row(page, "label").fill("mine")
    row(page, "length (m)").fill("-1")
    press(page, "Apply")
    page.get_by_text("length (m): expected more than 0, got -1").wait_for()
    row(page, "length (m)").fill("2")
    press(page, "Apply")
    page.get_by_text("change box: it applies at once").wait_for()
    expect(row(page, "label")).to_have_value("mine")
    press(page, "Delete box")
    until(lambda: body(server, "box") is None)
    press(page, "Undo")
    until(lambda: body(server, "box"))


def test_a_scene_is_chosen_by_its_picture_and_all_pages_follow(
    opened: Callable[[], Page], server: Played
) -> None:
    page, other = opened(), opened()
    press(page, "Choose a scene")
    card = page.locator(".ai4u.card", has_text="Find the exit of the maze")
    card.wait_for()
    assert card.locator("img").evaluate("image => image.naturalWidth") > 100
    card.scroll_into_view_if_needed()
    box = card.bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + 40, box["y"] + box["height"] / 2)  # on the picture
    until(lambda: body(server, "exit"))
    expect(page.locator(".ai4u.card")).to_have_count(0)
    for each in (page, other):
        expect(each).to_have_title("Maze", timeout=40_000)
    other.locator(".ai4u", has_text="Find the exit of the maze").first.wait_for()
    pose = body(server, "robot")
    assert pose is not None
    other.keyboard.down("KeyD")  # their keys drive the new robot
    until(lambda: (body(server, "robot") or pose)[3] != pose[3])
    other.keyboard.up("KeyD")


ON_TOP = """selector => {
    const {x, y, width, height} = document.querySelector(selector).getBoundingClientRect();
    return Boolean(document.elementFromPoint(x + width / 2, y + height / 2).closest(selector));
}"""


def test_news_lies_under_a_window_that_asks_something(
    opened: Callable[[], Page], server: Played
) -> None:
    page = opened()
    press(page, "Pause")
    page.locator(".ai4u-banner", has_text="Paused").wait_for(timeout=40_000)
    assert page.evaluate(ON_TOP, ".ai4u-banner")
    press(page, "Choose a scene")
    page.get_by_role("dialog").wait_for(timeout=40_000)
    until(lambda: not page.evaluate(ON_TOP, ".ai4u-banner"), timeout=40)
    page.get_by_role("button", name="Stay here").click()
    until(lambda: page.evaluate(ON_TOP, ".ai4u-banner"), timeout=40)


def test_a_thing_comes_where_the_page_looks(opened: Callable[[], Page], server: Played) -> None:
    page = opened()
    page.get_by_role("button", name="Follow", exact=True).click()
    page.wait_for_timeout(700)
    press(page, "Disc")
    until(lambda: body(server, "disc"), timeout=40)
    assert math.dist(where(server, "disc"), (-2, 0)) < 1.7  # the robot is in the middle


def test_a_scene_is_taken_home_and_brought_back(
    opened: Callable[[], Page], server: Played, tmp_path: Path
) -> None:
    page = opened()
    press(page, "Target")
    until(lambda: body(server, "target"))
    with page.expect_download() as download:
        press(page, "Download")
    assert download.value.suggested_filename == "bare.yaml"
    file = tmp_path / "home.yaml"
    download.value.save_as(file)
    press(page, "Delete target")
    until(lambda: body(server, "target") is None)
    upload = page.locator("input[type=file][aria-label='Open a scene file']")
    upload.set_input_files(str(file))
    until(lambda: body(server, "target"))
    wrong = file.with_name("wrong.yaml")
    wrong.write_text(file.read_text().replace("kind: static", "kind: stone", 1))
    upload.set_input_files(str(wrong))
    page.get_by_role("alert").filter(has_text="wrong.yaml, line").first.wait_for()
    assert body(server, "target")


def test_a_scene_is_saved_on_the_server_and_chosen_beside_the_librarys(
    chromium: Browser, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    (tmp_path / "bare.yaml").write_text(SCENE)
    kept = tmp_path / "kept"
    with played(str(tmp_path / "bare.yaml"), "--scenes", str(kept)) as server:
        page = new_page(chromium)
        page.set_default_timeout(60_000)
        page.goto(f"{server.url}?panel=viser")
        ready(page)
        page.get_by_role("tab", name="World").click()
        press(page, "Save")
        window = page.get_by_role("dialog")
        name = window.get_by_role("textbox")
        name.fill("../out")
        press(page, "Save")
        window.get_by_text("expected a name of letters").wait_for()
        name.fill("Mine")
        press(page, "Save")
        page.get_by_role("status").get_by_text("saved as 'Mine'").wait_for()
        assert [file.name for file in kept.iterdir()] == ["Mine.yaml"]
        press(page, "Target")
        until(lambda: body(server, "target"), timeout=40)
        press(page, "Save")
        name.fill("Mine")
        press(page, "Save")
        window.get_by_text("'Mine' is there already").wait_for()
        window.get_by_role("button", name="Cancel").click()
        assert "target" not in (kept / "Mine.yaml").read_text()
        press(page, "Choose a scene")
        window.get_by_role("button", name="Open Mine").click()
        until(lambda: body(server, "target") is None, timeout=40)
        expect(page.get_by_role("dialog")).to_have_count(0)
        page.context.close()
        assert "Traceback" not in "".join(server.told)
    assert sorted(file.name for file in tmp_path.iterdir()) == ["bare.yaml", "kept", "state"]


def test_the_worlds_settings_are_changed_in_a_form_and_come_with_the_reset(
    opened: Callable[[], Page], server: Played
) -> None:
    page = opened()
    page.get_by_role("button", name="Scene's settings").click()
    row(page, "title").fill("On the moon")
    row(page, "gravity (m/s^2)").fill("-1")
    press(page, "Apply")
    page.get_by_role("alert").filter(has_text="expected at least 0, got -1").first.wait_for()
    row(page, "gravity (m/s^2)").fill("1.6")
    press(page, "Apply")
    page.get_by_text("change the scene: it applies at the next reset").wait_for(timeout=40_000)
    expect(page).to_have_title("On the moon", timeout=40_000)
    page.get_by_text("Something waits for the next reset.").first.wait_for(timeout=40_000)
    press(page, "Reset")
    waits = page.locator(".ai4u:visible").get_by_text("Something waits for the next reset.")
    expect(waits).to_have_count(0, timeout=40_000)
    press(page, "Undo")
    expect(row(page, "gravity (m/s^2)")).to_have_value("9.81", timeout=40_000)
    expect(page).to_have_title("A bare robot", timeout=40_000)
