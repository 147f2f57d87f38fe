"""The page of ``ai4u-edu play``: driving, time, cameras, agents and colours."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Browser, Page, expect

from ai4u_edu import Scene
from ai4u_edu.page.viewer.scene.arena import camera_bounds
from ai4u_edu.page.viewer.scene.framing import frame_arena
from ai4u_edu.snapshot import capture_static_scene
from ai4u_edu.snapshot.theme import SPOT_LIT
from tests.browser.keys import where
from tests.browser.served_viser import record_texts
from tests.browser.whole import (
    Picture,
    button,
    press,
    share,
    show_details,
    until_drawn,
    whole_page,
)
from tests.chromium import until_on
from tests.playing import Played, played
from tests.waiting import until

pytestmark = pytest.mark.browser

MIDDLE = 5
"""A seed with which box_chase_ai4u puts the robot into the middle, looking along +x."""
SKY = (150, 182, 212)
"""Colour of the sky, which only the robot's own view shows."""


# first, since the page of the others goes on drawing
def test_each_page_looks_at_its_own_agent_and_at_others(chromium: Browser) -> None:
    with (
        played("soccer", "--seed", "1") as server,
        whole_page(chromium, server) as first,
        whole_page(chromium, server, "?agent=orange_keeper") as second,
    ):
        for page, title in ((first, "blue striker"), (second, "orange keeper")):
            expect(chosen(page)).to_contain_text(title)
        first.get_by_label("Robot", exact=True).select_option("blue_keeper")
        expect(button(first, "Drive this one")).to_be_visible()
        press(second, "Pause")
        until(lambda: server.snapshot()["paused"])

        def is_chosen_by_click() -> bool:
            second.mouse.click(*on_screen(second, server, "orange_striker"))
            return "orange striker" in chosen(second).inner_text()

        until_on(second, is_chosen_by_click)  # not before viser has the camera over the arena
        expect(chosen(first)).to_contain_text("blue keeper")


@pytest.fixture(scope="module")
def shared() -> Iterator[Played]:
    with played("box_chase_ai4u") as server:
        yield server


@pytest.fixture
def server(shared: Played) -> Played:
    shared.restart(MIDDLE)
    return shared


@pytest.fixture(scope="module")
def opened(shared: Played, chromium: Browser) -> Iterator[Page]:
    with whole_page(chromium, shared, draws=True) as page:
        show_details(page)
        yield page


@pytest.fixture
def page(opened: Page, server: Played) -> Page:
    assert not server.snapshot()["paused"]
    return opened


def agent(server: Played) -> dict[str, Any]:
    found: dict[str, Any] = server.snapshot()["agents"][0]
    return found


def test_a_key_drives_and_the_readings_change(server: Played, page: Page) -> None:
    sensors = page.locator("article.ai4u-sensor")
    last = sensors.filter(has_text="ActionSensor").locator(".ai4u-bars")
    way = sensors.filter(has_text="OrientationSensor").locator(".ai4u-bars")
    expect(sensors.filter(has_text="RayCastingSensor").locator("img").first).to_be_visible()
    expect(last).to_contain_text("forward")
    before = way.inner_text()
    readings = record_texts(page, "article.ai4u-sensor")
    page.keyboard.down("KeyW")
    until(lambda: where(server, "robot")[0] > 0.3)
    until_on(page, lambda: any("ActionSensor" in text and "1.00" in text for text in readings()))
    page.keyboard.up("KeyW")
    expect(way).not_to_have_text(before)
    expect(page.locator(".ai4u-facts")).not_to_contain_text("0.0 s")


def test_the_time_stands_still_goes_on_by_ticks_and_as_fast_as_wanted(
    server: Played, page: Page
) -> None:
    press(page, "Pause")
    until(lambda: server.snapshot()["paused"])
    tick, steps = server.snapshot()["tick"], agent(server)["steps"]
    press(page, "One tick")
    until(lambda: server.snapshot()["tick"] == tick + 1)
    press(page, "One decision")
    until(lambda: agent(server)["steps"] == steps + 1)
    assert server.snapshot()["paused"]
    press(page, "Resume")
    until(lambda: server.snapshot()["tick"] > tick + 10)
    speed = page.get_by_label("Speed", exact=True)
    for name, time_scale in (("0.25", 0.25), ("1", 1.0)):
        speed.select_option(name)
        until(lambda: server.snapshot()["time_scale"] == time_scale)  # noqa: B023
    seed = page.get_by_label("Seed", exact=True)
    seed.fill("seven")
    seed.press("Enter")
    page.get_by_text('Seed: expected a whole number such as 42, got "seven".').wait_for()
    seed.fill("77")
    seed.press("Enter")
    until(lambda: server.snapshot()["seed"] == 77)
    episode = server.snapshot()["episode"]
    page.keyboard.press("KeyR")  # the keys drive again, and the start stays the same
    until(lambda: server.snapshot()["episode"] > episode)
    assert server.snapshot()["seed"] == 77


