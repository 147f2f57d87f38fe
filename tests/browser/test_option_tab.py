"""An option brings a tab to a real page; a page without explanations shows the rest."""

import pytest
from playwright.sync_api import Browser, expect

from ai4u_edu import Scene
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.room import serve_world
from ai4u_edu.runtime.runner import Runner
from tests.browser.plain_page import WITHOUT_VISER
from tests.chromium import new_page
from tests.page.server.rooms import PATIENT
from tests.room import greeting
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.browser


def test_a_tab_of_an_option_is_loaded_sends_commands_and_shows_its_part(chromium: Browser) -> None:
    scene = Scene.load("box_chase")
    runner = Runner(scene.build(), seed=1)
    runner.start()
    editor, options = SceneEditor(runner, scene), (greeting.__name__,)
    page, problems = new_page(chromium), list[str]()
    page.on("pageerror", lambda error: problems.append(str(error)))
    with serve_world(runner, editor=editor, options=options, timeouts=PATIENT) as world:
        WITHOUT_VISER.serve(page, world.url)
        page.goto(world.url)
        page.get_by_role("button", name="Details").click()
        drive = page.get_by_role("tabpanel", name="Drive")
        expect(drive.get_by_role("heading", name="Sensors")).to_be_visible()
        page.get_by_role("tab", name="Build").click()
        expect(page.get_by_role("tabpanel", name="Build").get_by_role("article")).not_to_have_count(
            0
        )
        page.get_by_role("tab", name="Greeting").click()
        tab = page.get_by_role("tabpanel", name="Greeting")
        tab.get_by_role("button", name="Say hello").click()
        expect(tab).to_contain_text("The world said: Hello browser")
        page.reload()  # the tab that was open opens again
        expect(tab.get_by_role("button", name="Say hello")).to_be_visible()
        page.context.close()
    runner.stop(LIMIT_S)
    assert problems == []
