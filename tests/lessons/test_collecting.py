"""The table of a class, from the progress files of its students."""

import csv
import json
from pathlib import Path

import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.cli.main import app
from ai4u_edu.lessons.collecting import collect
from ai4u_edu.lessons.diagnoses import COMMON
from ai4u_edu.lessons.exercise import find
from ai4u_edu.lessons.notebook_output import marked
from ai4u_edu.lessons.progress_file import ProgressFile
from ai4u_edu.locale import reader

EVIL = "=HYPERLINK(<b>"


def hand_in(folder: Path, *, passed: bool, text: str = "Right.", diagnosis: str = "") -> None:
    folder.mkdir(parents=True, exist_ok=True)
    ProgressFile(folder).note("00.1", passed=passed, text=text, diagnosis=diagnosis, picture=b"")


@pytest.fixture
def handed_in(tmp_path: Path) -> Path:
    """Return the folder of a class of three; one of them handed in rubbish."""
    hint = next(iter(find("00.1").hints))
    hand_in(tmp_path / "ann", passed=True)
    hand_in(tmp_path / "ben", passed=False, text=EVIL, diagnosis=f"00.1/{hint}")
    hand_in(tmp_path / "ben", passed=False, text=EVIL, diagnosis=f"00.1/{hint}")
    (tmp_path / "cid.json").write_text("{]")
    return tmp_path


def test_the_command_writes_a_page_and_a_table(
    handed_in: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    app(["lessons", "--collect", str(handed_in)], standalone_mode=False)
    told = capsys.readouterr()
    assert "2 students" in told.out
    assert "cid.json is no progress file" in told.err
    rows = list(csv.DictReader((handed_in / "class.csv").read_text("utf-8").splitlines()))
    assert [(row["student"], row["passed"], row["tries"]) for row in rows] == [
        ("ann", "yes", "1"),
        ("ben", "no", "2"),
    ]
    text = (handed_in / "class.html").read_text(encoding="utf-8")
    assert '<th scope="row" title="ann">ann</th><td>1</td><td class="passed first"' in text
    assert '<th scope="row" title="ben">ben</th><td>0</td><td class="tried first"' in text
    assert ">(2)</td>" in text
    assert '<td class="count">2</td><td class="count">1</td>' in text
    assert '<p>Most often not solved yet: <a href="#exercise-00.1">00.1</a> (1).</p>' in text
    assert '<tr id="exercise-00.1">' in text
    assert "01 Drive" not in text
    assert marked(next(iter(find("00.1").hints.values()))) in text


def test_a_mistake_that_any_exercise_may_have_is_said_in_words(tmp_path: Path) -> None:
    hand_in(tmp_path / "ann", passed=False, diagnosis="any/endless")
    text = collect(tmp_path).page()
    assert marked(f"1: {COMMON['endless']}") in text


def test_the_page_is_in_the_readers_language(handed_in: Path) -> None:
    with reader("pt_BR"):
        text = collect(handed_in).page()
    assert '<html lang="pt-BR">' in text
    assert "2 estudantes." in text
    assert "<h2>Erros</h2>" in text


def test_files_are_left_as_they_are_and_can_be_collected_again(handed_in: Path) -> None:
    before = sorted(path for path in handed_in.rglob("*"))
    first = collect(handed_in)
    assert sorted(path for path in handed_in.rglob("*")) == before
    app(["lessons", "--collect", str(handed_in)], standalone_mode=False)
    assert collect(handed_in) == first


def test_nothing_in_it_is_markup_or_a_formula(handed_in: Path) -> None:
    hand_in(handed_in / "<i>x", passed=False, text=EVIL)
    collected = collect(handed_in)
    assert "<b>" not in collected.page()
    assert "<i>" not in collected.page()
    assert all(f"'{EVIL}" in line for line in collected.table().splitlines() if EVIL in line)


def test_a_file_may_be_called_after_the_student(tmp_path: Path) -> None:
    hand_in(tmp_path / "ann", passed=True)
    (tmp_path / "ann" / "progress.json").rename(tmp_path / "ann.json")
    assert set(collect(tmp_path).students) == {"ann"}


@pytest.mark.parametrize("text", ["[]", "1", json.dumps({"version": 9, "exercises": {}})])
def test_what_is_no_progress_is_said(tmp_path: Path, text: str) -> None:
    (tmp_path / "x.json").write_text(text)
    with pytest.raises(SetupError, match=r"expected files called progress\.json"):
        collect(tmp_path)


def test_a_folder_that_is_not_there_is_said(tmp_path: Path) -> None:
    with pytest.raises(SetupError, match="expected a folder"):
        collect(tmp_path / "nowhere")
