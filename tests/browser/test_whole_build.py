"""A new user without help: from a card of the start page to a scene of their own."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from ai4u_edu import Scene
from tests.browser.keys import body, carry, take, where, whole
from tests.browser.whole import (
    button,
    card,
    open_tab,
    press,
    recorded_notices,
    unfold,
    whole_page,
)
from tests.chromium import until_on
from tests.playing import Played, played
from tests.waiting import until

pytestmark = pytest.mark.browser

HALF = 5.0
"""Half the side of box_chase_ai4u's plate (m)."""
MIDDLE = 5
"""A seed with which box_chase_ai4u puts the robot into the middle, looking along +x."""
RAYS = "linear_ray_casting"


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Played]:
    folder = tmp_path_factory.mktemp("build")
    with played("box_chase_ai4u", "--scenes", str(folder / "scenes")) as server:
        yield server


@pytest.fixture
def server(shared: Played) -> Played:
    shared.open("box_chase_ai4u")  # another test may have changed it
    shared.restart(MIDDLE)
    return shared


@pytest.fixture(scope="module")
def opened(shared: Played, chromium: Browser) -> Iterator[Page]:
    with whole_page(chromium, shared) as page:
        yield page


@pytest.fixture
def page(opened: Page, server: Played) -> Page:
    assert not server.snapshot()["paused"]
    return opened


def rays(server: Played) -> list[float]:
    percept: dict[str, Any] = server.snapshot()["agents"][0]["percept"]
    return list(percept.get(RAYS, ()))


def put(page: Page, title: str) -> None:
    """Take a thing from the palette, and put it beside the middle of the picture, by keys."""
    entry = page.locator(".ai4u-palette-entry", has_text=title)
    entry.press("Enter")
    expect(page.locator(".ai4u-ghost")).to_be_visible()
    for _ in range(5):
        page.keyboard.press("ArrowUp")
    page.keyboard.press("Enter")
    expect(entry).to_have_attribute("aria-pressed", "false")


def test_a_card_of_the_start_page_opens_its_scene(page: Page, server: Played) -> None:
    page.goto(f"{server.url}start#play")
    page.locator("#scenes").get_by_role("button", name="Donut", exact=True).click()
    page.locator(".ai4u-panel .ai4u-scene-button", has_text="Donut").wait_for()
    press(page, "Donut")
    page.locator("dialog[open] .ai4u-tile", has_text="Box chase, hard start").click()
    until(lambda: body(server, "box"))
    expect(page.locator("dialog[open]")).to_have_count(0)
    page.locator(".ai4u-goal-text", has_text="Reach the box and touch it.").wait_for()


def test_a_sensor_is_added_changed_turned_off_and_deleted(page: Page, server: Played) -> None:
    open_tab(page, "Build")
    press(page, "Add a sensor")
    page.locator("dialog[open] .ai4u-tile", has_text="Ray sensor").first.click()
    until(lambda: rays(server))
    scanner = card(page, "Ray sensor").last
    expect(scanner.locator(".ai4u-card-head").first).to_have_attribute("aria-expanded", "true")
    count = scanner.get_by_label("number of rays", exact=True)
    count.fill("many")
    count.press("Enter")
    row = scanner.locator(".ai4u-field", has_text="number of rays")
    expect(row.locator(".ai4u-problem")).to_contain_text("got 'many'")
    expect(count).to_have_value("many")
    count.fill("9")
    count.press("Enter")
    until(lambda: len(rays(server)) == 9)
    expect(row.locator(".ai4u-problem")).to_be_empty()
    press(page, "Turn off Ray sensor")
    until(lambda: not rays(server))
    press(page, "Turn on Ray sensor")
    until(lambda: len(rays(server)) == 9)
    press(page, "Delete Ray sensor")
    until(lambda: not rays(server))
    expect(scanner).to_have_count(0)
    page.locator(".ai4u-history button").first.click()
    until(lambda: len(rays(server)) == 9)
    page.locator(".ai4u-history button").last.click()
    until(lambda: not rays(server))
    page.keyboard.press("Control+KeyZ")
    until(lambda: len(rays(server)) == 9)


def test_somebody_else_drives(page: Page, server: Played) -> None:
    open_tab(page, "Build")
    driver = page.get_by_label("Driven by", exact=True)
    expect(driver.locator("option")).not_to_have_count(1)
    reason = driver.locator("option[disabled]", has_text="needs a sensor")
    expect(reason.first).to_be_attached()
    here = driver.input_value()
    driver.select_option(label="Trained network")
    expect(page.locator(".ai4u-dock .ai4u-driver")).to_contain_text("to take over")
    driver.select_option(here)
    expect(page.locator(".ai4u-dock .ai4u-driver")).not_to_contain_text("to take over")


def test_a_wall_is_added_dragged_and_put_back(page: Page, server: Played) -> None:
    press(page, "Pause")
    until(lambda: server.snapshot()["paused"])
    open_tab(page, "World")
    put(page, "Wall")
    until(lambda: body(server, "wall"))
    expect(page.get_by_role("switch", name="Move things")).to_have_attribute("aria-checked", "true")
    expect(card(page, "wall").locator(".ai4u-card-body")).to_be_visible()
    whole(page)
    here = where(server, "wall")
    take(page, here, HALF)
    carry(page, here, (here[0], -3), HALF)
    until(lambda: where(server, "wall")[1] < -2)  # while it is held
    page.mouse.up()
    expect(button(page, "Undo move wall")).to_be_enabled()
    there = where(server, "wall")
    page.keyboard.press("Control+KeyZ")
    until(lambda: where(server, "wall") == here)
    page.keyboard.press("Control+KeyY")
    until(lambda: where(server, "wall") == there)


def test_a_scene_is_saved_downloaded_and_opened_again(
    page: Page, server: Played, tmp_path: Path
) -> None:
    open_tab(page, "World")
    put(page, "Target")
    until(lambda: body(server, "target"))
    press(page, "Save")
    notices = recorded_notices(page)
    for name, told in (("../out", "expected a name of letters"), ("Mine", "")):
        page.get_by_label("Name", exact=True).fill(name)
        press(page, "Save")
        if told:
            page.locator("dialog[open]").get_by_text(told).wait_for()
    until_on(page, lambda: any("Mine" in text for text in notices()))
    expect(page.locator("dialog[open]")).to_have_count(0)
    with page.expect_download() as download:
        press(page, "Download")
    file = tmp_path / download.value.suggested_filename
    download.value.save_as(file)
    assert "target" in {each.name for each in Scene.load(file).description.bodies}
    unfold(page, "target").get_by_role("button", name="Delete").click()
    until(lambda: body(server, "target") is None)
    with page.expect_file_chooser() as chooser:
        press(page, "Open a file")
    chooser.value.set_files(str(file))
    until(lambda: body(server, "target"))
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text(file.read_text().replace("kind: static", "kind: stone", 1))
    with page.expect_file_chooser() as chooser:
        press(page, "Open a file")
    chooser.value.set_files(str(wrong))
    until_on(page, lambda: any("wrong.yaml, line" in text for text in notices()))
    assert body(server, "target")
