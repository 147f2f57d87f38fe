"""The tab "Code" with a fake Python and a fake world: editor, buttons, output, mistakes."""

import hashlib
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from ai4u_edu.page.server.web_files import web_folder
from tests.browser.code_tab import PROGRAM, CodePage
from tests.browser.fake_code import serve_fakes
from tests.browser.fake_panel import PARTS
from tests.browser.panel_page import panel_page, panel_room
from tests.browser.schemes import SCHEMES
from tests.browser.served_viser import recorded_holds
from tests.browser.tab_page import TabPage
from tests.browser.test_panel_accessibility import findings
from tests.chromium import new_page

pytestmark = pytest.mark.browser


@pytest.fixture
def tab(chromium: Browser) -> Iterator[CodePage]:
    with CodePage.opened(chromium) as tab:
        yield tab


def test_it_begins_with_a_program_that_drives_in_a_circle(tab: CodePage) -> None:
    assert tab.text == (
        "def decide(percept):\n    forward = 0.4\n    turn = 0.3\n"
        '    return {"move": [forward, turn, 0]}\n'
    )
    expect(tab.state).to_contain_text("Ready")
    names = tab.page.locator(".ai4u-code-names > li")
    expect(names.filter(has_text='percept["box"]')).to_contain_text("direction, distance")
    expect(names.filter(has_text='"move"')).to_contain_text(
        "forward -1 to 1, turn -1 to 1, always 0"
    )


def test_run_senses_decides_and_acts_until_the_episode_is_over(tab: CodePage) -> None:
    tab.write(PROGRAM)
    tab.sense()
    tab.press("Run")
    expect(tab.state).to_contain_text("Runs")
    tab.page.wait_for_function("fake.calls.filter((each) => each[0] === 'act').length === 1")
    ((source, facts),) = tab.calls("load")
    assert source == PROGRAM
    assert facts == {
        "readings": [{"key": "box", "dtype": "<f4"}, {"key": "rays", "dtype": "<f4"}],
        "outputs": {"move": [[-1, -1], [1, 1]]},
    }
    assert tab.calls("connect") == [[{"agent": "0", "mode": "realtime"}]]
    assert tab.calls("decide") == [[{"box": [0.5, 2]}, 1]]
    assert tab.calls("act") == [[{"move": [1, 0]}]]
    expect(tab.page.locator(".ai4u-code-ran-line")).to_have_count(2)
    expect(tab.page.get_by_role("log")).to_have_text("1decision 1")
    expect(tab.page.locator(".ai4u-code-variables")).to_have_text("near0.94")
    tab.sense(1, terminated=True, terms={"touch": 100})
    expect(tab.state).to_contain_text("Goal reached! Your program decided 1 time.")
    assert tab.page.evaluate("fake.closed") == 1
    expect(tab.page.get_by_role("button", name="Stop")).to_be_disabled()


def test_a_program_waits_at_a_breakpoint_and_shows_its_variables(tab: CodePage) -> None:
    tab.write(PROGRAM)
    tab.page.evaluate(
        """() => (fake.decide = (_, number, stops) => ({
          ok: true, values: { move: [1, 0] }, printed: "", lines: [2, 3], variables: { near: "3" },
          ...(stops.length && { moments: [{ line: 3, variables: { near: String(number) } }] }),
        }))"""
    )
    number = tab.page.locator(".cm-lineNumbers .cm-gutterElement", has_text="3")
    number.click()
    expect(tab.page.get_by_text("The program will wait at line 3.")).to_be_visible()
    expect(tab.page.locator(".ai4u-code-stop-line")).to_have_text(re.compile("return"))
    tab.sense()
    tab.press("Run")
    expect(tab.state).to_contain_text("Waits at line 3")
    expect(tab.page.locator(".ai4u-code-waiting-line")).to_have_count(1)
    expect(tab.page.locator(".ai4u-code-variables")).to_have_text("near1")
    assert tab.calls("act") == []
    assert tab.sent()[-1] == {"command": "pause"}
    expect(tab.page.get_by_role("button", name="Run", exact=True)).to_be_hidden()
    tab.sense(1)
    tab.press("Next line")  # the last one of this decision
    expect(tab.page.locator(".ai4u-code-variables")).to_have_text("near2")
    assert tab.calls("act") == [[{"move": [1, 0]}]]
    # without the breakpoint it goes on; F9 removes it at the cursor's line
    tab.editor.click()
    tab.page.keyboard.press("ControlOrMeta+End")
    tab.page.keyboard.press("ArrowUp")
    tab.page.keyboard.press("F9")
    expect(tab.page.locator(".ai4u-code-stop-line")).to_have_count(0)
    tab.page.keyboard.press("ControlOrMeta+Enter")
    expect(tab.state).to_contain_text("Runs")
    expect(tab.page.locator(".ai4u-code-waiting-line")).to_have_count(0)


