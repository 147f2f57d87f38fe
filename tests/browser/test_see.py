"""The cockpit's instruments: what an agent senses, does and gets, and the time in one's hand."""

import io
import re
from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from PIL import Image
from playwright.sync_api import Browser, Locator, Page, expect

from ai4u_edu import Scene
from ai4u_edu.snapshot import capture_static_scene
from ai4u_edu.snapshot.theme import SPOT_LIT, VOID, Rgb
from ai4u_edu.viewer.scene.arena import camera_bounds
from ai4u_edu.viewer.scene.framing import frame_arena
from tests.chromium import new_page
from tests.playing import Played, played

pytestmark = pytest.mark.browser

PATIENCE = 40_000
"""Milliseconds."""
MIDDLE = "5"
"""A seed with which box_chase_ai4u puts the robot into the middle, looking along +x."""


@pytest.fixture(autouse=True)
def patience() -> Iterator[None]:
    """A page without a graphics card draws a few frames a second, or one if others are at work."""
    expect.set_options(timeout=PATIENCE)
    yield
    expect.set_options(timeout=5_000)


def opened(chromium: Browser, server: Played, *size: int, draws: bool = False) -> Page:
    page = new_page(chromium, *size, draws=draws)
    page.set_default_timeout(PATIENCE)
    page.goto(f"{server.url}?panel=viser")
    page.locator(".ai4u-keycap").first.wait_for()
    return page


@pytest.fixture(scope="module")
def shared() -> Iterator[Played]:
    with played("box_chase_ai4u") as server:
        yield server


@pytest.fixture
def server(shared: Played) -> Played:
    shared.restart(int(MIDDLE))
    return shared


@pytest.fixture
def draws() -> bool:
    return False


@pytest.fixture
def page(server: Played, chromium: Browser, draws: bool) -> Iterator[Page]:
    page = opened(chromium, server, draws=draws)
    page.locator(".ai4u.sense").first.wait_for()
    yield page
    page.context.close()


drawn = pytest.mark.parametrize("draws", [True], ids=["drawn"])
"""Marker of tests that look at the picture of the world."""


def scene(page: Page) -> npt.NDArray[Any]:
    """Return the picture left of the panel, without the keys: (height, width, 3)."""
    clip = {"x": 250, "y": 80, "width": 650, "height": 520}
    return np.asarray(Image.open(io.BytesIO(page.screenshot(clip=clip))).convert("RGB"))  # type: ignore[arg-type]


def share(picture: npt.NDArray[Any], colour: Rgb, slack: int = 25) -> float:
    """Return the share of a picture that has about that colour."""
    close = np.abs(picture.astype(int) - np.array(colour)).max(axis=-1) <= slack
    return float(close.mean())


def until_seen(page: Page, colour: Rgb, least: float, most: float = 1.0, slack: int = 25) -> None:
    for _ in range(100):
        found = share(scene(page), colour, slack)
        if least <= found <= most:
            return
        page.wait_for_timeout(200)
    raise AssertionError(f"{found:.4f} of the scene is {colour}")


def until_changed(page: Page, before: npt.NDArray[Any]) -> None:
    for _ in range(100):
        if np.abs(scene(page).astype(int) - before).mean() > 1:
            return
        page.wait_for_timeout(200)
    raise AssertionError("the picture stays as it was")


def sense(page: Page, name: str) -> Locator:
    """The part of the panel for a sensor of that class."""
    return page.locator(".ai4u.sense", has_text=name)


def press(page: Page, name: str) -> None:
    page.get_by_role("button", name=name, exact=True).click()


def agent(server: Played) -> dict[str, Any]:
    found: dict[str, Any] = server.snapshot()["agents"][0]
    return found


def test_what_the_brain_sees_stands_there_by_name_and_moves(page: Page) -> None:
    last = sense(page, "ActionSensor").locator(".bars")
    names = ["forward", "turn", "jump", "forward jump"]
    expect(last.locator("> span")).to_have_text(names)
    orientation = sense(page, "OrientationSensor").locator(".bars")
    expect(orientation.locator("> span")).to_have_text(["cosine", "distance"])
    before = orientation.locator("> b").first.inner_text()
    page.keyboard.down("KeyA")
    expect(last.locator("> b").nth(1)).to_have_text("-1.00")
    expect(orientation.locator("> b").first).not_to_have_text(before)
    page.keyboard.up("KeyA")
    # four readings of a grid of rays: three older ones and the latest, with its distances
    expect(sense(page, "RayCastingSensor").locator("svg")).to_have_count(5)


