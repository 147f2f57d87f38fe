"""The start page leads to missions, to a scene, and to an empty plate."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from ai4u_edu.missions import mission_map
from ai4u_edu.missions.mission import ISLANDS
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.autosave import Autosave
from ai4u_edu.page.editing.scene_store import SceneStore
from ai4u_edu.page.server import room_app
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene
from tests.browser.contrast import low_contrasts
from tests.browser.plain_page import ASKED, WITHOUT_VISER
from tests.browser.schemes import SCHEMES
from tests.chromium import close_page, quick_page
from tests.page.server.rooms import NOWHERE, SharedServer
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.browser

MIN_SIDE_PX, MIN_TOUCH_PX = 28, 40
SIZES = [(1920, 1080, False), (820, 1180, True), (390, 844, True), (844, 390, True)]
MISSIONS = mission_map()


@dataclass
class World:
    """A served world, and its editor."""

    editor: SceneEditor
    url: str

    @property
    def scene(self) -> str:
        return self.editor.state.description.name


@pytest.fixture
def world(tmp_path: Path, shared_server: SharedServer) -> Iterator[World]:
    scene = Scene.load("maze")
    runner = Runner(scene.build(), seed=1)
    editor = SceneEditor(runner, scene)
    editor.recovery.autosave = Autosave(tmp_path, "maze")
    app = room_app(
        runner,
        viser_port=NOWHERE,
        title=lambda: editor.title,
        editor=editor,
        missions=MISSIONS,
    )
    runner.start()
    try:
        shared_server.app = WITHOUT_VISER.app(app)
        yield World(editor, shared_server.url)
    finally:
        runner.stop()
        editor.recovery.autosave.stop()


@pytest.fixture
def page(chromium: Browser, world: World) -> Iterator[Page]:
    page = quick_page(chromium, extra_http_headers=ASKED)
    open_start(page, world)
    yield page
    close_page(page)


def open_start(page: Page, world: World) -> None:
    page.goto(f"{world.url}start#play")
    expect(page.locator("#scenes li")).to_have_count(len(Scene.names()))


def test_a_scene_is_played_by_keyboard_alone(world: World, page: Page) -> None:
    page.goto(f"{world.url}start")
    for name in ("Back to “Maze”", "Missions", "Play"):
        page.keyboard.press("Tab")
        expect(page.get_by_role("link" if "Back" in name else "button", name=name)).to_be_focused()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    expect(page.get_by_role("button", name="Build")).to_be_focused()
    scene = page.get_by_role("button", name="Sumo", exact=True)
    while not scene.evaluate("button => button === document.activeElement"):
        page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    page.wait_for_url(world.url)
    assert world.scene == "sumo"


def test_scenes_to_compare_with_stand_among_the_teachers(page: Page) -> None:
    expect(page.locator("#teachers .ai4u-name")).to_have_text(["Box chase, hard start"])
    expect(page.locator("#library li")).to_have_count(len(Scene.names()) - 1)


def test_build_opens_an_empty_plate(world: World, page: Page) -> None:
    page.get_by_role("button", name="Build").click()
    page.wait_for_url(world.url)
    assert [body.name for body in world.editor.state.description.bodies] == ["robot"]
    # the next page shows what there is to build with, on a phone, too
    kept = "['panel-tab', 'panel-folded-small'].map((key) => localStorage['ai4u-' + key])"
    assert page.evaluate(kept) == ['"build"', "false"]


def test_saved_scenes_are_among_those_to_play(world: World, page: Page, tmp_path: Path) -> None:
    world.editor.scene_store = SceneStore(tmp_path / "saved")
    world.editor.scene_store.save("My sumo", Scene.load("sumo"))
    page.reload()
    page.get_by_role("button", name="My sumo").click()
    page.wait_for_url(world.url)
    assert world.scene == "sumo"


FAR_BELOW = """addEventListener("DOMContentLoaded", () => {
    document.querySelector("#library").style.marginTop = "9000px";
});"""
"""Page script that puts the library where no browser loads ahead."""


def test_pictures_come_when_they_come_into_view(
    chromium: Browser, world: World, tmp_path: Path
) -> None:
    world.editor.scene_store = SceneStore(tmp_path / "saved")
    world.editor.scene_store.save("My sumo", Scene.load("sumo"))
    (tmp_path / "saved" / "Broken.yaml").write_text("bodies: 3\n")
    asked: list[str] = []
    page = quick_page(chromium, extra_http_headers=ASKED)
    page.on("request", lambda each: asked.append(each.url))
    page.add_init_script(FAR_BELOW)
    page.goto(f"{world.url}start#play")
    saved, last = page.locator("#saved img"), page.locator("#library img").last
    expect(saved).to_have_attribute("alt", "My sumo from above")
    until(lambda: is_loaded(saved))
    broken = page.get_by_role("button", name="Broken")
    expect(broken).to_contain_text("can't be read")
    expect(broken.locator(".ai4u-scene-picture svg")).to_be_visible()
    address = last.get_attribute("src") or "?"
    assert not [each for each in asked if each.endswith(address)]
    last.scroll_into_view_if_needed()
    until(lambda: is_loaded(last))
    assert len([each for each in asked if each.endswith(address)]) == 1
    close_page(page)


def is_loaded(picture: Locator) -> bool:
    return bool(picture.evaluate("each => each.complete && each.naturalWidth > 0"))


def test_a_picture_that_can_t_be_loaded_leaves_an_icon(world: World, page: Page) -> None:
    page.route("**/api/scenes/*.png*", lambda route: route.abort())
    page.reload()
    expect(page.locator("#library .ai4u-scene-picture svg").first).to_be_visible()


def test_scenes_have_the_stars_that_programs_have_earned(page: Page) -> None:
    page.evaluate("""localStorage.setItem("ai4u-stars-", '{"maze": 2, "forage": 2}')""")
    page.reload()
    for name, title in (("Maze", "2 of 3 stars"), ("Forage", "2 of 2 stars")):
        scene = page.get_by_role("button", name=name, exact=True)
        expect(scene.get_by_role("img", name=title)).to_be_visible()
    expect(page.get_by_role("img", name="0 of 3 stars")).to_have_count(len(Scene.names()) - 2)


def test_the_map_comes_first_and_shows_progress(world: World, chromium: Browser) -> None:
    page = quick_page(chromium, extra_http_headers=ASKED)
    kept = {"drive-1": {"steps": 4, "stars": 2}, "drive-2": {"steps": 1}}
    page.goto(f"{world.url}start")
    page.evaluate("kept => (localStorage['ai4u-missions-'] = JSON.stringify(kept))", kept)
    page.reload()
    expect(page.get_by_role("heading", name="Scenes")).to_be_hidden()
    expect(page.locator(".ai4u-island h3")).to_contain_text(
        ["Drive1 of 9", "Sense", "Think", "Code", "Build", "Teach", "Compete"]
    )
    expect(page.locator("#map li")).to_have_count(len(MISSIONS().missions))
    expect(page.locator("#map details[open]")).to_have_count(1)
    done = page.get_by_role("button", name="First drive, done, 2 of 3 stars")
    expect(done).to_contain_text("✓ First drive")
    begun = page.get_by_role("button", name="Round the ring, the next one, 0 of 3 stars")
    expect(begun).to_contain_text("1 of 3 steps")
    begun.click()
    page.wait_for_url(world.url)
    assert world.scene == "donut"
    kept_now = page.evaluate("JSON.parse(localStorage['ai4u-mission-'])")
    assert kept_now == {"mission": "drive-2", "step": 1}
    close_page(page)


def test_a_mission_in_the_present_scene_opens_it_as_it_is(world: World, page: Page) -> None:
    world.editor.change_settings({"title": "My maze"}).result(LIMIT_S)
    page.get_by_role("button", name="Missions").click()
    page.locator("summary", has_text="Sense").click()
    page.get_by_role("button", name="Feel the walls").click()
    page.wait_for_url(world.url)
    assert world.editor.title == "My maze"


def test_unsaved_changes_are_asked_about(world: World, page: Page) -> None:
    world.editor.change_settings({"title": "My maze"}).result(LIMIT_S)
    tag = page.get_by_role("button", name="Tag", exact=True)
    tag.click()
    question = page.get_by_role("dialog", name="Open “Tag”?")
    expect(question).to_contain_text("Your scene is kept; find it under Unsaved.")
    question.get_by_role("button", name="Cancel").click()
    expect(question).to_be_hidden()
    assert world.scene == "maze"
    tag.click()
    question.get_by_role("button", name="Open").click()
    page.wait_for_url(world.url)
    assert world.scene == "tag"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_its_controls_can_be_read_in_all_states(
    world: World, chromium: Browser, scheme: Any
) -> None:
    page = quick_page(chromium, extra_http_headers=ASKED, color_scheme=scheme)
    open_start(page, world)
    assert low_contrasts(page, controls=len(Scene.names()) + 3) == []
    page.get_by_role("button", name="Missions").click()
    islands = page.locator("details")
    islands.evaluate_all("all => all.forEach((each) => { each.name = ''; each.open = true; })")
    assert low_contrasts(page, controls=len(MISSIONS().missions) + 4 + len(ISLANDS) - 1) == []
    close_page(page)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_it_fits_each_screen(world: World, chromium: Browser, scheme: Any) -> None:
    for width, height, is_touch in SIZES:
        page = quick_page(chromium, width, height, color_scheme=scheme, has_touch=is_touch)
        open_start(page, world)
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        sides = page.locator("button:visible, a:visible").evaluate_all(
            "all => all.map(each => each.getBoundingClientRect()).map(b => [b.width, b.height])"
        )
        assert len(sides) == len(Scene.names()) + 4
        assert min(map(min, sides)) >= (MIN_TOUCH_PX if is_touch else MIN_SIDE_PX)
        close_page(page)