def test_ctrl_enter_runs_and_stop_gives_the_agent_back(tab: CodePage) -> None:
    tab.sense()
    tab.editor.click()
    tab.page.keyboard.press("ControlOrMeta+Enter")
    expect(tab.state).to_contain_text("Runs")
    tab.press("Stop")
    expect(tab.state).to_contain_text("Stopped at decision 1; the robot is yours")
    assert tab.page.evaluate("fake.closed") == 1
    tab.sense(1)
    tab.press("Run")
    tab.page.wait_for_function("fake.calls.filter((each) => each[0] === 'connect').length === 2")
    assert len(tab.calls("decide")) == 1


def test_pressed_again_while_it_joins_it_connects_when_that_one_has_left(tab: CodePage) -> None:
    tab.page.evaluate("() => { fake.connecting = new Promise((done) => (fake.connected = done)); }")
    for _ in range(3):
        tab.press("Run")
    tab.page.wait_for_function("fake.calls.some((each) => each[0] === 'connect')")
    # those who asked for the same module before have got it then
    tab.page.evaluate("import('./web/remote/client.js').then(() => {})")
    assert len(tab.calls("connect")) == 1
    tab.page.evaluate("fake.connected()")
    tab.sense()
    expect(tab.state).to_contain_text("Runs")
    assert (len(tab.calls("connect")), tab.page.evaluate("fake.closed")) == (2, 1)


def test_run_begins_at_the_same_start(tab: CodePage) -> None:
    tab.sense()
    tab.press("Run")
    tab.page.wait_for_function("fake.calls.some((each) => each[0] === 'act')")
    assert tab.sent() == [{"command": "try_again"}]
    tab.press("Run")  # also while it runs
    tab.page.wait_for_function("panel.sent.length === 1")
    assert tab.sent() == [{"command": "try_again"}]
    assert tab.calls("reset") == []


def test_it_goes_on_from_where_the_robot_is(tab: CodePage) -> None:
    tab.sense(5)
    tab.press("Go on from here")
    tab.page.wait_for_function("fake.calls.some((each) => each[0] === 'act')")
    assert tab.sent() == []
    tab.press("Stop")
    tab.sense(6)  # for the one that was stopped
    tab.sense(9, terminated=True)  # from an end there is nowhere to go on
    tab.sense(0, episode=2)
    tab.press("Go on from here")
    tab.page.wait_for_function("fake.calls.filter((each) => each[0] === 'act').length === 2")
    assert tab.sent() == [{"command": "try_again"}]


def test_where_another_person_drives_it_begins_only_its_own_episode(tab: CodePage) -> None:
    agents = PARTS["scene"]["agents"]
    tab.give({**PARTS["scene"], "agents": [*agents, {**agents[0], "id": "1"}]}, "scene")
    for _ in range(2):
        tab.sense(9, terminated=True)
    tab.sense(0, episode=2)
    tab.press("Run")
    tab.page.wait_for_function("fake.calls.some((each) => each[0] === 'act')")
    assert tab.sent() == []
    assert tab.calls("reset") == [[]]


def test_another_episode_begins_the_program_anew(tab: CodePage) -> None:
    tab.sense()
    tab.press("Run")
    tab.page.wait_for_function("fake.calls.some((each) => each[0] === 'act')")
    tab.sense(0, episode=2)
    tab.page.wait_for_function("fake.calls.filter((each) => each[0] === 'begin').length === 2")


def test_a_paused_world_goes_on(tab: CodePage) -> None:
    tab.give({**PARTS["run"], "is_paused": True}, "run")
    tab.sense()
    tab.press("Run")
    expect(tab.state).to_contain_text("The world is paused")
    assert tab.sent() == [{"command": "try_again"}, {"command": "resume"}]
    tab.give({**PARTS["run"], "is_paused": False}, "run")
    expect(tab.state).to_contain_text("Runs")