@drawn
def test_a_click_on_a_sensor_lights_it_up_in_the_scene(page: Page) -> None:
    until_seen(page, SPOT_LIT, least=0.0, most=0.001, slack=60)
    press(page, "orientation")
    until_seen(page, SPOT_LIT, least=0.002, slack=60)
    expect(page.locator(".ai4u.sense.lit")).to_have_count(2)
    press(page, "orientation")
    until_seen(page, SPOT_LIT, least=0.0, most=0.001, slack=60)


def test_the_ledger_tells_which_term_paid_what_and_when(server: Played, page: Page) -> None:
    press(page, "Decision")
    page.get_by_role("button", name="Resume").first.click()
    page.keyboard.down("KeyW")
    page.locator(".ai4u-banner", has_text="Fell.").wait_for(timeout=20_000)
    page.keyboard.up("KeyW")
    row = page.locator(".ai4u tr", has_text="fall \u22121.00")
    expect(row).to_have_count(1)
    assert re.search(r"decision \d+", row.inner_text())
    assert agent(server)["reward_terms"]["fall"] == -1
    expect(page.locator(".ai4u tr", has_text=re.compile("^fall"))).to_contain_text("-1.00")
    plot = page.locator(".uplot canvas")
    plot.scroll_into_view_if_needed()
    picture = np.asarray(Image.open(io.BytesIO(plot.screenshot())).convert("RGB"))
    assert share(picture, (213, 94, 0)) > 0.001  # the episode's sum


def test_an_action_is_shown_by_its_components(page: Page) -> None:
    action = page.locator(".ai4u", has=page.locator("p", has_text=re.compile("^Action$")))
    page.keyboard.down("KeyS")
    bars = action.locator(".bars")
    expect(bars.locator("> span").first).to_have_text("forward")
    expect(bars.locator("> b").first).to_have_text("-1.00")
    page.keyboard.up("KeyS")


def test_ticks_and_decisions_one_by_one(server: Played, page: Page) -> None:
    strip = page.locator(".ai4u .decision")
    press(page, "Decision")
    expect(strip.locator("span.now")).to_have_text(["sense", "reward"])
    steps, tick = agent(server)["steps"], server.snapshot()["tick"]
    for number in (1, 2):
        press(page, "Tick")
        expect(page.get_by_text(f"Tick {number} of 5")).to_be_visible()
        expect(strip.locator("em.done")).to_have_count(number)
        assert server.snapshot()["tick"] == tick + number
    press(page, "Decision")
    expect(page.get_by_text("Rewarded, and sensed")).to_be_visible()
    assert agent(server)["steps"] == steps + 1
    press(page, "Decision")
    expect(strip.locator("em.done")).to_have_count(5)
    assert server.snapshot()["tick"] == tick + 10
    assert server.snapshot()["paused"]


def choose_speed(page: Page, name: str) -> None:
    page.locator(".mantine-Select-input:visible").first.click()
    page.get_by_role("option", name=name, exact=True).click()


def test_slow_motion_shows_the_ticks_of_a_decision(page: Page) -> None:
    expect(page.get_by_text("Slow down to watch")).to_be_visible()
    choose_speed(page, "0.1x")
    words = page.locator(".ai4u:has(> .decision)")
    seen = set()
    for _ in range(100):
        found = re.search(r"Tick (\d) of 5", words.inner_text())
        seen.add(found[1] if found else "")
        if len(seen) >= 3:
            choose_speed(page, "1x")
            return
        page.wait_for_timeout(50)
    raise AssertionError(f"all that was seen: {seen}")


def test_as_fast_as_it_goes_and_a_seed_that_is_typed_in(server: Played, page: Page) -> None:
    rate = "parseFloat(document.querySelector('.ai4u.status')?.innerText.split('runs at')[1])"
    choose_speed(page, "as fast as it goes")
    page.wait_for_function(f"{rate} > 2")
    choose_speed(page, "1x")
    page.wait_for_function(f"{rate} < 1.5")
    # by now, episodes may have ended by themselves
    seed = page.locator(".mantine-NumberInput-input:visible").first
    expect(seed).to_have_value(str(server.snapshot()["seed"]))
    episode = server.snapshot()["episode"]
    seed.fill("77")
    seed.press("Enter")
    expect(page.locator(".ai4u.status")).to_contain_text(f"Episode {episode + 1}")
    assert server.snapshot()["seed"] == 77


SKY = (150, 182, 212)
FLOOR = (228, 232, 236)


@drawn
def test_the_camera_looks_through_the_eyes_and_turns(page: Page) -> None:
    until_seen(page, SKY, least=0.0, most=0.01)
    press(page, "Eyes")
    until_seen(page, SKY, least=0.15)
    before = scene(page)
    page.keyboard.down("KeyA")  # it looks around
    until_changed(page, before)
    page.keyboard.up("KeyA")
    press(page, "Turn")
    until_seen(page, SKY, least=0.0, most=0.01)
    press(page, "Arena")
    until_seen(page, FLOOR, least=0.5)
    assert share(scene(page), VOID) < 0.5


