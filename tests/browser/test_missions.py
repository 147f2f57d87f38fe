"""The card of a mission: what it says, what it lights, and the way on."""

import json
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from ai4u_edu.missions.mission import CONTROLS, library_missions
from tests.browser.code_page import set_limits
from tests.browser.panel_page import PanelPage, panel_page, panel_room
from tests.browser.plain_page import WITHOUT_VISER
from tests.chromium import new_page
from tests.page.panel import rooms
from tests.page.server.rooms import Room
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.browser

PART: dict[str, Any] = {
    "type": "part",
    "name": "mission",
    "mission": "drive-1",
    "title": "First drive",
    "island": "Drive",
    "scene": "box_chase",
    "scene_title": "Box chase",
    "is_here": True,
    "step": 1,
    "steps": 3,
    "say": "Press *New start* <b>now</b>.",
    "light": ["New start"],
    "is_done": False,
    "done": "",
    "words": "1 of 2 times",
    "hint": "",
    "driver": "",
    "question": None,
    "exercise": None,
    "stars": [{"text": "Do the mission.", "is_earned": False}],
    "next": "drive-2",
    "next_title": "Round the ring",
}
OPEN = 'localStorage["ai4u-mission-"] = \'{"mission": "drive-1", "step": 1}\''


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with panel_room() as room:
        yield room


@pytest.fixture(scope="module")
def warm(chromium: Browser, room: Room) -> Iterator[PanelPage]:
    with panel_page(chromium, room) as page:
        yield page


@pytest.fixture
def desk(warm: PanelPage) -> PanelPage:
    """A page with the second step of a mission."""
    warm.reset()
    warm.page.evaluate(OPEN)
    warm.panel.parts["mission"] = dict(PART)
    warm.panel.received.clear()
    warm.page.reload()
    warm.wait()
    warm.until(lambda: warm.panel.commands("mission_open"))
    return warm


def card(desk: PanelPage) -> Locator:
    return desk.page.get_by_role("region", name="Mission")


def kept(desk: PanelPage, key: str) -> Any:
    text = desk.page.evaluate("key => localStorage.getItem(`ai4u-${key}-`)", key)
    return None if text is None else json.loads(text)


def test_a_reload_goes_on_with_the_step(desk: PanelPage) -> None:
    assert desk.panel.commands("mission_open") == [{"mission": "drive-1", "step": 1}]
    desk.until(lambda: desk.panel.commands("mission_see"))
    assert desk.panel.commands("mission_see")[-1] == {
        "tab": "drive",
        "way": "",
        "is_watching": False,
    }
    expect(card(desk)).to_contain_text("First drive")
    expect(card(desk)).to_contain_text("Step 2 of 3")
    expect(card(desk)).to_contain_text("1 of 2 times")


def test_a_sentence_is_text_with_bold_words_and_its_control_is_lit(desk: PanelPage) -> None:
    say = desk.page.locator(".ai4u-mission-say")
    expect(say).to_have_text("Press New start <b>now</b>.")
    expect(say.locator("b")).to_have_text(["New start"])
    lit = desk.page.locator("[data-ai4u-lit]")
    expect(lit).to_have_text(["New start"])
    desk.panel.change("mission", is_done=True, done="It began.")
    expect(lit).to_have_count(0)


def test_the_way_to_a_control_is_lit_first(desk: PanelPage) -> None:
    lit = desk.page.locator("[data-ai4u-lit]")
    desk.panel.change("mission", light=["Details", "Past", "Pause"])
    expect(lit).to_have_text(["Details"])
    desk.button("Details").click()
    expect(lit).to_have_text(["Past"])
    desk.tab("Past").click()
    expect(lit).to_have_text(["Pause"])


def test_a_light_stays_in_sight_when_the_card_grows_above_it(desk: PanelPage) -> None:
    desk.button("Details").click()
    desk.tab("Build").click()
    desk.panel.change("mission", light=["Add a reward"])
    lit = desk.page.locator("[data-ai4u-lit]")
    expect(lit).to_have_accessible_name("Add a reward")
    expect(lit).to_be_in_viewport(ratio=1)
    desk.panel.change("mission", hint="It is still not what the goal asks for. " * 8)
    expect(card(desk).get_by_role("status")).to_contain_text("still not")
    expect(lit).to_be_in_viewport(ratio=1)