@pytest.mark.parametrize("refuses", [False, True])
def test_in_a_mission_the_world_waits_for_late_decisions(tab: CodePage, refuses: bool) -> None:
    tab.page.evaluate("document.documentElement.dataset.ai4uMission = 'open'")
    tab.page.evaluate("refuses => (fake.refuses = refuses)", refuses)
    tab.sense()
    tab.press("Run")
    expect(tab.state).to_contain_text("Runs")
    modes = [options["mode"] for (options,) in tab.calls("connect")]
    assert modes == (["lockstep", "realtime"] if refuses else ["lockstep"])


def test_step_makes_one_decision_and_the_world_waits(tab: CodePage) -> None:
    tab.sense(0)
    tab.sense(1)
    tab.press("Step")
    expect(tab.state).to_contain_text("Waits for the next step")
    expect(tab.state).to_contain_text("decision 1")
    assert tab.calls("connect") == [[{"agent": "0", "mode": "lockstep"}]]
    tab.page.wait_for_function("fake.waits > 0")
    assert len(tab.calls("decide")) == 1
    tab.sense(2)
    tab.press("Step")
    expect(tab.state).to_contain_text("decision 2")
    assert len(tab.calls("load")) == 1


def test_from_step_to_run_the_program_remembers(tab: CodePage) -> None:
    tab.sense(0)
    tab.sense(1)
    tab.press("Step")
    expect(tab.state).to_contain_text("decision 1")
    tab.sense(1)
    tab.press("Run")
    tab.page.wait_for_function("fake.calls.filter((each) => each[0] === 'act').length === 2")
    assert [mode for ((mode,),) in [[[each[0]["mode"]]] for each in tab.calls("connect")]] == [
        "lockstep",
        "realtime",
    ]
    assert len(tab.calls("load")) == len(tab.calls("begin")) == 1


def test_a_mistake_is_a_sentence_at_its_line(tab: CodePage) -> None:
    tab.write(PROGRAM)
    tab.fail("nothing is called 'neer'; did you mean 'near'?", 3, "unknown-name")
    tab.sense()
    tab.press("Run")
    expect(tab.mistake).to_contain_text("Line 3: nothing is called 'neer'; did you mean 'near'?")
    expect(tab.page.get_by_role("alert")).to_be_visible()
    marked = tab.page.locator(".ai4u-code-mistake-line")
    expect(marked).to_have_text('    return {"move": [near, 0]}')
    tab.press("Go to the line")
    expect(tab.editor).to_be_focused()
    assert tab.page.evaluate("fake.closed") == 1
    assert tab.sent() == [{"command": "try_again"}, {"command": "pause"}]  # while it is mended
    tab.give({**PARTS["run"], "is_paused": True}, "run")
    expect(tab.state).to_contain_text("Stopped: there's a mistake in line 3. The world waits.")
    tab.press("Run")
    expect(tab.mistake).to_be_hidden()
    expect(marked).to_have_count(0)


def test_a_mistake_that_no_line_made_has_no_button(tab: CodePage) -> None:
    tab.page.evaluate("fake.load = { ok: false, text: 'there is no decide', line: 0, kind: '' }")
    tab.sense()
    tab.press("Run")
    expect(tab.mistake).to_have_text("there is no decide")


def test_a_mistake_does_not_stop_another_persons_world(tab: CodePage) -> None:
    agents = PARTS["scene"]["agents"]
    tab.give({**PARTS["scene"], "agents": [*agents, {**agents[0], "id": "1"}]}, "scene")
    tab.fail("nothing is called 'neer'", 3, "unknown-name")
    tab.sense()
    tab.press("Run")
    expect(tab.mistake).to_be_visible()
    assert tab.sent() == []


def test_a_world_that_refuses_is_told(tab: CodePage) -> None:
    tab.page.evaluate("fake.connectError = 'the robot is driven by another script'")
    tab.press("Run")
    expect(tab.mistake).to_have_text("the robot is driven by another script")
    expect(tab.state).to_contain_text("The run ended")


def test_programs_are_kept_for_each_scene(tab: CodePage) -> None:
    tab.write(PROGRAM)
    tab.give({**PARTS["scene"], "scene": "maze"}, "scene")
    tab.give(PARTS["agent"])
    assert "turn = 0.3" in tab.text
    tab.give(PARTS["scene"], "scene")
    tab.give(PARTS["agent"])
    assert tab.text == PROGRAM
    tab.page.reload()
    tab.page.wait_for_function("window.isReady")
    tab.give(PARTS["scene"], "scene")
    tab.give(PARTS["python"], "python")
    tab.give(PARTS["agent"])
    assert tab.text == PROGRAM


