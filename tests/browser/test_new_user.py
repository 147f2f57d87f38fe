"""A new user without help: from a picture in the gallery to a scene of their own."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page

from ai4u_edu import Scene
from tests.browser.keys import body, carry, take, where, whole
from tests.browser.served_viser import ready
from tests.chromium import new_page
from tests.playing import Played, played
from tests.server.rooms import until

pytestmark = pytest.mark.browser

HALF = 5.0
"""Half the side of box_chase_ai4u's plate (m)."""
MIDDLE = "5"
"""A seed with which box_chase_ai4u puts the robot into the middle, looking along +x."""
RAYS = "linear_ray_casting"


@pytest.fixture
def server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Played]:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    with played("donut", "--seed", "1") as server:
        yield server


@pytest.fixture
def page(server: Played, chromium: Browser) -> Iterator[Page]:
    page = new_page(chromium)
    page.goto(f"{server.url}?panel=viser")
    ready(page)
    yield page
    page.context.close()


def press(page: Page, name: str) -> None:
    page.get_by_role("button", name=name, exact=True).last.click()


def tab(page: Page, name: str) -> None:
    page.get_by_role("tab", name=name).click()


def row(page: Page, label: str) -> Locator:
    """The box that stands beside a label of a form."""
    labels = page.locator("label").get_by_text(label, exact=True)
    return labels.first.locator("xpath=ancestor::div[2]").locator("input")


def rays(server: Played) -> list[float]:
    percept: dict[str, Any] = server.snapshot()["agents"][0]["percept"]
    return list(percept.get(RAYS, ()))


def test_a_new_user_with_no_help(page: Page, server: Played, tmp_path: Path) -> None:
    # picks a scene by its picture
    tab(page, "World")
    press(page, "Choose a scene")
    page.locator(".ai4u.card", has_text="Reach the box and touch it").wait_for()
    page.get_by_role("button", name="Open Box chase, as in AI4U").click()
    until(lambda: body(server, "box"))
    page.get_by_text("Reach the box and touch it.").first.wait_for()
    row(page, "Seed").fill(MIDDLE)
    page.keyboard.press("Enter")
    until(lambda: where(server, "robot") == (0, 0))

    # drives
    page.mouse.click(900, 600)  # from the box to the picture
    page.keyboard.down("KeyW")
    until(lambda: where(server, "robot")[0] > 0.2)
    page.keyboard.up("KeyW")
    press(page, "Pause")
    until(lambda: server.snapshot()["paused"])
    assert where(server, "robot")[0] < 1.7  # room for a wall is left

    # puts up a wall, behind
    press(page, "Wall")
    until(lambda: body(server, "wall"))

    # adds a ray sensor with 9 rays, and sees them
    tab(page, "Blocks")
    page.get_by_label("New", exact=True).click()
    page.get_by_role("option", name="LinearRayCastingSensor").first.click()
    press(page, "Add")
    until(lambda: rays(server))
    row(page, "number of rays").fill("9")
    press(page, "Apply")
    until(lambda: len(rays(server)) == 9)
    tab(page, "Agent")
    page.get_by_text(RAYS).first.wait_for()

    # drags the wall in front, and watches the readings change
    tab(page, "World")
    whole(page)
    here = where(server, "wall")
    before = rays(server)
    take(page, here, HALF)
    carry(page, here, (2.5, 0), HALF)
    until(lambda: rays(server)[4] != before[4])  # while it is held
    page.mouse.up()
    page.get_by_text("undo: move wall").last.wait_for()
    assert rays(server)[4] != before[4]

    # scrubs back
    tab(page, "Past")
    page.get_by_label("Episode", exact=True).last.click()
    page.get_by_role("option").last.click()
    page.get_by_role("button", name="Step on").wait_for()
    track = page.locator(".mantine-Slider-track").last.bounding_box()
    assert track is not None
    page.mouse.click(track["x"] + 0.1 * track["width"], track["y"] + track["height"] / 2)
    until(lambda: server.snapshot()["past"])
    press(page, "Back to now")
    until(lambda: not server.snapshot()["past"])

    # saves the scene, and reopens it
    tab(page, "World")
    with page.expect_download() as download:
        press(page, "Download")
    file = tmp_path / download.value.suggested_filename
    download.value.save_as(file)
    scene = Scene.load(file).description
    wall = next(each for each in scene.bodies if each.name == "wall")
    sensors = [each["type"] for each in scene.agents[0]["sensors"]]
    assert sensors[-1] == "LinearRayCastingSensor"
    press(page, "Choose a scene")
    page.get_by_role("button", name="Open Donut").click()
    until(lambda: body(server, "wall") is None)
    with page.expect_file_chooser() as chooser:
        press(page, "Open a scene file")
    chooser.value.set_files(str(file))
    until(lambda: body(server, "wall"))
    assert where(server, "wall") == wall.position
    assert len(rays(server)) == 9