def test_a_step_that_is_done_says_so_and_is_kept(desk: PanelPage) -> None:
    status = card(desk).get_by_role("status")
    desk.panel.change("mission", hint="That was the *same* start.")
    expect(status).to_have_text("That was the same start.")
    desk.panel.change("mission", is_done=True, done="It began.", words="", hint="")
    expect(status).to_have_text("✓ It began.")
    desk.until(lambda: kept(desk, "missions") == {"drive-1": {"steps": 2, "stars": 0}})
    card(desk).get_by_role("button", name="Next").click()
    desk.until(
        lambda: desk.panel.commands("mission_open")[1:] == [{"mission": "drive-1", "step": 2}]
    )
    assert kept(desk, "mission") == {"mission": "drive-1", "step": 2}


def test_a_step_can_be_left_out_and_is_not_counted(desk: PanelPage) -> None:
    card(desk).get_by_role("button", name="Next").click()
    desk.until(
        lambda: desk.panel.commands("mission_open")[1:] == [{"mission": "drive-1", "step": 2}]
    )
    assert kept(desk, "missions") is None


def test_after_the_last_step_come_stars_and_the_next_mission(desk: PanelPage) -> None:
    stars = [
        {"text": "Do the mission.", "is_earned": True},
        {"text": "*Fast*.", "is_earned": False},
    ]
    desk.panel.change("mission", step=2, is_done=True, done="Well done.", stars=stars)
    expect(card(desk).get_by_role("listitem")).to_have_text(["★Do the mission.", "☆Fast."])
    expect(card(desk).get_by_role("listitem").locator("b")).to_have_text(["Fast"])
    desk.until(lambda: kept(desk, "missions") == {"drive-1": {"steps": 3, "stars": 1}})
    card(desk).get_by_role("button", name="Next: Round the ring").click()
    desk.until(
        lambda: desk.panel.commands("mission_open")[1:] == [{"mission": "drive-2", "step": 0}]
    )


def test_show_everything_puts_the_card_away(desk: PanelPage) -> None:
    card(desk).get_by_role("button", name="Show everything").press("Enter")
    pill = card(desk).get_by_role("button", name="Mission: First drive (2 of 3)")
    expect(pill).to_be_focused()
    expect(desk.page.locator(".ai4u-mission-say")).to_be_hidden()
    expect(desk.page.locator("[data-ai4u-lit]")).to_have_count(0)
    desk.page.keyboard.press("Enter")
    expect(desk.page.locator(".ai4u-mission-say")).to_be_visible()


def test_a_mission_can_be_left(desk: PanelPage) -> None:
    card(desk).get_by_role("button", name="Show everything").press("Enter")
    card(desk).get_by_role("button", name="Leave the mission").press("Enter")
    desk.until(lambda: desk.panel.commands("mission_close"))
    desk.panel.change("mission", mission="")
    expect(desk.page.get_by_role("link", name="Missions: learn step by step")).to_be_focused()
    assert kept(desk, "mission") is None


def test_another_scene_is_told_with_a_button(desk: PanelPage) -> None:
    desk.panel.change("mission", is_here=False)
    expect(card(desk).get_by_role("status")).to_have_text(
        "This mission is in the scene “Box chase”. What you have here is kept."
    )
    expect(card(desk).get_by_role("button", name="Open Box chase")).to_be_visible()
    expect(desk.page.locator("[data-ai4u-lit]")).to_have_count(0)


def test_questions_are_answered_with_numbers_or_choices(desk: PanelPage) -> None:
    desk.panel.change("mission", say="How far?", question={"text": "Metres", "options": []})
    card(desk).get_by_label("Metres").fill("0.5")
    desk.page.keyboard.press("Enter")
    desk.until(lambda: desk.panel.commands("mission_answer") == [{"answer": "0.5"}])
    desk.panel.change("mission", say="Which?", question={"text": "?", "options": ["left", "right"]})
    card(desk).get_by_role("button", name="right").click()
    desk.until(lambda: desk.panel.commands("mission_answer")[1:] == [{"answer": "right"}])


def test_what_a_judge_says_has_code_and_bold_words(desk: PanelPage) -> None:
    text = "Pay for *getting* nearer: `reward`."
    desk.panel.replies["mission_judge"] = lambda _: {"passed": False, "text": text, "hint": ""}
    desk.panel.change("mission", exercise={"id": "09.2", "function": "", "text": ""})
    card(desk).get_by_role("button", name="Check").click()
    said = card(desk).locator(".ai4u-mission-exercise .ai4u-mission-problem")
    expect(said).to_have_text("Pay for getting nearer: reward.")
    expect(said.locator("b")).to_have_text(["getting"])
    expect(said.locator("code")).to_have_text(["reward"])


def test_the_open_tab_and_a_folded_panel_are_told(desk: PanelPage) -> None:
    desk.tab("Past").click()
    desk.until(lambda: desk.panel.commands("mission_see")[-1]["tab"] == "past")
    desk.button("Fold the panel").click()
    desk.until(lambda: desk.panel.commands("mission_see")[-1]["tab"] == "")
    expect(card(desk)).to_contain_text("Step 2 of 3")


