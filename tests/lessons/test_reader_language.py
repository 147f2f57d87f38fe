"""Checks in the language of a notebook; what is saved is English."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu import RBMoveActuator, Scene
from ai4u_edu.base.errors import ParameterError, SceneError, text_of
from ai4u_edu.lessons import check, hint, progress, report, solution
from ai4u_edu.lessons.progress_file import ProgressFile
from ai4u_edu.locale import VARIABLE, reader, set_language


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def stay(percept: Any) -> Any:
    return {"move": [0, 0, 0, 0]}


def test_a_check_speaks_portuguese_and_saves_english(capsys: pytest.CaptureFixture[str]) -> None:
    with reader("pt_BR"):
        check("00.1", stay)
        hint("00.1")
        progress()
    out = capsys.readouterr().out
    assert "Ainda não. " in out
    assert "semente" in out
    assert "Dica. " in out
    assert "Progresso. " in out
    assert "Not yet" not in out
    assert "Start here" not in out
    assert ProgressFile().entries()["00.1"].text.startswith("Your robot hardly moved")


def test_a_mistake_in_a_scene_is_told_in_portuguese(capsys: pytest.CaptureFixture[str]) -> None:
    with reader("pt_BR"):
        check("20.1", "name: meu mundo\nbodys: []\n")
    out = capsys.readouterr().out
    assert "bodys: parâmetro desconhecido; você quis dizer 'bodies'?" in out
    assert "unknown" not in out


@pytest.fixture
def _portuguese(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setenv(VARIABLE, "en")  # so that it is as before afterwards
    set_language("pt_BR")
    yield
    set_language("en")  # as if nothing had been chosen


@pytest.mark.usefixtures("_portuguese")
def test_a_notebook_prints_errors_in_its_language(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SceneError, match="você quis dizer 'box_chase'"):
        Scene.load("box_chas")
    with pytest.raises(ParameterError, match="parâmetro desconhecido") as caught:
        RBMoveActuator(move_amuont=1)  # type: ignore[call-arg]  # the mistake under test
    assert "unknown parameter" in text_of(caught.value), "as a text it can still be compared"
    check("00.1", lambda _percept: {"mov": [0, 0, 0, 0]})
    check("00.1", lambda _percept: None)  # what is wrong is found by an error's words
    out = capsys.readouterr().out
    assert "o agente '0' não tem o atuador 'mov'; você quis dizer 'move'?" in out
    assert "não devolveu nada" in out


@pytest.mark.usefixtures("_portuguese")
def test_a_program_that_a_notebook_starts_has_its_language() -> None:
    command = [sys.executable, "-m", "ai4u_edu", "check", "box_chas"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert "você quis dizer 'box_chase'" in done.stderr


def test_a_report_is_written_in_portuguese(tmp_path: Path) -> None:
    check("00.1", stay)
    with reader("pt_BR"):
        report("Ana")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "Ana" in page
    assert "ainda não" in page
    assert "not yet" not in page


def test_comments_of_a_solution_are_translated(capsys: pytest.CaptureFixture[str]) -> None:
    solution("03.5")
    assert "# its back to the box" in capsys.readouterr().out
    with reader("pt_BR"):
        solution("03.5")
    translated = capsys.readouterr().out
    assert "its back to the box" not in translated
    assert 'return {"move": [-1, side, 0, 0]}  # de costas' in translated
