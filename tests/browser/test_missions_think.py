"""A mission of the island "Think", done in a served page with blocks and the real Python."""

import re
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from ai4u_edu.missions.mission import library_missions
from tests.browser.blocks import State, act, block, compare, near, program, stack
from tests.browser.code_page import WORLD_WAITS, set_limits
from tests.browser.served_viser import ready
from tests.chromium import new_page
from tests.playing import played

pytestmark = [pytest.mark.browser, pytest.mark.nightly]

SIZE = 1366, 768
SEED = "4"
"""A start of the maze with room ahead."""
FOREVER = block("on_decision")


class Card:
    """The card of a mission, and the tab "Code" beside it."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.card = page.get_by_role("region", name="Mission")

    @property
    def done(self) -> Locator:
        return self.card.locator(".ai4u-mission-done")

    def press(self, name: str) -> None:
        self.page.locator(".ai4u-panel").get_by_role("button", name=name, exact=True).click()

    def press_lit(self, name: str) -> None:
        """Press the one button that is lit."""
        lit = self.page.locator("[data-ai4u-lit]")
        expect(lit).to_have_text([name])
        expect(lit).to_be_in_viewport()
        lit.click()

    def go_on(self) -> None:
        """Wait until the step is done, and press Next."""
        expect(self.done).to_be_visible()
        self.card.get_by_role("button", name="Next", exact=True).click()
        expect(self.done).to_be_hidden()

    def snap(self, *blocks: State) -> None:
        """Replace the program with blocks, which Blockly puts together."""
        script = """async (blocks) => {
          const { joinProgram } = await import("./web/blocks/text.js");
          return joinProgram("", blocks, true);
        }"""
        text: str = self.page.evaluate(script, program(stack(FOREVER, *blocks)))
        with self.page.expect_file_chooser() as chooser:
            self.press("Open .py")
        chooser.value.set_files(
            {"name": "mine.py", "mimeType": "text/x-python", "buffer": text.encode()}
        )
        editor = self.page.get_by_role("textbox", name="Program in Python")
        expect(editor).to_contain_text(re.compile(r"\w+ = \w+ = 0"))  # as blocks begin

    def drag(self, group: str, title: str, below: str) -> None:
        """Drag a block out of a group, and drop it under another one."""
        editor = self.page.locator(".ai4u-blocks-editor")
        editor.locator(".blocklyToolboxCategory").filter(has_text=group).click()
        source = editor.locator(".blocklyFlyout .blocklyDraggable").filter(has_text=title).first
        start = source.bounding_box()
        assert start is not None
        above = editor.locator(".blocklyBlockCanvas .blocklyDraggable").filter(has_text=below).last
        end = above.bounding_box()
        assert end is not None
        mouse, grip = self.page.mouse, 12
        mouse.move(start["x"] + grip, start["y"] + grip)
        mouse.down()
        mouse.move(start["x"] + 60, start["y"] + 60, steps=5)
        mouse.move(end["x"] + grip, end["y"] + end["height"] + grip, steps=5)
        mouse.up()


@contextmanager
def card(chromium: Browser, mission: str, *, late: bool = False) -> Iterator[Card]:
    """Open a mission's first step in its scene.

    Args:
        late: the world is faster than its program, which is late with every decision.
    """
    page, problems = new_page(chromium, *SIZE), list[str]()
    page.on("pageerror", lambda error: problems.append(str(error)))
    scene = library_missions().get(mission).scene
    pace = ("--time-scale", "20") if late else ()
    with played(scene, "--seed", SEED, *pace, *WORLD_WAITS) as server:
        kept = f'{{"mission": "{mission}", "step": 0}}'
        page.add_init_script(f"localStorage['ai4u-mission-'] ??= '{kept}'")
        page.goto(server.url)
        ready(page)
        set_limits(page)
        yield Card(page)
        page.context.close()
    assert problems == []


def test_a_block_is_dragged_and_drives(chromium: Browser) -> None:
    with card(chromium, "think-1") as ada:
        ada.press_lit("Code")
        ada.go_on()
        ada.press_lit("Blocks")
        expect(ada.page.locator(".ai4u-blocks-editor")).to_be_in_viewport(ratio=1)
        ada.drag("Actions", "forward", below="forever")
        expect(ada.page.get_by_role("textbox", name="Program in Python")).to_contain_text(
            "forward = 1"
        )
        ada.press_lit("Run")
        ada.go_on()
        room = compare(near_ahead(), "GT", 0.8)
        ada.snap(block("if", IF=room, DO=act(0, 0.5)))
        ada.press("New start")
        ada.press("Run")
        expect(ada.done).to_contain_text("It looked before it acted")


def test_late_decisions_do_not_fail_a_program_that_is_right(chromium: Browser) -> None:
    with card(chromium, "think-2", late=True) as ada:
        ada.press_lit("Code")
        ada.go_on()
        ada.press_lit("Blocks")
        wall = compare(near_ahead(), "LT", 1.2)
        ada.snap(block("if_else", IF=wall, DO=act(1, 0.5), ELSE=act(0, 0.5)))
        ada.press("Run")
        expect(ada.done).to_contain_text("It never gets stuck")


def near_ahead() -> State:
    return {**near("ahead"), "type": "near:vision"}
