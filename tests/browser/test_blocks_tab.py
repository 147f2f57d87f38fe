"""Programs of blocks in the tab "Code", with a fake Python and a fake world."""

import hashlib
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, FloatRect, Locator, expect

from ai4u_edu.page.server.web_files import FOLDERS, web_folder
from tests.browser.blocks import State, act, block, program, stack
from tests.browser.blocks_keys import choose, to_group
from tests.browser.code_tab import PROGRAM, CodePage
from tests.browser.fake_panel import PARTS
from tests.browser.test_panel_accessibility import findings

pytestmark = pytest.mark.browser

DRIVE = (
    "def decide(percept):\n"
    "    forward = turn = 0\n"
    "    forward = 0.8\n"
    '    return {"move": [forward, turn, 0]}\n'
)


class BlocksPage(CodePage):
    """The tab, with keys for the blocks."""

    def to_blocks(self) -> None:
        self.page.get_by_role("button", name="Blocks", exact=True).focus()
        self.keys("Enter")
        expect(self.focused).to_have_attribute("aria-label", re.compile("forever"))

    def keys(self, *keys: str) -> None:
        for key in keys:
            self.page.keyboard.press(key)

    def choose(self, group: str, block: str) -> None:
        """Take a block of a group, and drop it where the editor proposes."""
        choose(self.page, group, block)

    @property
    def focused(self) -> Locator:
        return self.page.locator("*:focus")

    @property
    def canvas(self) -> Locator:
        """The blocks, without those to choose from."""
        return self.page.locator(".blocklySvg .blocklyBlockCanvas")

    def open_file(self, text: str) -> None:
        with self.page.expect_file_chooser() as chooser:
            self.press("Open .py")
        chooser.value.set_files(
            {"name": "mine.py", "mimeType": "text/x-python", "buffer": text.encode()}
        )

    def open_blocks(self, *blocks: State) -> None:
        """Open a file with blocks below "forever"."""
        script = """async (blocks) => {
          const { joinProgram } = await import("./web/blocks/text.js");
          return joinProgram("", blocks, true);
        }"""
        shown = program(stack(block("on_decision"), *blocks))
        self.open_file(self.page.evaluate(script, shown))

    def ran(self) -> Locator:
        return self.page.locator(".ai4u-blocks-ran")

    def kept(self) -> dict[str, Any]:
        """Return the blocks that the browser keeps."""
        text: str = json.loads(self.page.evaluate("localStorage['ai4u-code-box_chase-0']"))
        found: dict[str, Any] = json.loads(text.split("\n# blocks: ")[1])
        return found


@pytest.fixture
def tab(chromium: Browser) -> Iterator[BlocksPage]:
    with BlocksPage.opened(chromium, size=(640, 800)) as tab:
        yield tab


def test_a_program_is_put_together_and_run_by_keyboard_alone(tab: BlocksPage) -> None:
    asked: list[str] = []
    loaded = "performance.getEntriesByType('resource').filter((each) => /blockly/.test(each.name))"
    assert tab.page.evaluate(f"{loaded}.length") == 0
    tab.page.on("request", lambda request: asked.append(request.url))
    tab.to_blocks()
    assert findings(tab.page, ".ai4u-panel") == []
    assert tab.text == DRIVE.replace("    forward = 0.8\n", "")
    tab.choose("Actions", "forward")
    tab.keys("ArrowRight", "ArrowRight", "Enter")
    tab.page.keyboard.type("0.8")
    tab.keys("Enter")
    expect(tab.editor).to_contain_text("forward = 0.8")
    assert tab.text == DRIVE
    tab.sense()
    tab.keys("Control+Enter")
    expect(tab.state).to_contain_text("Runs")
    ((source, _),) = tab.calls("load")
    assert source == DRIVE
    expect(tab.ran()).to_have_count(2)  # the fake program says that it ran lines 2 and 3
    tab.page.evaluate("""() => (fake.decide = () =>
      ({ ok: true, values: { move: [1, 0] }, printed: "", lines: [3], variables: {} }))""")
    tab.sense(1)
    expect(tab.ran()).to_have_count(1)
    expect(tab.ran()).to_contain_text("forward")
    tab.fail("forward is too large", 3, "error")
    tab.sense(2)
    expect(tab.page.locator(".ai4u-blocks-mistake")).to_contain_text("forward")
    tab.press("Go to the line")
    expect(tab.focused).to_have_attribute("aria-label", re.compile("forward"))
    tab.keys("Delete")
    expect(tab.editor).not_to_contain_text("0.8")
    expect(tab.page.locator(".ai4u-blocks-mistake")).to_have_count(0)
    tab.keys("Shift+F10")  # a menu
    names = [re.sub(r"^http://127\.0\.0\.1:\d+/fakes/web/|\?.*$", "", url) for url in asked]
    foreign = (name for name in names if "/" in name and name.partition("/")[0] not in FOLDERS)
    others = {name for name in foreign if not name.startswith("data:")}
    assert others == {"vendor/blockly.js"}


