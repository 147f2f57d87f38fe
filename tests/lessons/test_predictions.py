"""A guess before a result: it is saved, compared, and shown in the report."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons import compare, notebook_output, predict
from ai4u_edu.lessons import predictions as module
from ai4u_edu.lessons.collecting import collect
from ai4u_edu.lessons.prediction_values import Prediction
from ai4u_edu.lessons.predictions import GUESS_FIRST, NO_GUESS
from ai4u_edu.lessons.progress_file import FILE, ProgressFile
from ai4u_edu.lessons.report_page import page as report_page


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    ("guess", "actual", "words"),
    [
        (5, 7, "You said 5. It is 7. Difference: 2 too low."),
        (0.5, np.float64(0.25), "You said 0.5. It is 0.25. Difference: 0.25 too high."),
        (3, 3.0, "You said 3. It is 3. Difference: none."),
        ("5", 7, "You said 5. It is 7. Difference: 2 too low."),
        (" Left", "left", "You said Left. It is left. Difference: none."),
        ("left", "right", "You said left. It is right."),
        ("left", 7, "You said left. It is 7."),
        (True, False, "You said True. It is False."),
        (
            [1, "up"],
            np.array([2.5, 3.0]),
            "You said 1. It is 2.5. Difference: 1.5 too low.\nYou said up. It is 3.",
        ),
        ([1], [1, 2], "You said 1. It is 1. Difference: none.\nYou said \u2013. It is 2."),
        (10**400, float("nan"), "You said inf. It is nan."),
        ("nan", 7, "You said nan. It is 7."),
        (10_000, 12_548, "You said 10000. It is 12548. Difference: 2548 too low."),
        (2, {"a": 2}, "You said 2. It is 2. Difference: none."),
    ],
)
def test_both_are_shown_side_by_side(
    guess: Any, actual: Any, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    predict("09.1", guess)
    assert capsys.readouterr().out.startswith("You said ")
    compare("09.1", actual)
    assert capsys.readouterr().out == words + "\n"
    assert json.loads(Path(FILE).read_text())["predictions"]["09.1"]["guess"] is not None


@pytest.mark.parametrize("guess", [..., None, "", " ... ", [], [1, ...], {"a": ...}])
def test_a_placeholder_is_no_guess_and_compare_still_works(
    guess: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    predict("09.1", guess)
    assert capsys.readouterr().out == f"No guess yet. {GUESS_FIRST}\n"
    compare("09.1", 7)
    assert capsys.readouterr().out == f"It is 7.\n{NO_GUESS}\n"
    assert ProgressFile().predictions() == {}


def test_another_guess_replaces_the_first_and_its_result() -> None:
    predict("09.first", 5)
    compare("09.first", 7)
    predict("09.first", 5)
    assert ProgressFile().predictions() == {"09.first": Prediction(5.0, 7.0)}
    predict("09.first", 6)
    assert ProgressFile().predictions() == {"09.first": Prediction(6.0)}


@pytest.mark.parametrize("name", ["7", "07", "7.1", "07.", "07.a b", 7.1, None])
def test_another_form_of_the_id_is_told(name: Any) -> None:
    for call in (predict, compare):
        with pytest.raises(SetupError, match=r"in quotes, such as '09\.1', got"):
            call(name, 1)


def test_exercises_and_predictions_keep_each_other() -> None:
    progress = ProgressFile()
    predict("00.1", "left")
    progress.note("00.1", passed=True, text="Done.", diagnosis="", picture=b"")
    predict("00.2", 3)
    assert set(progress.predictions()) == {"00.1", "00.2"}
    assert progress.entries()["00.1"].passed


@pytest.mark.parametrize(
    "plain", [None, [], 7, {"09.1": 7}, {"09.1": {}}, {"09.1": {"guess": None, "actual": 1}}]
)
def test_predictions_that_cannot_be_read_cost_no_exercise(plain: Any) -> None:
    progress = ProgressFile()
    progress.note("00.1", passed=True, text="Done.", diagnosis="", picture=b"")
    data = json.loads(progress.path.read_text())
    progress.path.write_text(json.dumps({**data, "predictions": plain}))
    assert progress.predictions() == {}
    assert progress.entries()["00.1"].passed
    assert not progress.trouble


def test_the_report_shows_them_escaped_and_the_class_table_does_not(folder: Path) -> None:
    predict("09.1", "<b>left")
    compare("09.1", [1, 2])
    predict("09.2", 4)
    text = report_page(ProgressFile())
    assert "<li>09.1: said &lt;b&gt;left; it was 1, 2</li>\n<li>09.2: said 4</li>" in text
    assert "09 Rewards" in text
    collected = collect(folder)
    assert "left</td>" not in collected.page()
    assert "09.1" not in collected.page() + collected.table()


def test_in_a_notebook_they_are_a_table(monkeypatch: pytest.MonkeyPatch) -> None:
    pages: list[str] = []
    for each in (module, notebook_output):
        monkeypatch.setattr(each, "put", lambda page, words: pages.append(page))
    predict("09.1", "<b>")
    compare("09.1", 5)
    assert "&lt;b&gt;" in pages[0]
    assert "<td>&lt;b&gt;</td><td>5</td><td></td>" in pages[1]
