"""Feedback of an exercise's check, and the progress that is saved."""

import json
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons import check, checking, hint, progress, progress_file, solution
from ai4u_edu.lessons.checking import UNFINISHED, judge
from ai4u_edu.lessons.exercise import EXERCISES, Exercise, find
from ai4u_edu.lessons.notebook import Cell
from ai4u_edu.lessons.progress_file import FILE, ProgressFile
from tests.lessons.workbook import run
from tests.waiting import LIMIT_S


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def go(percept: Any) -> Any:
    return {"move": [1, 0, 0, 0]}


def stay(percept: Any) -> Any:
    return {"move": [0, 0, 0, 0]}


def written(source: str) -> Any:
    """A function as typed into a cell."""
    names: dict[str, Any] = {}
    run(Cell(source), names, "<a cell>")
    return names["go"]


def test_what_was_right_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    check("00.1", go)
    assert "Right. Your robot drives forward. It did so in 12 worlds." in capsys.readouterr().out


def test_what_happened_is_said_with_seed_step_picture_and_where_to_get_help(
    capsys: pytest.CaptureFixture[str], folder: Path
) -> None:
    check("00.1", stay)
    told = capsys.readouterr().out
    assert "Not yet. Your robot hardly moved (seed " in told
    assert ", step 8).\n" in told
    assert 'hint("00.1")' in told
    assert ProgressFile().picture("00.1").read_bytes().startswith(b"\x89PNG")


def test_an_ellipsis_is_unfinished_and_none_is_said_to_be_none() -> None:
    assert judge(find("00.1"), ...).text == UNFINISHED
    assert "None: nothing" in judge(find("00.1"), None).text
    assert judge(find("00.1")).text == UNFINISHED


def test_the_students_exception_is_a_sentence_with_their_line() -> None:
    source = "def go(percept):\n    speed = 1 / 0\n    return {'move': [speed, 0, 0, 0]}"
    verdict = judge(find("00.1"), written(source))
    assert verdict.text == (
        "Your code stopped with ZeroDivisionError: division by zero (line 2 of its cell: "
        "speed = 1 / 0)."
    )
    assert not verdict.passed


def test_an_action_that_nothing_can_carry_out_is_a_sentence() -> None:
    verdict = judge(find("00.1"), lambda percept: {"mov": [1, 0, 0, 0]})
    assert not verdict.passed
    assert "did you mean 'move'?" in verdict.text


@pytest.mark.parametrize("thing", [7, "go", {"move": [1, 0, 0, 0]}, [1, 0, 0, 0]])
def test_something_else_than_a_function_is_told(thing: Any) -> None:
    verdict = judge(find("00.1"), thing)
    assert verdict.text.startswith("Expected a function that gets a percept")


def test_a_fault_of_the_course_is_not_blamed_on_the_student() -> None:
    hints = {"a": "A hint."}
    verdict = judge(Exercise("99.1", "", json.loads, hints), "{" * 99)
    assert not verdict.passed
    assert verdict.text.startswith(
        "The check itself has a fault: it could not try out '{{{{{{{{{{{{...{{{{{{{{{{{{{'"
    )


def test_hints_begin_with_the_one_that_fits(capsys: pytest.CaptureFixture[str]) -> None:
    check("00.1", lambda percept: {"move": [-1, 0, 0, 0]})
    capsys.readouterr()
    hint("00.1")
    assert "drove backward" in capsys.readouterr().out
    hint("00.1")
    assert "turns at the same time" in capsys.readouterr().out


def test_a_solution_is_printed_without_the_wrong_ones(capsys: pytest.CaptureFixture[str]) -> None:
    solution("00.1")
    out = capsys.readouterr().out
    assert out == 'def go(percept):\n    return {"move": [1, 0, 0, 0]}\n'


@pytest.mark.parametrize("ask", [check, hint, solution])
def test_an_unknown_exercise_is_told(ask: Any) -> None:
    with pytest.raises(SetupError, match=r"^no exercise is called '00\.9'; did you mean '00\.\d'"):
        ask("00.9")
    with pytest.raises(SetupError, match=r"in quotes, such as '02.1', got 0\.1"):
        ask(0.1)


def test_progress_counts_and_keeps_what_was_passed(capsys: pytest.CaptureFixture[str]) -> None:
    for thing in (stay, stay, go, stay):
        check("00.1", thing)
    entry = ProgressFile().entries()["00.1"]
    assert (entry.passed, entry.tries) == (True, 3)
    assert entry.text.startswith("Your robot drives forward")
    capsys.readouterr()
    progress()
    out = capsys.readouterr().out
    assert "Progress. 1 of " in out
    assert "00 Start here: 00.1 \u2714   00.2 \u2013" in out


