"""Sliders in a real JupyterLab, moved and pressed by a student."""

import os
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from ai4u_edu.lessons.handout import hand_out
from ai4u_edu.lessons.notebook import Cell, dumps
from ai4u_edu.lessons.progress_file import ProgressFile
from tests.chromium import new_page
from tests.lessons.lab import lab
from tests.lessons.test_in_lab import chromium

__all__ = ["chromium"]  # a fixture
pytestmark = [pytest.mark.browser, pytest.mark.nightly]

CODE = """from ai4u_edu.lessons import cards, sliders


def make(left=0, right=0):
    def wires(percept):
        eyes = percept["left eye"][0], percept["right eye"][0]
        return {"wheels": [left * eyes[0], left * eyes[1]]}

    return wires


sliders("05.2", make, left=(-1, 1), right=(-1, 1))
"""


def test_sliders_are_moved_tried_and_checked(chromium: Browser, tmp_path: Path) -> None:
    hand_out(tmp_path)  # its settings keep JupyterLab's questions away
    (tmp_path / "sliders.ipynb").write_text(dumps([Cell(CODE)]), encoding="utf-8")
    with lab(tmp_path) as url:
        page = new_page(chromium, 1366, 768, draws=True)
        page.goto(url + "lab/tree/sliders.ipynb")
        page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()
        page.locator(".jp-CodeCell .cm-content").first.click()
        page.keyboard.press("Control+Enter")
        page.get_by_role("slider").first.focus()
        expect(page.get_by_text("If nothing happens, run this cell again.")).to_be_visible()
        page.keyboard.press("End")
        page.get_by_role("button", name="Try", exact=True).click()
        page.get_by_alt_text("the episode").wait_for()
        shots = os.environ.get("AI4U_SHOTS")
        if shots:
            page.screenshot(path=Path(shots) / "sliders_try.png")
        page.get_by_role("button", name="Check", exact=True).click()
        page.get_by_text("In 12 worlds it turned its back").wait_for()
        expect(page.get_by_alt_text("the episode")).to_have_count(0)
        if shots:
            page.screenshot(path=Path(shots) / "sliders_check.png")
        page.context.close()
    assert ProgressFile(tmp_path).entries()["05.2"].code.endswith(": left=1, right=0")