def test_after_a_restart_the_room_is_told_again(desk: PanelPage) -> None:
    desk.panel.drop()
    desk.until(lambda: len(desk.panel.commands("mission_open")) == 2)


def test_a_mission_that_is_gone_is_forgotten(desk: PanelPage) -> None:
    desk.panel.replies["mission_open"] = lambda _: {
        "type": "failed",
        "text": "none",
        "problems": [],
    }
    desk.panel.parts["mission"] = {**PART, "mission": ""}
    desk.page.reload()
    desk.wait()
    invitation = desk.page.get_by_role("link", name="Missions: learn step by step")
    expect(invitation).to_be_visible()
    expect(invitation).to_have_attribute("href", "./start#missions")
    desk.until(lambda: kept(desk, "mission") is None)


@pytest.mark.parametrize(("width", "height"), [(390, 844), (820, 1180), (844, 390)])
def test_the_card_fits_and_covers_no_key(
    chromium: Browser, room: Room, width: int, height: int
) -> None:
    with panel_page(chromium, room, width=width, height=height, has_touch=True) as page:
        page.page.evaluate(OPEN)
        page.panel.parts["mission"] = {**PART, "hint": "It fell. " * 12}
        page.page.reload()
        page.wait()
        box = card(page).bounding_box()
        assert box is not None
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= width
        next_box = card(page).get_by_role("button", name="Next").bounding_box()
        assert next_box is not None
        keys = page.page.locator(".ai4u-dpad").bounding_box()
        assert keys is not None
        is_beside = box["x"] >= keys["x"] + keys["width"]
        assert is_beside or box["y"] + box["height"] <= keys["y"]


@pytest.mark.parametrize(
    ("width", "height", "is_folded"),
    [
        (1024, 768, True),
        (900, 700, True),
        (667, 375, True),
        (820, 1180, True),
        (820, 1180, False),
        (390, 844, True),
        (390, 844, False),
    ],
)
def test_a_banner_lies_beside_the_card(
    chromium: Browser, room: Room, width: int, height: int, is_folded: bool
) -> None:
    still = {"reduced_motion": "reduce"}
    with panel_page(chromium, room, width=width, height=height, **still) as page:
        page.page.evaluate(OPEN)
        page.panel.parts["mission"] = {**PART, "light": ["Keys"]}
        page.page.reload()
        page.wait()
        fold = page.button("Fold the panel" if is_folded else "Open the panel")
        if fold.count():
            fold.click()
        room.runner.pause().result(LIMIT_S)
        banner = page.page.locator(".ai4u-banner")
        expect(banner).to_contain_text("Paused")
        banner.locator("p").evaluate("p => p.append('. Time is up, press R to try again')")
        boxes = [each.bounding_box() for each in (card(page), banner)]
        assert boxes[0] is not None
        assert boxes[1] is not None
        of_card, of_banner = boxes[0], boxes[1]
        is_left = of_banner["x"] + of_banner["width"] <= of_card["x"]
        assert (
            is_left
            or of_card["y"] + of_card["height"] <= of_banner["y"]
            or (of_banner["y"] + of_banner["height"] <= of_card["y"])
        )
        room.runner.resume().result(LIMIT_S)


def test_an_open_panel_ends_below_the_card_on_a_phone_in_a_class(
    chromium: Browser, room: Room
) -> None:
    with panel_page(chromium, room, width=390, height=844, has_touch=True) as page:
        page.page.evaluate(OPEN)
        page.panel.parts["mission"] = {**PART, "hint": "It fell. " * 25}
        page.page.reload()
        page.wait()
        expect(page.button("New start")).to_be_visible()  # it is lit, so the panel has opened
        page.page.evaluate(
            "document.documentElement.style.setProperty('--ai4u-class-height', '49px')"
        )
        head = page.page.locator(".ai4u-panel-head")

        def is_below() -> bool:
            of_card, of_panel = card(page).bounding_box(), head.bounding_box()
            assert of_card is not None
            assert of_panel is not None
            below = of_card["y"] + of_card["height"]
            return of_card["y"] >= 49 and of_panel["y"] >= below

        page.until(is_below)  # the panel follows the card a frame later


