"""The page to hand in."""

from pathlib import Path
from typing import Any

import pytest

from ai4u_edu.lessons import check, report
from ai4u_edu.lessons.handout import hand_out
from ai4u_edu.lessons.progress_file import ProgressFile
from ai4u_edu.lessons.report_page import codes, page

EVIL = '<script>alert("x")</script>&"\''


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def go(percept: Any) -> Any:
    return {"move": [1, 0, 0, 0]}


def test_it_holds_code_result_and_picture(folder: Path) -> None:
    hand_out(folder)
    check("00.1", go)
    check("00.2", go)
    report("Ada")
    text = (folder / "report.html").read_text(encoding="utf-8")
    assert "<h1>Ada: AI4U Edu lessons</h1>" in text
    assert "<p>2 of " not in text
    assert "<p>1 of " in text
    assert "def go(percept):" in text
    assert text.count("data:image/png;base64,") == 2
    assert "Your robot left its place" in text
    assert "http" not in text.replace("http-equiv", "")


def test_everything_in_it_is_escaped(folder: Path) -> None:
    progress = ProgressFile()
    progress.note("00.1", passed=False, text=EVIL, diagnosis="", picture=b"")
    hand_out(folder)
    book = folder / "00_start_here.ipynb"
    written = "def go(percept):\\n"
    assert written in book.read_text()
    evil = EVIL.replace('"', '\\"')
    book.write_text(book.read_text().replace(written, f"def go(percept): # {evil}\\n"))
    text = page(progress, EVIL)
    assert "<script" not in text
    assert text.count("&lt;script&gt;") == 4  # title, heading, code, sentence


@pytest.mark.parametrize(
    "text", ["", "{}", "[]", '{"cells": [1]}', '{"cells": [{"metadata": []}]}']
)
def test_a_notebook_that_cannot_be_read_is_no_trouble(folder: Path, text: str) -> None:
    (folder / "x.ipynb").write_text(text)
    assert codes(folder / "x.ipynb") == {}
    assert codes(folder / "none.ipynb") == {}


def test_without_anything_it_is_empty_and_nameless(folder: Path) -> None:
    report()
    assert "<h1>AI4U Edu lessons</h1>" in (folder / "report.html").read_text(encoding="utf-8")