CONTRAST = """() => {
  const parse = (text) => (text.match(/[\\d.]+/g) ?? []).map(Number);
  const light = ([r, g, b]) => {
    const [x, y, z] = [r, g, b].map((c) => c / 255)
      .map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    return 0.2126 * x + 0.7152 * y + 0.0722 * z;
  };
  const ground = (node) => {
    for (let at = node; at; at = at.parentElement) {
      const [r, g, b, a = 1] = parse(getComputedStyle(at).backgroundColor);
      if (a > 0.9) return [r, g, b];
    }
    return [255, 255, 255];
  };
  const panel = document.querySelector("[data-dock-scroll]");
  const found = [];
  for (const node of panel.querySelectorAll("*")) {
    const text = [...node.childNodes].filter((c) => c.nodeType === 3 && c.data.trim());
    if (!text.length || !node.getClientRects().length || node.closest("style, .uplot")) continue;
    const [a, b] = [light(parse(getComputedStyle(node).color)), light(ground(node))];
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    found.push([ratio, text[0].data.trim()]);
  }
  return found;
}"""


def test_text_has_contrast_in_light_and_dark_and_each_page_chooses(
    page: Page, server: Played, chromium: Browser
) -> None:
    for scheme in ("light", "dark"):
        expect(page.locator("html")).to_have_attribute("data-mantine-color-scheme", scheme)
        page.wait_for_timeout(500)  # colours change gradually
        found = page.evaluate(CONTRAST)
        assert len(found) > 40
        poor = [(round(ratio, 2), text) for ratio, text in found if ratio < 4.5]
        assert poor == []
        page.locator("input[type=checkbox]:visible").first.click()
    page.locator("input[type=checkbox]:visible").first.click()
    expect(page.locator("html")).to_have_attribute("data-mantine-color-scheme", "dark")
    other = opened(chromium, server)
    expect(other.locator("html")).to_have_attribute("data-mantine-color-scheme", "light")
    other.context.close()


def test_the_tabs_have_most_of_the_panel_and_the_time_stays_in_sight(page: Page) -> None:
    upper, lower = (
        page.locator(f"[data-dock-scroll] > :{place}-child").bounding_box()
        for place in ("first", "last")
    )
    assert upper is not None
    assert lower is not None
    assert lower["height"] > 1.5 * upper["height"]
    assert lower["y"] + lower["height"] == pytest.approx(800, abs=4)
    page.locator(".uplot canvas").scroll_into_view_if_needed()
    expect(page.get_by_role("button", name="Decision")).to_be_in_viewport()


def test_on_a_phone_it_is_all_there_in_the_sheet(server: Played, chromium: Browser) -> None:
    page = opened(chromium, server, 390, 844)
    expect(page.get_by_role("button", name="Decision")).not_to_be_in_viewport()  # it folds itself
    page.get_by_text("Box chase").first.click()
    expect(page.get_by_role("button", name="Decision")).to_be_in_viewport()
    page.get_by_text(re.compile("^Agent( ·|$)")).click()
    page.get_by_text("Senses", exact=True).scroll_into_view_if_needed()
    expect(page.get_by_text("OrientationSensor")).to_be_visible()
    page.context.close()


@pytest.fixture
def crowded() -> Iterator[Played]:
    with played("soccer", "--seed", "1") as server:
        yield server


def test_any_agent_is_looked_at_by_list_or_click(crowded: Played, chromium: Browser) -> None:
    page = opened(chromium, crowded)
    chosen = page.locator(".ai4u th > b")
    expect(chosen).to_have_text("blue striker")
    page.locator(".mantine-Select-input:visible").nth(1).click()
    page.get_by_role("option", name="orange keeper").click()
    expect(chosen).to_have_text("orange keeper")
    press(page, "Pause")
    expect(page.get_by_role("button", name="Resume").first).to_be_visible()
    page.mouse.click(*on_screen(page, crowded, "orange_striker"))
    expect(chosen).to_have_text("orange striker")
    page.context.close()


def on_screen(page: Page, server: Played, agent_id: str) -> tuple[float, float]:
    """Return an agent's place on the screen of soccer (pixels), while all of the arena is shown."""
    (x, y, *_), *_ = [
        each["pose"] for each in server.snapshot()["agents"] if each["id"] == agent_id
    ]
    box = page.locator("canvas").first.bounding_box()
    assert box is not None
    static_scene = capture_static_scene(Scene.load("soccer").build())
    shown = frame_arena(camera_bounds(static_scene), box["width"] / box["height"])
    scale = box["height"] / shown.height
    return (
        box["x"] + box["width"] / 2 + (x - shown.x) * scale,
        box["y"] + box["height"] / 2 - (y - shown.y) * scale,
    )
