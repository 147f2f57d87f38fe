"""``--lang``: the language of help, answers and notebooks."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from ai4u_edu.cli.main import help_texts
from ai4u_edu.locale import LANGUAGES, PSEUDO, Catalogue, gettext
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.slow


def run(*words: str, **variables: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "COLUMNS": "500", "NO_COLOR": "1", **variables}
    return subprocess.run(
        [sys.executable, "-m", "ai4u_edu", *words],
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=LIMIT_S,
        env={**environment, "PYTHONIOENCODING": "utf-8"},
    )


def test_all_of_the_help_is_translated_wherever_the_option_stands() -> None:
    before, after = run("--lang", PSEUDO, "scenes", "-h"), run("scenes", f"--lang={PSEUDO}", "-h")
    assert before.stdout == after.stdout
    english = "List the scenes of the library with goal, controls and rewards, or draw them."
    assert english in help_texts()
    assert english not in before.stdout
    assert Catalogue(PSEUDO).message(english) in before.stdout


def test_the_environment_chooses_a_language() -> None:
    assert "Mostrar a versão." in run("-h", LANG="pt_BR.UTF-8").stdout
    assert "Mostrar a versão." not in run("-h", LANG="pt_BR.UTF-8", AI4U_LANG="en").stdout


def test_an_unknown_language_is_refused() -> None:
    done = run("scenes", "--lang", "klingon")
    assert done.returncode == 1
    assert f"--lang: expected one of {', '.join(LANGUAGES)}, got 'klingon'" in done.stderr


def test_notebooks_are_written_in_a_language_that_their_checks_keep(tmp_path: Path) -> None:
    done = run("lessons", str(tmp_path), "--copy-only", "--lang", "pt-br")
    assert "cadernos novos em" in done.stdout
    notebook = json.loads((tmp_path / "02_drive.ipynb").read_text(encoding="utf-8"))
    (setup,) = (cell for cell in notebook["cells"] if "setup" in cell["metadata"].get("tags", ()))
    assert "set_language('pt_BR')" in "".join(setup["source"])


def test_an_error_of_a_scene_file_is_in_the_language(tmp_path: Path) -> None:
    file = tmp_path / "broken.yaml"
    file.write_text("name: test\nbodys: []\n")
    done = run("check", str(file), "--lang", PSEUDO)
    assert done.returncode == 1
    assert "úńkńówń páŕámétéŕ" in done.stderr


def test_a_refusal_has_the_usage_and_the_status_of_one() -> None:
    done = run("plya", LANG="pt_BR.UTF-8")
    assert done.returncode == 2
    assert "Uso: " in done.stderr
    assert "Você quis dizer 'play', 'replay'?" in done.stderr


def test_errors_are_said_in_the_language(tmp_path: Path) -> None:
    done = run("tournament", "verify", "--lang", PSEUDO)
    english = "expected one folder: ai4u-edu tournament verify FOLDER"
    assert done.returncode == 1
    assert english not in done.stderr
    assert Catalogue(PSEUDO).translate(gettext(english)) in done.stderr
    done = run("class", "--rooms", "two", "--folder", str(tmp_path), "--lang", PSEUDO)
    assert done.returncode == 1
    assert "expected each, pairs" not in done.stderr
    assert "'two'" in done.stderr