# real time: none; setTimeout without a delay is a turn of the event loop
HOLD_FRAMES = """() => {
  const held = [];
  const draw = window.requestAnimationFrame;
  const turn = () => new Promise((done) => setTimeout(done));
  window.requestAnimationFrame = (each) => held.push(each);
  window.drawFrames = async () => {
    // what is drawn asks for more frames, also in a later turn of the event loop
    for (let idle = 0; idle < 5; idle += 1) {
      if (held.length) idle = 0;
      for (const each of held.splice(0)) each(performance.now());
      await turn();
    }
    window.requestAnimationFrame = draw;
  };
}"""
"""Page script that holds all frames back until ``drawFrames`` is called."""


def test_where_pictures_come_late_the_keys_stay_with_the_blocks(tab: BlocksPage) -> None:
    tab.to_blocks()
    tab.choose("Control", "if, Empty, has input")
    tab.page.evaluate(HOLD_FRAMES)
    tab.choose("Numbers", "0, <")
    tab.choose("Senses", "box, direction")
    tab.page.evaluate("drawFrames()")
    expect(tab.editor).to_contain_text('percept["box"]')
    expect(tab.focused).to_have_attribute("aria-label", re.compile("box, direction"))


def test_one_goes_on_in_python_and_back_and_nothing_is_lost(tab: BlocksPage) -> None:
    tab.write(PROGRAM)
    tab.to_blocks()
    runs = tab.page.get_by_label("Earlier runs").locator("option")
    expect(runs).to_have_count(3)
    tab.choose("Actions", "turn")
    expect(tab.editor).to_contain_text("turn = 1")
    blocks = tab.kept()["blocks"]
    tab.editor.click()
    tab.page.keyboard.insert_text("x")
    assert "x" not in tab.text
    tab.press("Python")
    expect(tab.editor).to_be_focused()
    expect(tab.page.locator(".ai4u-blocks-editor")).to_be_hidden()
    tab.write(PROGRAM)
    assert tab.kept() == {"version": 1, "of": "", "blocks": blocks}
    with tab.page.expect_download() as download:
        tab.press("Download .py")
    text = Path(download.value.path()).read_text()
    assert text.startswith(f"{PROGRAM}\n# blocks: ")
    tab.to_blocks()
    expect(tab.editor).to_contain_text("turn = 1")
    with tab.page.expect_download() as download:
        tab.press("Download .py")
    text = Path(download.value.path()).read_text()
    tab.page.get_by_label("Earlier runs").select_option("start")
    expect(tab.page.locator(".ai4u-blocks-editor")).to_be_hidden()
    tab.open_file(text)
    expect(tab.page.locator(".ai4u-blocks-editor")).to_be_visible()
    expect(tab.editor).to_contain_text("turn = 1")
    assert "# blocks" not in tab.text
    tab.page.reload()
    tab.page.wait_for_function("window.isReady")
    for name in ("scene", "python", "agent"):
        tab.give(PARTS[name], name)
    expect(tab.canvas).to_contain_text("forever")
    expect(tab.editor).to_contain_text("turn = 1")


