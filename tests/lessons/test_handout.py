"""Handing out lessons never overwrites a student's work."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ai4u_edu.base.errors import SetupError
from ai4u_edu.cli.lessons import lab
from ai4u_edu.cli.main import app
from ai4u_edu.lessons import handout
from ai4u_edu.lessons.course import lessons
from ai4u_edu.lessons.handout import hand_out
from ai4u_edu.lessons.notebook import dumps
from ai4u_edu.locale import PSEUDO

NAMES = [f"{lesson.name}.ipynb" for lesson in lessons()]


def test_all_notebooks_are_handed_out_and_no_solution(tmp_path: Path) -> None:
    folder = tmp_path / "a class" / "ann"
    done = hand_out(folder)
    assert (done.new, done.kept, done.beside) == (NAMES, [], [])
    seen = {path.name for path in folder.iterdir()}
    assert seen == {*NAMES, ".ai4u-edu", "pictures", "GLOSSARY.md"}
    everything = "".join(path.read_text() for path in folder.glob("*.ipynb"))
    assert "solution" in everything
    assert not list(folder.rglob("answers"))


def test_the_glossary_is_handed_out_in_the_language_of_the_notebooks(tmp_path: Path) -> None:
    hand_out(tmp_path, PSEUDO)
    assert "# Glossary" not in (tmp_path / "GLOSSARY.md").read_text(encoding="utf-8")
    hand_out(tmp_path)
    assert (tmp_path / "GLOSSARY.md").read_text(encoding="utf-8").startswith("# Glossary\n")


def test_words_of_the_glossary_are_in_the_order_of_its_language(tmp_path: Path) -> None:
    hand_out(tmp_path, "pt_BR")
    lines = (tmp_path / "GLOSSARY.md").read_text(encoding="utf-8").splitlines()
    words = [line.split("**")[1] for line in lines if line.startswith("- ")]
    assert words[:2] == ["ação", "adversário"]
    assert words.index("épsilon") + 1 == words.index("erro padrão")


def test_a_second_time_everything_stays(tmp_path: Path) -> None:
    hand_out(tmp_path)
    mine = tmp_path / NAMES[1]
    mine.write_text("mine")
    (tmp_path / NAMES[2]).unlink()
    done = hand_out(tmp_path)
    assert mine.read_text() == "mine"
    assert (done.new, done.kept, done.beside) == ([NAMES[2]], [NAMES[0], NAMES[1], *NAMES[3:]], [])


def test_a_newer_notebook_is_put_beside_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    hand_out(tmp_path)
    mine = tmp_path / NAMES[0]
    mine.write_text("mine")
    newer = dumps(lessons()[0].cells[:-1])
    monkeypatch.setattr(handout, "dumps", lambda cells: newer)
    beside = "00_start_here.new.ipynb"
    assert hand_out(tmp_path).beside[0] == beside
    assert mine.read_text() == "mine"
    assert (tmp_path / beside).read_text() == newer
    assert hand_out(tmp_path).beside == []


@pytest.mark.parametrize("book", ["", "[]", "nonsense"])
def test_a_damaged_book_changes_no_notebook(tmp_path: Path, book: str) -> None:
    hand_out(tmp_path)
    (tmp_path / NAMES[0]).write_text("mine")
    (tmp_path / ".ai4u-edu" / "handed-out.json").write_text(book)
    assert hand_out(tmp_path).new == []
    assert (tmp_path / NAMES[0]).read_text() == "mine"


def test_a_folder_that_is_a_file_is_told(tmp_path: Path) -> None:
    (tmp_path / "course").write_text("")
    with pytest.raises(SetupError, match=r"expected to write into .*course, and couldn't"):
        hand_out(tmp_path / "course")


def test_the_command_says_what_became_of_each(tmp_path: Path) -> None:
    runner = CliRunner()
    command = ["lessons", str(tmp_path / "course"), "--copy-only"]
    assert f"{len(NAMES)} new notebooks in " in runner.invoke(app, command).output
    again = runner.invoke(app, command).output
    assert f"{len(NAMES)} were there already and are kept" in again


def test_without_jupyterlab_the_command_says_how_to_get_it(tmp_path: Path) -> None:
    hidden = (
        "import sys; sys.modules['jupyterlab'] = None;from ai4u_edu.cli.main import main; main()"
    )
    done = subprocess.run(
        [sys.executable, "-c", hidden, "lessons", "course"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert 'pip install "ai4u-edu[lessons]"' in done.stderr
    assert not (tmp_path / "course").exists()


def test_jupyterlab_begins_with_lesson_00_and_asks_for_no_news(tmp_path: Path) -> None:
    command = lab(tmp_path, 8899, open_page=False)
    assert command[3] == str(tmp_path / "00_start_here.ipynb")
    assert {"--port=8899", "--ServerApp.open_browser=False"} <= set(command)
    hand_out(tmp_path)
    page = json.loads((handout.lab_config(tmp_path) / "labconfig" / "page_config.json").read_text())
    assert page["disabledExtensions"]["@jupyterlab/apputils-extension:announcements"]