def test_a_person_does_the_first_steps_by_keys(chromium: Browser) -> None:
    page, problems = new_page(chromium), list[str]()
    page.on("pageerror", lambda error: problems.append(str(error)))
    with rooms.panel_room() as served:
        WITHOUT_VISER.serve(page, served.url)
        page.add_init_script(
            'localStorage["ai4u-mission-"] ??= \'{"mission": "drive-1", "step": 0}\''
        )
        page.goto(served.url)
        expect(page.get_by_text("Step 1 of 4")).to_be_visible()
        served.runner.resume().result(LIMIT_S)
        press_until_done(page, "KeyW")
        page.get_by_role("button", name="Next", exact=True).click()
        expect(page.get_by_text("Step 2 of 4")).to_be_visible()
        press_until_done(page, "KeyA")
        page.reload()
        expect(page.get_by_text("Step 2 of 4")).to_be_visible()
        progress = page.evaluate("JSON.parse(localStorage['ai4u-missions-'])")
        assert progress == {"drive-1": {"steps": 2, "stars": 0}}
        page.context.close()
    assert problems == []


def test_a_function_is_called_in_the_page_and_judged_by_the_room(chromium: Browser) -> None:
    page, problems = new_page(chromium), list[str]()
    page.on("pageerror", lambda error: problems.append(str(error)))
    with rooms.panel_room() as served:
        WITHOUT_VISER.serve(page, served.url)
        page.add_init_script(
            'localStorage["ai4u-mission-"] ??= \'{"mission": "code-9", "step": 0}\''
        )
        page.goto(served.url)
        set_limits(page, programS=1)
        editor = page.get_by_role("textbox", name="Your function")
        expect(editor).to_contain_text("def speed_for(distance, seconds):")
        check = page.get_by_role("button", name="Check", exact=True)
        problem = page.locator(".ai4u-mission-exercise .ai4u-mission-problem")
        check.click()
        expect(problem).to_contain_text("For 6 m in 3 s your function says 0 m/s")
        for line, text in (
            ("return distance / second", "Line 2: nothing is called 'second'"),
            ("return seconds / distance", "that is upside down"),
            ("while True: pass", "Line 2: Your code has been running for"),
        ):
            write(page, editor, f"def speed_for(distance, seconds):\n    {line}")
            check.click()
            expect(problem).to_contain_text(text)
        write(page, editor, "def speed_for(distance, seconds):\n    return distance / seconds")
        check.click()
        expect(page.locator(".ai4u-mission-done")).to_contain_text("✓ A function gets numbers in")
        expect(problem).to_be_hidden()
        page.reload()
        expect(editor).to_contain_text("return distance / seconds")
        page.context.close()
    assert problems == []


def write(page: Page, editor: Locator, program: str) -> None:
    editor.click()
    page.keyboard.press("ControlOrMeta+a")
    page.keyboard.insert_text(program)


def press_until_done(page: Page, key: str) -> None:
    page.keyboard.down(key)
    expect(page.locator(".ai4u-mission-done")).to_contain_text("✓")
    page.keyboard.up(key)


LIGHTS = sorted(
    {
        name
        for each in library_missions().by_name.values()
        for step in each.steps
        for name in step.light
    }
)


def test_only_controls_that_exist_are_lit(chromium: Browser) -> None:
    """Find each name that a mission may light in one of the tabs."""
    found: set[str] = set()
    page = new_page(chromium)
    script = """names => import("./web/missions/lights.js").then(({ Lights }) => {
      const lights = new Lights(document.createElement("p"));
      return names.filter((name) => {
        lights.show([name]);
        const isLit = document.querySelector("[data-ai4u-lit]") !== null;
        lights.show([]);
        return isLit;
      });
    })"""
    with rooms.panel_room("draw_figure") as served:  # its pen has the space bar
        WITHOUT_VISER.serve(page, served.url)
        page.goto(served.url)
        served.runner.resume().result(LIMIT_S)
        expect(page.get_by_role("button", name="Pause", exact=True)).to_be_visible()
        page.get_by_role("button", name="Details").click()
        for tab in ("Drive", "Build", "World", "Code"):
            page.get_by_role("tab", name=tab, exact=True).click()
            expect(page.locator(".ai4u-tabpanel:visible button:visible").first).to_be_visible()
            if tab in ("Build", "World"):
                expect(page.locator(".ai4u-palette-entry:visible").first).to_be_visible()
            if tab == "Build":
                page.locator(".ai4u-tabpanel:visible .ai4u-card-head").first.click()
                more = page.locator(".ai4u-tabpanel:visible summary").filter(has_text="More")
                expect(more.first).to_be_visible()
            found |= set(page.evaluate(script, list(CONTROLS)))
        page.context.close()
    # the tab Teach needs a folder for a person's work
    in_teach = {"Teach", "Learn", "Practise", "Networks", "Compare", "Let it drive"}
    assert set(CONTROLS) - found <= in_teach
    assert set(LIGHTS) <= set(CONTROLS)