def test_a_file_of_the_first_course_gets_the_new_numbers(folder: Path) -> None:
    """It had 16 lessons; the third exercise of its fifth one has a lesson of its own now."""
    old = {"passed": False, "diagnosis": "05.3/begin", "diagnoses": {"05.3/begin": 2}}
    exercises = {"00.1": {"passed": True}, "03.2": {"passed": True}, "05.3": old}
    (folder / FILE).write_text(json.dumps({"version": 1, "exercises": exercises}))
    entries = ProgressFile().entries()
    assert [name for name, each in entries.items() if each.passed] == ["00.1", "04.2"]
    assert entries["07.1"].diagnosis == "07.1/begin"
    assert entries["07.1"].diagnoses == {"07.1/begin": 2}
    check("00.1", go)
    assert list(ProgressFile().entries()) == ["00.1", "04.2", "07.1"]


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[]",
        "null",
        '{"version": 3, "exercises": {}}',
        '{"version": 1}',
        '{"version": 1, "exercises": []}',
        '{"version": 1, "exercises": {"00.1": {"passed": "yes"}}}',
        '{"version": 1, "exercises": {"00.1": {"unknown": 1}}}',
        '{"version": 1, "exercises": {"00.1": 7}}',
        "\udcff",
        "[" * 100_000,
    ],
    ids=range(12),
)
def test_a_damaged_file_is_put_aside_and_said(
    folder: Path, text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / FILE).write_bytes(text.encode(errors="surrogateescape"))
    check("00.1", go)
    assert "progress.json could not be read" in capsys.readouterr().out
    assert ProgressFile().entries()["00.1"].passed
    aside = (folder / "progress.damaged.json").read_bytes()
    assert aside == text.encode(errors="surrogateescape")


def test_a_write_that_fails_leaves_the_file_as_it_was(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    check("00.1", go)
    before = (folder / FILE).read_bytes()

    def fail(*_: object, **__: object) -> None:
        raise OSError("no room")

    monkeypatch.setattr(json, "dump", fail)
    with pytest.raises(OSError, match="no room"):
        ProgressFile().note("00.2", passed=True, text="", diagnosis="", picture=b"")
    assert (folder / FILE).read_bytes() == before
    assert sorted(path.name for path in folder.iterdir() if path.name.startswith(".p")) == []


def test_every_hint_has_a_name_of_its_own() -> None:
    for each in EXERCISES.values():
        assert each.hints
        assert all(each.hints.values())


def test_the_code_that_was_checked_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    cells = ["def go(percept):\n    return 1", "%magic", "check('00.1', go)", "go = 7", "x = go"]
    monkeypatch.setattr(checking, "cells_so_far", lambda: cells[:3])
    check("00.1", go)
    assert ProgressFile().entries()["00.1"].code == cells[0]
    monkeypatch.setattr(checking, "cells_so_far", lambda: cells)
    check("00.1", go)
    assert ProgressFile().entries()["00.1"].code == "go = 7", "the last cell that defines it"


def test_kernels_that_write_at_once_lose_no_entry(folder: Path) -> None:
    code = (
        "import sys; from ai4u_edu.lessons import progress_file\n"
        f"progress_file.LOCK_TIMEOUT_S = {LIMIT_S}\n"
        "File = progress_file.ProgressFile\n"
        "for number in range(25):\n"
        "    name = f'0{sys.argv[1]}.{number}'\n"
        "    File().note(name, passed=True, text='', diagnosis='', picture=b'')\n"
        "    File().note_prediction(name, guess=1.0)\n"
    )
    kernels = [subprocess.Popen([sys.executable, "-c", code, each]) for each in ("1", "2")]
    assert [each.wait() for each in kernels] == [0, 0]
    progress = ProgressFile(folder)
    assert (len(progress.entries()), len(progress.predictions())) == (50, 50)
    assert not progress.trouble


def test_two_notebooks_that_check_at_once_both_keep_their_result(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(progress_file, "LOCK_TIMEOUT_S", LIMIT_S)
    started = threading.Barrier(8)

    def note(number: int) -> None:
        progress = ProgressFile(folder)
        started.wait()
        progress.note(f"00.{number}", passed=True, text="", diagnosis="", picture=b"")

    threads = [threading.Thread(target=note, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(ProgressFile(folder).entries()) == 8