@contextmanager
def standing_clock(page: Page, ahead_ms: int = 0) -> Iterator[None]:
    """Let a page's clock stand, at a time that is a while ahead."""
    stand = "(ahead) => { window.now = Date.now; const at = now() + ahead; Date.now = () => at; }"
    page.evaluate(stand, ahead_ms)
    try:
        yield
    finally:
        page.evaluate("Date.now = window.now")


def test_an_earlier_run_is_taken_back(tab: CodePage) -> None:
    runs = tab.page.get_by_label("Earlier runs")
    tab.write(PROGRAM)
    tab.press("Run")
    expect(runs.locator("option")).to_have_count(3)
    tab.write("x = 1")
    tab.press("Run")
    expect(runs.locator("option")).to_have_count(4)
    # long after what was written, and both in the same moment: the editor joins what is typed so
    with standing_clock(tab.page, ahead_ms=10_000):
        runs.select_option(index=2)
        assert tab.text == PROGRAM
        runs.select_option(label="The first program")
        assert "turn = 0.3" in tab.text
    tab.editor.click()
    tab.page.keyboard.press("ControlOrMeta+z")
    assert tab.text == PROGRAM


def test_a_scene_has_several_programs_with_names(tab: CodePage) -> None:
    programs = tab.page.get_by_label("Program", exact=True)
    tab.write(PROGRAM)
    tab.press("New program")
    assert "turn = 0.3" in tab.text
    tab.write("x = 1")
    tab.press("Rename this program")
    dialog = tab.page.get_by_role("dialog")
    dialog.get_by_label("Name").fill("Wall follower")
    dialog.get_by_role("button", name="Rename").click()
    expect(programs.locator("option")).to_have_text(["Program 1", "Wall follower"])
    programs.select_option("Program 1")
    assert tab.text == PROGRAM
    tab.press("Copy this program")
    assert tab.text == PROGRAM
    expect(programs).to_have_value("Program 2")
    programs.select_option("Wall follower")
    assert tab.text == "x = 1"
    tab.page.reload()
    tab.page.wait_for_function("window.isReady")
    for name in ("scene", "python", "agent"):
        tab.give(PARTS[name], name)
    expect(programs).to_have_value("Wall follower")
    assert tab.text == "x = 1"
    tab.press("Delete this program")
    dialog.get_by_role("button", name="Cancel").click()
    expect(programs).to_have_value("Wall follower")
    tab.press("Delete this program")
    dialog.get_by_role("button", name="Delete").click()
    expect(programs.locator("option")).to_have_text(["Program 1", "Program 2"])
    assert tab.text == PROGRAM
    tab.page.get_by_label("Earlier runs").select_option(index=1)
    assert tab.text == "x = 1"


def test_the_first_program_fits_the_robot_of_a_scene_whose_parts_come_later(tab: CodePage) -> None:
    tab.give({**PARTS["scene"], "scene": "line_follow"}, "scene")
    tab.give(PARTS["agent"])
    wheel = {"low": -1, "high": 1, "has_effect": True}
    wheels = [{"name": "left", **wheel}, {"name": "right", **wheel}]
    drive = {"name": "move", "is_choice": False, "components": wheels}
    tab.give({**PARTS["python"], "actuators": [drive]}, "python")
    assert 'return {"move": [left, right]}' in tab.text


def test_only_the_latest_runs_are_kept(tab: CodePage) -> None:
    script = """async () => {
      const { KeptPrograms } = await import("./web/code/keep.js");
      const kept = new KeptPrograms();
      kept.open("many", "0");
      for (let each = 0; each < 60; each += 1) kept.addRun(`x = ${each}`);
      const count = kept.runs.length;
      kept.addRun("#".repeat(150000));
      kept.addRun("!".repeat(150000));
      return [count, kept.runs.length];
    }"""
    assert tab.page.evaluate(script) == [50, 1]


def test_a_program_is_saved_and_opened_as_a_file(tab: CodePage, tmp_path: Path) -> None:
    tab.write(PROGRAM)
    with tab.page.expect_download() as download:
        tab.press("Download .py")
    assert download.value.suggested_filename == "box_chase-0.py"
    assert Path(download.value.path()).read_text() == PROGRAM
    file = tmp_path / "mine.py"
    file.write_text("def decide(percept):\r\n    return {}\r\n", newline="")
    with tab.page.expect_file_chooser() as chooser:
        tab.press("Open .py")
    chooser.value.set_files(file)
    expect(tab.editor).to_contain_text("return {}")
    assert tab.text == "def decide(percept):\n    return {}\n"