def test_the_picture_begins_with_the_resolution_that_suited_this_browser(
    chromium: Browser, server: Played
) -> None:
    kept = [{"name": "ai4u-resolution", "value": "0.6"}]
    origin = {"origin": server.url.rstrip("/"), "localStorage": kept}
    state = {"cookies": [], "origins": [origin]}
    with whole_page(chromium, server, storage_state=state) as page:
        canvas = page.locator("canvas[data-engine]")
        ratio = "canvas => canvas.width / canvas.clientWidth"
        until_on(page, lambda: abs(canvas.evaluate(ratio) - 0.6) < 0.01)
        until_on(page, lambda: "fixedDpr" not in page.url)


def test_the_camera_is_where_it_is_wanted(page: Page) -> None:
    def has_sky(picture: Picture) -> bool:
        return share(picture, SKY) > 0.1

    arena = until_drawn(page, lambda picture: not has_sky(picture))
    press(page, "Through its eyes")
    seen = until_drawn(page, has_sky)
    page.keyboard.down("KeyA")  # it looks around
    until_drawn(page, lambda picture: bool(np.abs(picture.astype(int) - seen).mean() > 1))
    page.keyboard.up("KeyA")
    press(page, "Follow")
    near = until_drawn(page, lambda picture: not has_sky(picture))
    assert np.abs(near.astype(int) - arena).mean() > 1
    press(page, "Arena")
    until_drawn(page, lambda picture: bool(np.abs(picture.astype(int) - near).mean() > 1))
    expect(button(page, "Arena")).to_have_attribute("aria-pressed", "true")


def test_a_click_on_a_sensors_eye_lights_it_up_in_the_scene(page: Page) -> None:
    eye = page.locator("article.ai4u-sensor", has_text="OrientationSensor").get_by_role("button")
    expect(eye).to_have_attribute("aria-pressed", "false")
    until_drawn(page, lambda picture: share(picture, SPOT_LIT, 60) < 0.001)
    for is_on in (True, False):
        eye.click()
        expect(eye).to_have_attribute("aria-pressed", "true" if is_on else "false")
        until_drawn(page, lambda picture: (share(picture, SPOT_LIT, 60) > 0.002) == is_on)  # noqa: B023


def test_light_and_dark(page: Page, server: Played, chromium: Browser) -> None:
    dark = page.get_by_role("switch", name="Dark", exact=True)
    surface = page.locator(".ai4u-panel")
    lightness = (
        "part => Math.max(...getComputedStyle(part).backgroundColor.match(/\\d+/g).slice(0, 3))"
    )
    expect(dark).to_have_attribute("aria-checked", "false")
    until(lambda: surface.evaluate(lightness) > 200)
    dark.click()
    expect(page.locator("html")).to_have_attribute("data-mantine-color-scheme", "dark")
    until(lambda: surface.evaluate(lightness) < 80)
    with whole_page(chromium, server) as other:  # each page chooses
        expect(other.get_by_role("switch", name="Dark")).to_have_attribute("aria-checked", "false")
    dark.click()
    until(lambda: surface.evaluate(lightness) > 200)


def chosen(page: Page) -> Any:
    """Return the option of the robot that the Drive tab shows."""
    return page.locator(".ai4u-tabpanel:visible select option:checked").first


def on_screen(page: Page, server: Played, agent_id: str) -> tuple[float, float]:
    """Return an agent's place on the screen of soccer (pixels), while all of the arena is shown."""
    agents = server.snapshot()["agents"]
    x, y, *_ = next(each["pose"] for each in agents if each["id"] == agent_id)
    box = page.locator("canvas[data-engine]").bounding_box()
    assert box is not None
    bounds = camera_bounds(capture_static_scene(Scene.load("soccer").build()))
    shown = frame_arena(bounds, box["width"] / box["height"])
    scale = box["height"] / shown.height
    return (
        box["x"] + box["width"] / 2 + (x - shown.x) * scale,
        box["y"] + box["height"] / 2 - (y - shown.y) * scale,
    )