def test_blocks_of_another_robot_are_kept(tab: BlocksPage) -> None:
    tab.to_blocks()
    tab.choose("Actions", "forward")
    expect(tab.editor).to_contain_text("forward = 1")
    other = {**PARTS["python"], "actuators": [], "sensors": []}
    tab.give(other, "python")
    expect(tab.canvas).to_contain_text("(not of this robot) move:0")
    expect(tab.editor).to_contain_text("pass  # this robot has no move:0")
    tab.give(PARTS["python"], "python")
    expect(tab.editor).to_contain_text("forward = 1")
    # a variable is asked for in a window of the page
    to_group(tab.page, "Memory")
    tab.keys("Enter")
    tab.page.get_by_label("New variable name:").fill("my steps")
    tab.keys("Enter")
    expect(tab.page.locator("dialog")).to_have_count(0)
    tab.page.locator(".blocklyToolboxCategory").filter(has_text="Memory").click()
    tab.page.locator(".blocklyFlyout").get_by_text("change").click()
    expect(tab.canvas).to_contain_text("my steps")
    # blocks may come from anybody, in a link or a file
    broken = """async () => {
      const { joinProgram } = await import("./web/blocks/text.js");
      const blocks = { blocks: { blocks: [{ type: "on_decision", next: { block: 7 } }] } };
      return joinProgram("x = 1\\n", blocks, true);
    }"""
    tab.open_file(tab.page.evaluate(broken))
    expect(tab.page.locator(".ai4u-blocks")).to_contain_text(
        "The blocks of this program are damaged"
    )
    assert tab.text == "x = 1\n"
    tab.page.get_by_label("Earlier runs").select_option(index=1)
    expect(tab.canvas).to_contain_text("my steps")


def test_wide_blocks_are_shown_smaller(tab: BlocksPage) -> None:
    def box(thing: Locator) -> FloatRect:
        found = thing.bounding_box()
        assert found is not None
        return found

    def right(thing: Locator) -> float:
        return box(thing)["x"] + box(thing)["width"]

    def letters_px() -> float:
        return box(tab.canvas.get_by_text("forever"))["height"]

    tab.to_blocks()
    usual = letters_px()
    nested: State | float = 1
    for _ in range(4):
        nested = block("arithmetic", {"OP": "ADD"}, A=nested, B=1)
    tab.open_blocks(act(1, nested))
    expect(tab.canvas).to_contain_text("turn")
    assert right(tab.canvas) <= right(tab.page.locator("svg.blocklySvg"))
    assert letters_px() < usual
    tab.open_blocks(act(1, 1))
    expect(tab.editor).to_contain_text("turn = 1")
    assert letters_px() == usual


@pytest.mark.nightly
def test_dark_on_a_phone_it_has_no_grave_finding(chromium: Browser) -> None:
    with BlocksPage.opened(chromium, scheme="dark", size=(390, 844)) as tab:
        tab.to_blocks()
        assert findings(tab.page, ".ai4u-panel") == []
        assert tab.page.evaluate("document.documentElement.scrollWidth") <= 390


def test_the_address_of_blockly_changes_with_it() -> None:
    bundle = web_folder() / "vendor" / "blockly.js"
    version = hashlib.sha256(bundle.read_bytes()).hexdigest()[:8]
    script = (web_folder() / "blocks/workspace.js").read_text()
    assert f'vendor/blockly.js?v={version}"' in script


def test_blockly_speaks_portuguese(chromium: Browser) -> None:
    with BlocksPage.opened(chromium, size=(640, 800), locale="pt-BR") as tab:
        tab.page.get_by_role("button", name="Blocos", exact=True).focus()
        tab.keys("Enter")
        expect(tab.focused).to_have_attribute("aria-label", re.compile("sempre"))
        tab.keys("Shift+F10")
        expect(tab.page.locator(".blocklyContextMenu")).to_contain_text("Desabilitar bloco")