def test_output_is_bounded(tab: CodePage) -> None:
    script = 'fake.decide = () => ({ ok: true, values: {}, printed: "spam\\n".repeat(500) })'
    tab.page.evaluate(script)
    tab.sense()
    tab.press("Run")
    expect(tab.page.get_by_role("log").locator("li")).to_have_count(200)


def test_names_are_inserted_and_offered(tab: CodePage) -> None:
    tab.write("x = ")
    tab.press('percept["rays"]')
    assert tab.text == 'x = percept["rays"]'
    tab.write("x = ")
    tab.page.keyboard.type('percept["r')
    expect(tab.page.get_by_role("option", name="rays")).to_be_visible()
    tab.page.keyboard.press("Escape")
    expect(tab.page.get_by_role("option", name="rays")).to_have_count(0)
    expect(tab.editor).to_be_focused()


def test_tab_indents_and_after_escape_leaves(tab: CodePage) -> None:
    tab.write("x")
    tab.page.keyboard.press("Home")
    tab.page.keyboard.press("Tab")
    assert tab.text == "    x"
    expect(tab.editor).to_have_accessible_description(re.compile("Escape, then Tab leaves"))
    # the editor's own limit is 2 s between the two, however busy the machine is
    with standing_clock(tab.page):
        tab.page.keyboard.press("Escape")
        tab.page.keyboard.press("Tab")
    expect(tab.editor).not_to_be_focused()
    expect(tab.page.locator("summary").filter(has_text="Output")).to_be_focused()
    assert tab.text == "    x"


@pytest.mark.parametrize(("is_touch", "smallest"), [(False, 28), (True, 40)])
def test_controls_are_large_enough_and_have_names(
    chromium: Browser, is_touch: bool, smallest: float
) -> None:
    tab = CodePage(chromium, size=(390, 844), has_touch=is_touch, is_mobile=is_touch)
    tab.fail("a " + "long" * 60, 2, "error")
    tab.sense()
    tab.press("Run")
    expect(tab.mistake).to_be_visible()
    assert tab.small_controls(smallest) == []
    assert tab.unnamed_controls() == []
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= 390
    tab.close()


@pytest.mark.parametrize("scheme", SCHEMES)
def test_it_has_no_grave_finding(chromium: Browser, scheme: str) -> None:
    tab = CodePage(chromium, scheme=scheme)
    tab.write(PROGRAM)
    tab.fail("nothing is called 'neer'", 2, "unknown-name")
    tab.sense()
    tab.press("Run")
    expect(tab.mistake).to_be_visible()
    assert findings(tab.page, ".ai4u-panel") == []
    tab.close()


def test_typing_does_not_drive(chromium: Browser) -> None:
    with panel_room() as room, panel_page(chromium, room) as desk:
        serve_fakes(desk.page)
        desk.tab("Code").click()
        editor = desk.page.get_by_role("textbox", name="Program in Python")
        editor.click()
        with recorded_holds(room) as holds:
            desk.page.keyboard.press("KeyA")
            expect(editor).to_contain_text("a")
            desk.page.keyboard.press("Enter")
            expect(editor).to_be_focused()
            desk.page.keyboard.press("Escape")
            desk.page.keyboard.down("KeyW")
            desk.until(lambda: room.held == ["KeyW"])
            desk.page.keyboard.up("KeyW")
        assert ["KeyW"] in holds
        assert ["KeyA"] not in holds


def test_the_editor_is_loaded_with_the_tab_and_kept_by_the_browser(chromium: Browser) -> None:
    bundle = web_folder() / "vendor" / "codemirror.js"
    version = hashlib.sha256(bundle.read_bytes()).hexdigest()[:8]
    assert f'vendor/codemirror.js?v={version}"' in (web_folder() / "code/editor.js").read_text()
    asked: list[str] = []

    def listen(page: Page) -> None:
        page.on("request", lambda request: asked.append(request.url))
        serve_fakes(page)

    tab = TabPage(chromium, "panel/past/tab", "PastTab", "past", prepare=listen)
    tab.close()
    assert not [url for url in asked if "vendor" in url or "code_" in url]
    with panel_room() as room:
        page = new_page(chromium)
        listen(page)
        page.goto(room.url)
        expect(page.get_by_role("tab", name="Past")).to_be_attached()
        assert not [url for url in asked if "vendor" in url or "code_" in url]
        page.context.close()
