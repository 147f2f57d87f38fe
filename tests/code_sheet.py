"""Takes the pictures of programs in the page for the docs: ``python -m tests.code_sheet``.

With ``--all DIR``, it takes them light, dark, on a phone and with words of Portuguese's length
instead, to look at. World, page and Python are real.
"""

import argparse
import contextlib
import io
import re
from pathlib import Path
from typing import Any, Literal

from PIL import Image
from playwright.sync_api import Browser, Page, expect

from tests.browser.blocks_keys import choose, go, set_number
from tests.browser.served_viser import ready
from tests.chromium import browser
from tests.playing import played

ROOT = Path(__file__).parents[1]
PICTURES = ROOT / "docs" / "pictures"
DOC = ROOT / "docs" / "code-in-the-page.md"
SEED = "5"
"""A seed with which box_chase puts the box where the robot has to turn for it."""
TIME_SCALE = "0.3"
"""Slow enough for a machine that draws without a graphics card."""
DESK, PHONE = (1180, 900), (390, 844)
LOADING_MS = 60_000
SETTLE_MS = 1200
COLORS = 256
Scheme = Literal["light", "dark"]
LENGTHEN = """() => { const panel = document.querySelector(".ai4u-panel");
  const texts = document.createTreeWalker(panel, NodeFilter.SHOW_TEXT);
  const longer = (word) => word + word.slice(0, Math.ceil(word.length * 0.35));
  while (texts.nextNode()) {
    const text = texts.currentNode;
    if (!text.parentElement.closest(".cm-content, pre, style"))
      text.data = text.data.replace(/[a-z]{4,}/gi, longer);
  } }"""
"""A script that makes the panel's words a third longer, as a translation into Portuguese does."""


def main() -> None:
    """Take the pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--all", type=Path, help="folder for all of them")
    folder: Path | None = parser.parse_args().all
    with browser() as chromium:
        if folder is None:
            _take(chromium, PICTURES / "code_{}.png", DESK, "light")
            _take_blocks(chromium, PICTURES / "code_{}.png", DESK, "light")
            return
        folder.mkdir(parents=True, exist_ok=True)
        for size, name in ((DESK, "desk"), (PHONE, "phone")):
            _take(chromium, folder / f"{name}_long_{{}}.png", size, "light", is_long=True)
            for scheme in ("light", "dark"):
                _take(chromium, folder / f"{name}_{scheme}_{{}}.png", size, scheme)
                _take_blocks(chromium, folder / f"{name}_{scheme}_{{}}.png", size, scheme)


def _take(
    chromium: Browser,
    path: Path,
    size: tuple[int, int],
    scheme: Scheme,
    *,
    is_long: bool = False,
) -> None:
    """Take the pictures of a run and of a mistake.

    Args:
        path: of a picture, with a place for its name.
        is_long: make the words longer, see :data:`LENGTHEN`.
    """
    viewport: Any = {"width": size[0], "height": size[1]}
    context = chromium.new_context(viewport=viewport, color_scheme=scheme)
    program = programs_in_docs()[0]
    with (
        played("box_chase", "--seed", SEED, "--time-scale", TIME_SCALE) as server,
        contextlib.closing(context),
    ):
        page = context.new_page()
        page.goto(server.url)
        ready(page)
        if size == PHONE:
            page.get_by_role("button", name="Open the panel").click()
        page.get_by_role("tab", name="Code").click()
        _run(page, program)
        expect(page.locator(".ai4u-code-state")).to_contain_text("decision", timeout=LOADING_MS)
        page.wait_for_timeout(SETTLE_MS)
        if is_long:
            page.get_by_role("button", name="Pause", exact=True).click()  # else its numbers change
            page.evaluate(LENGTHEN)
        _save(page.screenshot(), path, "tab")
        if is_long:
            return
        _run(page, program.replace("if cosine", "if cosin"))
        mistake = page.locator(".ai4u-code-mistake")
        expect(mistake).to_be_visible(timeout=LOADING_MS)
        mistake.scroll_into_view_if_needed()
        page.wait_for_timeout(SETTLE_MS)
        _save(page.locator(".ai4u-panel").screenshot(), path, "mistake")


def _take_blocks(chromium: Browser, path: Path, size: tuple[int, int], scheme: Scheme) -> None:
    """Take the picture of blocks that drive through the maze, beside their Python."""
    viewport: Any = {"width": size[0], "height": size[1]}
    is_phone = size == PHONE
    context = chromium.new_context(
        viewport=viewport, color_scheme=scheme, has_touch=is_phone, is_mobile=is_phone
    )
    with (
        played("maze", "--seed", SEED, "--time-scale", TIME_SCALE) as server,
        contextlib.closing(context),
    ):
        page = context.new_page()
        page.goto(server.url)
        ready(page)
        if is_phone:
            page.get_by_role("button", name="Open the panel").click()
        page.get_by_role("tab", name="Code").click()
        page.get_by_role("button", name="Blocks", exact=True).click()
        first = page.locator("*:focus")
        expect(first).to_have_attribute("aria-label", re.compile("forever"), timeout=LOADING_MS)
        _turn_away(page)
        page.keyboard.press("Control+Enter")
        expect(page.locator(".ai4u-code-state")).to_contain_text("decision", timeout=LOADING_MS)
        if is_phone:
            page.locator(".ai4u-blocks-editor").scroll_into_view_if_needed()
        page.wait_for_timeout(SETTLE_MS)
        _save(page.screenshot(), path, "blocks")


def _turn_away(page: Page) -> None:
    """Put the program of the third step together."""
    choose(page, "Control", "if, Empty, has 2 branches")
    choose(page, "Numbers", "0, <")
    choose(page, "Senses", "distance")
    go(page, "ArrowRight", "dropdown: on any side")
    for key in ("Enter", "ArrowDown", "Enter"):
        page.keyboard.press(key)
    go(page, "ArrowRight", "Edit number")
    set_number(page, "0.8")
    go(page, "ArrowUp", "if,")
    choose(page, "Actions", "turn")
    go(page, "ArrowRight", "Edit number")
    set_number(page, "0.5")
    go(page, "ArrowDown", "End else")
    choose(page, "Actions", "forward")
    go(page, "ArrowRight", "Edit number")
    set_number(page, "0.5")


def programs_in_docs() -> list[str]:
    """Return the programs of the page about programs."""
    text = DOC.read_text(encoding="utf-8")
    blocks = re.findall(r"(?:^    .*\n|^\n(?=    ))+", text, re.MULTILINE)
    return [re.sub(r"^    ", "", str(each), flags=re.MULTILINE).strip("\n") for each in blocks]


def _run(page: Page, program: str) -> None:
    page.get_by_role("textbox", name="Program in Python").click()
    page.keyboard.press("ControlOrMeta+a")
    page.keyboard.insert_text(program)
    page.keyboard.press("ControlOrMeta+Enter")


def _save(picture: bytes, path: Path, name: str) -> None:
    file = Path(str(path).format(name))
    Image.open(io.BytesIO(picture)).convert("RGB").quantize(COLORS).save(file, optimize=True)
    print(file, file.stat().st_size // 1000, "kB")


if __name__ == "__main__":
    main()
