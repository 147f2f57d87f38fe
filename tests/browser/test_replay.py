"""Going back in time on the page: look, go on from there, race against oneself, take it home."""

import io
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from PIL import Image, ImageChops
from playwright.sync_api import Browser, Page, expect

from ai4u_edu import LocalBrain, ReplayController, Scene
from ai4u_edu.recording import Episode, Recorder, Replay
from tests.browser.served_viser import ready
from tests.chromium import new_page
from tests.playing import Played, played

pytestmark = pytest.mark.browser

MIDDLE = "5"
"""A seed with which box_chase_ai4u puts the robot into the middle, looking along +x."""
CANVAS = (0, 0, 950, 800)


@pytest.fixture
def server() -> Iterator[Played]:
    with played("box_chase_ai4u", "--seed", MIDDLE) as server:
        yield server


@pytest.fixture
def page(server: Played, chromium: Browser) -> Iterator[Page]:
    """A page that shows its past, in which one episode is: the robot drove ahead for a while."""
    page = new_page(chromium)
    page.goto(f"{server.url}?panel=viser")
    ready(page)
    page.keyboard.down("KeyW")
    until(lambda: robot(server)["pose"][0] > 1)
    page.keyboard.up("KeyW")
    page.keyboard.press("KeyR")
    until(lambda: server.snapshot()["episode"] > 1)
    page.get_by_role("tab", name="Past").click()
    page.get_by_role("row", name=MIDDLE).wait_for()
    yield page
    page.context.close()


def robot(server: Played) -> dict[str, Any]:
    found: dict[str, Any] = server.snapshot()["agents"][0]
    return found


def until(met: Callable[[], object], timeout: float = 60.0) -> None:
    deadline = time.monotonic() + timeout
    while not met():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def choose(page: Page, episode: str) -> None:
    page.get_by_label("Episode", exact=True).last.click()
    page.get_by_role("option", name=episode, exact=True).click()
    page.get_by_role("button", name="Step on").wait_for()


def slide(page: Page, share: float) -> None:
    """Presses on the slider's track."""
    box = page.locator(".mantine-Slider-track").last.bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + share * box["width"], box["y"] + box["height"] / 2)


def test_the_slider_shows_the_past_and_the_world_goes_on_from_there(
    server: Played, page: Page
) -> None:
    choose(page, "1")
    assert server.snapshot()["past"] == ""
    slide(page, 0.999)
    until(lambda: server.snapshot()["past"])
    seen = server.snapshot()
    assert seen["past"].startswith("episode 1, ")
    assert (seen["seed"], seen["paused"]) == (int(MIDDLE), True)
    assert robot(server)["pose"][0] > 0  # where it was, and not where it begins now
    banner = page.locator(".ai4u-banner", has_text=f"Past: {seen['past']}")
    expect(banner).to_be_visible()
    tick = seen["tick"]
    page.get_by_role("button", name="Step back").click()
    until(lambda: server.snapshot()["tick"] == tick - 5)
    page.get_by_role("button", name="Step on").click()
    until(lambda: server.snapshot()["tick"] == tick)
    again = server.snapshot()
    assert {**again, "past": ""} == {**seen, "past": ""}
    page.get_by_role("button", name="Back to now").last.click()
    until(lambda: server.snapshot()["past"] == "")
    assert server.snapshot()["seed"] != int(MIDDLE)
    expect(banner).to_have_count(0)
    slide(page, 0.5)
    until(lambda: server.snapshot()["past"])
    there = server.snapshot()
    page.get_by_role("button", name="Continue here").click()
    until(lambda: server.snapshot()["tick"] > there["tick"] and not server.snapshot()["past"])
    assert server.snapshot()["seed"] == int(MIDDLE)
    assert not server.snapshot()["paused"]
    before = robot(server)["pose"][3]
    page.keyboard.down("KeyA")  # whoever drove drives
    until(lambda: robot(server)["pose"][3] > before + 0.2)
    page.keyboard.up("KeyA")
    page.get_by_role("row", name="WASDRBMove").nth(1).wait_for()  # what was left is kept too


def test_a_ghost_goes_where_that_run_went(chromium: Browser, tmp_path: Path) -> None:
    file = run_to_the_upper_right().save(tmp_path / "mine.episode")
    with played("box_chase_ai4u", "--ghost", str(file)) as server:
        page = new_page(chromium, draws=True)
        page.goto(f"{server.url}?panel=viser")
        ready(page)
        assert server.snapshot()["seed"] == int(MIDDLE)
        until(lambda: server.snapshot()["time"] > 4)  # there it stays
        assert robot(server)["pose"][0] == 0
        page.get_by_role("tab", name="Past").click()
        expect(page.get_by_text("Ghost: mine.episode")).to_be_visible()
        page.get_by_role("button", name="Pause", exact=True).click()
        until(lambda: server.snapshot()["paused"])
        page.wait_for_timeout(1500)
        haunted = canvas(page)
        page.get_by_role("button", name="No ghost").click()
        expect(page.get_by_text("Ghost: mine.episode")).to_have_count(0)
        page.wait_for_timeout(1500)
        changed = ImageChops.difference(haunted, canvas(page)).point(lambda v: 255 * (v > 24))
        box = changed.getbbox()
        page.context.close()
    assert box is not None
    left, upper, right, lower = box
    assert 30 < right - left < 150  # a robot, and the word above it; and nothing else
    assert 30 < lower - upper < 150
    assert left > 520  # to the right of the middle, and above it
    assert lower < 360


def run_to_the_upper_right() -> Episode:
    scene = Scene.load("box_chase_ai4u")
    sim = scene.build()
    turns = [{"move": [0.0, -0.5, 0.0, 0.0]}] * 4 + [{"move": [0.5, 0.0, 0.0, 0.0]}] * 15
    sim.agents[0].use_brain(LocalBrain(controller=ReplayController(actions=turns)))
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(int(MIDDLE))
    for _ in turns:
        sim.step()
    assert min(sim.world["robot"].position) > 1
    recorder.finish()
    return recorder.episodes[-1]


def canvas(page: Page) -> Image.Image:
    return Image.open(io.BytesIO(page.screenshot())).convert("L").crop(CANVAS)


def test_an_episode_is_taken_home_and_brought_back(
    server: Played, page: Page, chromium: Browser, tmp_path: Path
) -> None:
    choose(page, "1")
    kept = []
    for what in ("Recording", "Page"):
        with page.expect_download() as download:
            page.get_by_role("link", name=what, exact=True).click()
        kept.append(tmp_path / download.value.suggested_filename)
        download.value.save_as(kept[-1])
    recording, html = kept
    assert recording.name == f"box_chase_ai4u_{MIDDLE}.episode"
    episode = Episode.load(recording)
    assert episode.seed == int(MIDDLE)
    assert Replay(episode).verdict.exact
    page.set_input_files("input[type=file]", str(recording))
    expect(page.get_by_role("row", name=recording.name)).to_be_visible()
    assert "Box chase" in html.read_text()
    page.set_input_files("input[type=file]", str(html))
    expect(page.get_by_text("That is no recording")).to_be_visible()
    alone = chromium.new_page()
    asked: list[str] = []
    alone.on("request", lambda request: asked.append(request.url))
    alone.goto(html.as_uri())
    alone.get_by_role("slider").first.wait_for()
    assert asked == [html.as_uri()]
    alone.context.close()
