"""The top of the panel and the Drive tab, with a fake socket."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, expect

from tests.browser.fake_panel import Json
from tests.browser.panel_page import PanelPage, panel_page, panel_room
from tests.browser.served_viser import record_texts
from tests.page.server.rooms import Room

pytestmark = pytest.mark.browser

CLIPBOARD = ["clipboard-read", "clipboard-write"]


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with panel_room() as room:
        yield room


@pytest.fixture(scope="module")
def warm(chromium: Browser, room: Room) -> Iterator[PanelPage]:
    with panel_page(chromium, room, height=1000, permissions=CLIPBOARD) as page:
        yield page


@pytest.fixture
def desk(warm: PanelPage) -> PanelPage:
    """A page with nothing remembered."""
    warm.reset()
    return warm


def test_goal_time_and_score_are_shown(desk: PanelPage) -> None:
    run = desk.page.get_by_role("region", name="Run")
    expect(run).to_contain_text("Push the box into the goal")
    expect(run).to_contain_text("12.3 s")
    expect(run).to_contain_text("2.75")
    desk.panel.change("run", time_s=125.04, score=-0.004)
    expect(run).to_contain_text("2:05 min")
    expect(run).to_contain_text("Score0.00")
    expect(run.get_by_text("Best")).to_be_hidden()
    desk.page.evaluate(
        "times => localStorage.setItem('ai4u-best-times', JSON.stringify(times))",
        {"box_chase-1": {"keys": 14.5, "program": 9}},
    )
    desk.page.reload()
    desk.wait()
    expect(run).to_contain_text("Best14.5 s")
    desk.panel.change("scene", key="donut-2", title="Donut")  # where nobody has won yet
    expect(run.get_by_text("Best")).to_be_hidden()


def test_texts_that_come_move_no_button(desk: PanelPage) -> None:
    buttons = [desk.button("Pause"), desk.button("Try again"), desk.button("Arena")]
    buttons.append(desk.tab("Drive"))
    stages = [{"title": f"mark {n}", "is_done": False, "is_now": not n} for n in range(8)]
    desk.panel.change("run", stages=stages)
    expect(desk.page.get_by_role("list", name="Stages").get_by_role("listitem")).to_have_count(8)
    before = [each.bounding_box() for each in buttons]
    done = [stage | {"is_done": True, "is_now": False} for stage in stages]
    desk.panel.change("run", stages=done, result="goal", result_text="Reached the goal")
    expect(desk.page.locator(".ai4u-stages > [data-done]")).to_have_count(8)
    assert [each.bounding_box() for each in buttons] == before


def test_the_goal_is_changed_by_a_click(desk: PanelPage) -> None:
    desk.page.get_by_text("Push the box into the goal").click()
    text = desk.page.get_by_label("The task, in a sentence")
    expect(text).to_have_value(re.compile("Push the box into the goal"))
    text.fill(" Catch it! ")
    desk.page.get_by_role("dialog").get_by_role("button", name="Save").click()
    desk.until(lambda: desk.panel.commands("change_settings"))
    assert desk.panel.commands("change_settings") == [{"values": {"goal": "Catch it!"}}]
    expect(desk.page.get_by_role("dialog")).to_have_count(0)
    desk.panel.change("scene", can_edit_goal=False)
    expect(desk.button("Change the goal")).to_be_hidden()


def test_pause_becomes_resume(desk: PanelPage) -> None:
    desk.panel.change("run", is_paused=True)
    desk.button("Resume").click()
    desk.until(lambda: desk.panel.commands("resume") == [{}])
    desk.button("New start").click()
    desk.until(lambda: desk.panel.commands("new_start") == [{}])


def test_the_result_is_announced(desk: PanelPage) -> None:
    desk.panel.change("run", result="goal", result_text="Reached the goal")
    status = desk.page.get_by_role("region", name="Run").get_by_role("status")
    expect(status).to_have_text("Reached the goal")


def test_details_have_speed_and_seed(desk: PanelPage) -> None:
    desk.button("Details").click()
    desk.page.get_by_label("Speed", exact=True).select_option("maximum")
    desk.until(lambda: desk.panel.commands("speed") == [{"speed": "max"}])
    desk.page.get_by_label("Speed", exact=True).select_option("0.5x")
    desk.until(lambda: desk.panel.commands("speed")[1:] == [{"speed": 0.5}])
    seed = desk.page.get_by_label("Seed", exact=True)
    expect(seed).to_have_value("12345678901234567890")
    seed.fill("ten")
    seed.press("Enter")
    expect(desk.page.locator(".ai4u-notice[role=alert]")).to_contain_text("expected a whole number")
    desk.page.get_by_role("switch", name="Lock").click()
    desk.until(lambda: desk.panel.commands("lock_seed") == [{"on": True}])
    assert desk.panel.commands("seed") == []


def test_a_speed_that_is_not_in_the_list_is_shown(desk: PanelPage) -> None:
    desk.button("Details").click()
    desk.panel.change("run", speed=3.0)
    speed = desk.page.get_by_label("Speed", exact=True)
    expect(speed).to_have_value("3")


@pytest.mark.parametrize(
    ("name", "mode"),
    [
        ("Tilted", "tilted"),
        ("Follow", "follow"),
        ("Turn along", "turn"),
        ("Through its eyes", "eyes"),
    ],
)
def test_the_camera_is_chosen(desk: PanelPage, name: str, mode: str) -> None:
    def show_camera(sent: Json) -> Json:
        desk.panel.change("view", camera=sent["mode"])
        return {}

    desk.panel.replies["camera"] = show_camera
    desk.button(name).click()
    desk.until(lambda: desk.panel.commands("camera") == [{"mode": mode}])
    expect(desk.button(name)).to_have_attribute("aria-pressed", "true")
    expect(desk.button("Arena")).to_have_attribute("aria-pressed", "false")


@pytest.mark.parametrize(("width", "height"), [(1366, 768), (390, 844), (360, 740)])
def test_the_cameras_stand_in_one_row(desk: PanelPage, width: int, height: int) -> None:
    desk.page.set_viewport_size({"width": width, "height": height})
    unfold = desk.page.get_by_role("button", name="Open the panel")
    if width < 1000:
        unfold.click()
    cameras = desk.page.get_by_role("group", name="Camera").get_by_role("button")
    expect(cameras).to_have_count(5)
    boxes = cameras.evaluate_all("all => all.map((each) => each.getBoundingClientRect().toJSON())")
    assert len({box["y"] for box in boxes}) == 1
    assert all(0 <= box["x"] <= width - box["width"] for box in boxes)
    desk.page.set_viewport_size({"width": 1280, "height": 1000})


def test_the_trail_and_the_camera_are_shown_as_they_are(desk: PanelPage) -> None:
    trail = desk.page.get_by_role("switch", name="Trail")
    expect(trail).to_be_hidden()
    desk.button("Details").click()
    expect(trail).to_have_attribute("aria-checked", "false")
    desk.panel.change("view", camera="turn", has_trail=True)
    expect(trail).to_have_attribute("aria-checked", "true")
    expect(desk.button("Turn along")).to_have_attribute("aria-pressed", "true")


def test_details_tell_of_the_script_of_other_robots_and_of_the_latest_rewards(
    desk: PanelPage,
) -> None:
    script = {"state": "late", "reason": "no answer for 2 s", "counts": {"decisions": 7}}
    other = {"id": "1", "title": "runner", "colour": "#d55e00", "decision": 9, "score": 1.5}
    paid = {"decision": 40, "terms": [{"term": "time", "amount": -0.5}], "total": -0.5}
    desk.panel.change("agent", script=script, others=[other | {"state": "fell"}], paid=[paid])
    words = desk.page.get_by_text("Script: late · no answer for 2 s · 7 actions carried out")
    reward = desk.page.get_by_text("Decision 40: time \u22120.50")
    expect(words).to_be_hidden()
    expect(reward).to_be_hidden()
    desk.button("Details").click()
    expect(words).to_be_visible()
    expect(reward).to_be_visible()
    desk.page.get_by_text("All robots").click()
    expect(desk.page.get_by_role("row", name="runner")).to_contain_text("91.50fell")


def test_what_a_script_sends_without_effect_is_said_in_simple(desk: PanelPage) -> None:
    script = {"state": "connected", "reason": "", "warning": "", "counts": {"decisions": 7}}
    desk.panel.change("agent", script=script)
    warning = desk.page.get_by_text("no actuator 'mvoe'")
    expect(warning).to_have_count(0)
    text = "agent '0' has no actuator 'mvoe'; did you mean 'move'?"
    desk.panel.change("agent", script=script | {"warning": text, "counts": {"warnings": 3}})
    expect(desk.page.get_by_role("alert").filter(has=warning)).to_be_visible()
    expect(warning).to_have_text(text)
    desk.panel.change("agent", script=script | {"state": "lost", "reason": "it is gone"})
    expect(warning).to_have_count(0)
    expect(desk.page.get_by_text("it is gone", exact=True)).to_be_visible()


def test_dark_is_remembered(desk: PanelPage) -> None:
    dark = desk.page.get_by_role("switch", name="Dark")
    dark.click()
    desk.until(lambda: desk.panel.commands("dark") == [{"on": True}])
    expect(desk.page.locator(".ai4u-panel")).to_have_css("color-scheme", "dark")
    desk.page.reload()
    expect(dark).to_have_attribute("aria-checked", "true")
    expect(desk.page.locator(".ai4u-panel")).to_have_css("color-scheme", "dark")


def win(desk: PanelPage) -> None:
    """Let the page know of a win by keys."""
    desk.page.evaluate(
        "times => localStorage.setItem('ai4u-best-times', JSON.stringify(times))",
        {"maze-1": {"keys": 14.5}},
    )
    desk.page.reload()
    desk.wait()


def test_sensors_are_told_in_words_and_can_be_drawn(desk: PanelPage) -> None:
    sensor = desk.page.locator(".ai4u-sensor", has_text="Direction and distance")
    hint = desk.page.get_by_text("After your first win, you see here what the robot senses.")
    expect(sensor).to_be_hidden()  # a beginner drives first
    expect(hint).to_be_visible()
    win(desk)
    expect(hint).to_be_hidden()
    expect(sensor).to_contain_text("4.20 m")
    expect(sensor.get_by_text("OrientationSensor")).to_be_hidden()
    eye = sensor.get_by_role("button")
    expect(eye).to_have_attribute("aria-pressed", "true")
    eye.click()
    desk.until(lambda: desk.panel.commands("sensor") == [{"key": "box", "on": False}])
    desk.button("Details").click()
    expect(sensor.get_by_text("OrientationSensor")).to_be_visible()
    picture = desk.page.locator(".ai4u-sensor", has_text="Ray picture")
    expect(picture.get_by_role("img")).to_have_attribute(
        "alt", "Ray picture: distance: dark is near"
    )
    expect(picture.get_by_role("button")).to_be_hidden()


def test_new_readings_keep_the_focus(desk: PanelPage) -> None:
    win(desk)
    eye = desk.page.locator(".ai4u-sensor", has_text="Direction").get_by_role("button")
    eye.focus()
    sensors = desk.panel.parts["agent"]["sensors"]
    sensors[0]["values"][1] |= {"value": 3.0, "text": "3.00"}
    desk.panel.change("agent", sensors=list(reversed(sensors)))
    expect(desk.page.locator(".ai4u-sensor").last).to_contain_text("3.00 m")
    expect(eye).to_be_focused()
    desk.panel.change("agent", sensors=sensors[1:])
    expect(desk.page.locator(".ai4u-sensor")).to_have_count(3)


def test_a_bar_begins_at_zero(desk: PanelPage) -> None:
    bar = desk.page.locator(".ai4u-bar-row", has_text="direction").locator(".ai4u-bar > s")
    expect(bar).to_have_attribute("style", "left: 19%; width: 31%;")
    needs = desk.page.locator(".ai4u-bar-row", has_text="water")
    expect(needs).to_contain_text("too low")


def test_rewards_are_a_table(desk: PanelPage) -> None:
    rows = desk.page.locator(".ai4u-table:visible tr")
    expect(rows).to_have_count(0)
    expect(desk.page.locator(".ai4u-curve.ai4u-details-only")).to_be_hidden()
    desk.button("Details").click()
    expect(rows.filter(has_text="closer")).to_contain_text("0.12")
    expect(rows.last).to_contain_text("2.75")
    line = desk.page.locator(".ai4u-details-only polyline")
    expect(line).to_have_attribute("points", re.compile(r"^0\.0,55\.2 .* 280\.0,2\.0$"))


def test_python_is_in_details_or_on_top_when_asked_for(
    desk: PanelPage, chromium: Browser, room: Room
) -> None:
    heading = desk.page.get_by_role("heading", name="Drive it from Python")
    expect(heading).to_be_hidden()
    desk.button("Details").click()
    expect(heading).to_be_visible()
    query = "?panel=2&python"
    with panel_page(chromium, room, query=query, permissions=CLIPBOARD) as asked:
        first = asked.page.locator(".ai4u-tabpanel:visible > :first-child")
        expect(first).to_contain_text("Drive it from Python")
        notices = record_texts(asked.page, ".ai4u-notice[role=status]")
        asked.button("Copy").click()
        asked.until(lambda: any("Copied." in text for text in notices()))
        copied = asked.page.evaluate("navigator.clipboard.readText()")
        assert copied == asked.panel.parts["python"]["lines"]


def test_another_agent_can_be_looked_at_and_driven(desk: PanelPage) -> None:
    agents = desk.panel.parts["scene"]["agents"]
    other = agents[0] | {"id": "1", "title": "Agent 1: other", "driver": "a network"}
    desk.panel.change("scene", agents=[*agents, other])
    desk.page.get_by_label("Robot", exact=True).select_option("Agent 1: other · a network")
    desk.until(lambda: desk.panel.shown["agent"] == "1")
    desk.button("Drive this one").click()
    desk.page.wait_for_url("**/*agent=1*")


PICTURE = (
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAADCAIAAAA7ljmRAAAAFklEQVR4nGNkYPjPAANM"
    "DAwMDAwMAAARAwH/zN5DhAAAAABJRU5ErkJggg=="
)


def test_scenes_are_cards(desk: PanelPage) -> None:
    scene = {"name": "sumo", "title": "Sumo", "goal": "Push it out.", "level": "easy", "minutes": 3}
    scene |= {"picture": PICTURE}
    mine: Json = {"name": "mine", "title": "<b>Mine</b>", "goal": "", "level": "", "picture": ""}
    mine |= {"is_saved": True}
    desk.panel.replies["scenes"] = lambda _: {"items": [scene | {"is_saved": False}, mine]}
    desk.button("Box chase").click()
    dialog = desk.page.get_by_role("dialog", name="Choose a scene")
    expect(dialog.get_by_role("heading", name="My scenes")).to_be_visible()
    sumo = dialog.get_by_role("button", name="Sumo", exact=True)
    expect(sumo).to_have_accessible_description("Push it out. about 3 min")
    expect(sumo.locator("img")).to_have_attribute("alt", "Sumo from above")
    expect(dialog.locator(".ai4u-scene-picture svg")).to_have_count(1)
    dialog.get_by_role("button", name="<b>Mine</b>").click()
    desk.until(lambda: desk.panel.commands("open_scene") == [{"name": "mine", "is_saved": True}])
    expect(dialog).to_have_count(0)


def test_a_training_is_followed(desk: PanelPage) -> None:
    section = desk.page.locator("details", has_text="Training").first
    expect(section).to_be_hidden()
    training = {"text": "Learned from 500 decisions.", "is_over": False, "share": 0.25}
    points = [[100, 1.0, 0.0], [500, 3.0, 0.5]]
    desk.panel.send({"type": "part", "name": "training", **training, "points": points})
    expect(section).to_contain_text("Learned from 500 decisions.")
    expect(section.get_by_role("img")).to_be_visible()
    expect(section).to_contain_text("Mean reward 3.00, reaches the goal in 50% of episodes")


WHY: Json = {
    "type": "part",
    "name": "why",
    "agent": "0",
    "problem": "",
    "sentence": "It turns left because ray 4 sees the box. Without it, it would go straight.",
    "baseline": "the middle of its range",
    "limits": "Two slots that say the same can both seem unimportant.",
    "components": ["forward", "turn"],
    "slots": [
        {"key": "box", "name": "box: direction", "sees": "", "share": 0.0, "shares": [0, 0]},
        {"key": "box", "name": "box: distance", "sees": "", "share": 0.2, "shares": [-0.2, 0]},
        *(
            {
                "key": "rays",
                "name": f"ray {ray}",
                "sees": "box",
                "share": 0.4 * (ray == 4),
                "shares": [0, -0.4 * (ray == 4)],
            }
            for ray in range(1, 7)
        ),
    ],
}
WHY["top"] = [WHY["slots"][5], WHY["slots"][1]]


def test_because_of_what(desk: PanelPage) -> None:
    desk.panel.let_network_drive()
    section = desk.page.locator(".ai4u-why-sentence")
    expect(section).to_be_hidden()
    desk.page.get_by_role("switch", name="Show why").click()
    desk.until(lambda: desk.panel.commands("why") == [{"on": True}])
    desk.panel.send(WHY)
    expect(section).to_have_text(WHY["sentence"])
    items = desk.page.get_by_role("list", name="Numbers that matter most")
    expect(items.get_by_role("listitem")).to_have_text(
        [re.compile("^ray 4 . the boxturn .40 %$"), re.compile("^box: distanceforward .20 %$")]
    )
    expect(desk.page.get_by_text("We replace one sensor number at a time")).to_be_visible()
    desk.page.get_by_text("How is this computed?").locator("visible=true").click()
    expect(desk.page.get_by_text(re.compile("^Compared with the middle"))).to_be_visible()
    # bars beside the numbers of a sensor, and cells under the strips of another one
    rows = desk.page.locator(".ai4u-bar-row[data-why]")
    expect(rows).to_have_count(2)
    shown = [row.evaluate("e => e.style.getPropertyValue('--why')") for row in rows.all()]
    assert shown == ["0%", "50%"]
    cells = desk.page.locator(".ai4u-why-weights:visible > i")
    expect(cells).to_have_count(6)
    expect(cells.nth(3)).to_have_attribute("title", "ray 4: moves the action by 40 %")
    desk.panel.send(WHY | {"problem": "A person drives.", "sentence": "", "slots": [], "top": []})
    expect(section).to_have_text("A person drives.")
    expect(rows).to_have_count(0)
    desk.page.get_by_role("switch", name="Show why").click()
    desk.until(lambda: desk.panel.commands("why") == [{"on": True}, {"on": False}])
    expect(section).to_be_hidden()
    assert desk.problems == []


def test_because_of_what_is_asked_for_again_after_a_break(desk: PanelPage) -> None:
    desk.panel.let_network_drive()
    desk.page.get_by_role("switch", name="Show why").click()
    desk.until(lambda: len(desk.panel.commands("why")) == 1)
    desk.panel.drop()
    desk.until(lambda: len(desk.panel.commands("why")) == 2)
    assert desk.panel.commands("why")[1] == {"on": True}


def test_what_if(desk: PanelPage) -> None:
    desk.panel.let_network_drive()

    def reply(message: Json) -> Json:
        then = message["changes"][0]["value"] if message["changes"] else 0.1
        dials = [
            {"key": "rays", "index": 2, "name": "ray 2: code", "value": 0.5, "low": 0, "high": 1},
            {"key": "box", "index": 0, "name": "direction", "value": 0.1, "low": -1, "high": 1},
        ]
        turn = {"name": "turn", "low": -1, "high": 1, "has_effect": True, "now": 0.1, "then": then}
        return {"dials": dials, "action": [turn]}

    desk.panel.replies["what_if"] = reply
    desk.page.get_by_role("switch", name="Show why").click()
    desk.until(lambda: desk.panel.commands("why"))
    desk.panel.send(WHY)
    hint = desk.page.get_by_text("Press Pause, then try other numbers.")
    expect(hint).to_be_visible()
    desk.panel.change("run", is_paused=True)
    slot = desk.page.get_by_label("Try another number")
    expect(slot).to_be_visible()
    expect(hint).to_be_hidden()
    slot.select_option("direction")
    slider = desk.page.get_by_role("slider", name="direction")
    expect(slider).to_have_value("0.1")
    slider.fill("-0.5")
    row = desk.page.locator(".ai4u-what-if .ai4u-bar-row")
    expect(row).to_have_text(re.compile("^turn0.10 . .0.50$"))
    assert desk.panel.commands("what_if")[-1] == {
        "changes": [{"key": "box", "index": 0, "value": -0.5}]
    }
    desk.button("As it is").click()
    expect(row).to_have_text("turn0.10")
    expect(slider).to_have_value("0.1")
    desk.panel.change("run", is_paused=False)
    expect(slot).to_be_hidden()
    assert desk.problems == []
