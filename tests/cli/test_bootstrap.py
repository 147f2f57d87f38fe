"""Setting up a checkout: real environments, made from a tiny project that needs no network."""

import ast
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from ai4u_edu import bootstrap
from tests.tiny_checkout import CLI, PYPROJECT, REPO, make_checkout, make_wheel

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A checkout that was set up once; the tests damage it and have it mended."""
    root = make_checkout(tmp_path_factory.mktemp("made"))
    bootstrap.ensure(root, ["dev"])
    return root


def builds(root: Path) -> int:
    return (root / "builds.log").read_text().count("built")


def run_cli(root: Path, *args: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "ai4u_edu", *args]
    return subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)


def test_a_second_call_does_not_run_pip(made: Path) -> None:
    python = bootstrap.ensure(made, ["dev"])
    before = builds(made)
    assert bootstrap.ensure(made, ["dev"]) == python
    assert bootstrap.ensure(made) == python, "what is asked for is there, and more"
    assert builds(made) == before
    subprocess.run([python, "-c", "import some_dependency"], check=True)


def test_changes_are_installed_and_extras_add_up(made: Path) -> None:
    bootstrap.ensure(made, ["dev"])
    before = builds(made)
    bootstrap.ensure(made, ["train"])
    assert builds(made) == before + 1
    (made / "pyproject.toml").write_text(PYPROJECT + "# changed\n")
    bootstrap.ensure(made)
    assert builds(made) == before + 2
    stamp = json.loads((made / ".venv" / "ai4u-edu.json").read_text())
    assert stamp["extras"] == ["dev", "train"]


@pytest.mark.nightly
def test_a_known_torch_is_brought_first_where_it_can_be_had(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = make_checkout(tmp_path / "checkout")
    (root / "pyproject.toml").write_text(PYPROJECT + '# train = ["torch>=2.6"]\n')
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    bootstrap.ensure(root, ["train"])  # there is none to be had, and all goes on
    assert builds(root) == 1

    wheels = tmp_path / "wheels"
    make_wheel(wheels, "torch", bootstrap.TORCH.partition("==")[2])
    monkeypatch.setenv("PIP_FIND_LINKS", str(wheels))
    python = bootstrap.ensure(root, ["dev"])
    subprocess.run([python, "-c", "import torch"], check=True)


@pytest.mark.nightly
def test_an_environment_without_stamp_and_pip_is_kept_and_completed(made: Path) -> None:
    venv = made / ".venv"
    mine = venv / "mine.txt"
    mine.touch()
    (venv / "ai4u-edu.json").unlink()
    for pip in list(venv.glob("lib/**/site-packages/pip*")):
        shutil.rmtree(pip)
    before = builds(made)
    bootstrap.ensure(made)
    assert builds(made) == before + 1
    assert mine.exists()


@pytest.mark.nightly
def test_an_environment_whose_python_is_gone_is_made_anew(made: Path) -> None:
    python = bootstrap.ensure(made)
    python.unlink()
    python.symlink_to("gone")
    bootstrap.ensure(made)
    subprocess.run([python, "-c", "import some_dependency"], check=True)


def test_the_command_line_restarts_inside_the_environment(made: Path) -> None:
    done = run_cli(made, "play", "--seed", "3")
    assert done.stdout.split() == [str(made / ".venv"), "play", "--seed", "3"], done.stderr


def test_what_is_missing_even_inside_is_named_once(made: Path) -> None:
    cli = made / "ai4u_edu" / "cli" / "main.py"
    cli.write_text("import absent_module.part")
    done = run_cli(made)
    cli.write_text(CLI)
    assert done.returncode == 1
    assert done.stderr.splitlines()[-2:] == [
        f"The module absent_module is missing even in {made / '.venv'}.",
        "Delete .venv, then run the same command again.",
    ]


def test_outside_a_checkout_the_missing_module_is_named(tmp_path: Path) -> None:
    root = make_checkout(tmp_path)
    (root / "pyproject.toml").unlink()
    done = run_cli(root)
    assert (done.returncode, done.stderr.splitlines()) == (
        1,
        [
            f"AI4U Edu needs the module some_dependency, and {sys.executable} doesn't have it.",
            "Mend it with: pip install ai4u-edu",
        ],
    )


def test_a_declared_dependency_that_is_imported_late_counts_too(tmp_path: Path) -> None:
    root = make_checkout(tmp_path)
    (root / "ai4u_edu" / "cli" / "main.py").write_text("def main(): print('ran')")
    declared = 'dependencies = ["surely-absent>=1"]\n'
    (root / "pyproject.toml").write_text(PYPROJECT + declared)
    (root / ".venv").touch()
    done = run_cli(root)
    assert "ran" not in done.stdout
    assert done.stderr.splitlines()[-1].startswith("Move AI4U Edu into a folder of your own.")


def test_an_import_error_of_our_own_is_not_hidden(tmp_path: Path) -> None:
    root = make_checkout(tmp_path)
    (root / "ai4u_edu" / "cli" / "main.py").write_text("import ai4u_edu.forgotten")
    assert "No module named 'ai4u_edu.forgotten'" in run_cli(root).stderr
    assert not (root / ".venv").exists()


def message(root: Path) -> str:
    with pytest.raises(bootstrap.InstallError) as caught:
        bootstrap.ensure(root)
    return str(caught.value)


def test_an_old_python_is_told_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "version_info", (3, 9, 6, "final", 0))
    assert message(make_checkout(tmp_path)) == (
        f"AI4U Edu needs Python 3.11 or newer; this is Python 3.9.6 ({sys.executable}).\n"
        "Install a newer one (python.org has them for every system), then run the same command "
        "with it, for example with `python3.12` in place of `python3`."
    )


def test_missing_ensurepip_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root = make_checkout(tmp_path)
    (root / "ensurepip.py").write_text("raise ImportError")
    monkeypatch.setenv("PYTHONPATH", str(root))
    assert message(root) == (
        f"Expected Python's own modules venv and ensurepip, and {sys.executable} comes without "
        "them.\nOn Debian and Ubuntu: sudo apt install python3-venv\n"
        "Elsewhere: install Python from python.org. Then run the same command again."
    )


def test_a_folder_without_our_project_is_refused(tmp_path: Path) -> None:
    assert message(tmp_path) == (
        f"Expected AI4U Edu's pyproject.toml in {tmp_path}, and it isn't there.\n"
        "Run the command in the folder that `git clone` made."
    )


@pytest.mark.parametrize("language", ["pt_BR", "pt", "pt-br", "pt_BR.UTF-8"])
def test_the_setup_speaks_the_language_of_the_terminal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, language: str
) -> None:
    monkeypatch.setenv("AI4U_LANG", language)
    assert message(tmp_path).startswith(f"Era esperado o pyproject.toml do AI4U Edu em {tmp_path},")
    monkeypatch.setattr(sys, "argv", ["ai4u_edu", "--lang", "en", "play"])
    assert message(tmp_path).startswith("Expected AI4U Edu's pyproject.toml")


def test_a_failing_pip_is_quoted_and_tried_again(made: Path) -> None:
    (made / "pyproject.toml").write_text(PYPROJECT.replace('"backend"', '"broken"'))
    for _ in range(2):
        text = message(made)
        assert text.startswith("pip couldn't install AI4U Edu's packages.\n  ")
        assert "broken" in text
        assert text.endswith("If that doesn't help, delete .venv first.")
    (made / "pyproject.toml").write_text(PYPROJECT)


@pytest.mark.parametrize(
    "path",
    [
        "ai4u_edu/__init__.py",
        "ai4u_edu/__main__.py",
        "ai4u_edu/base/version.py",
        "ai4u_edu/bootstrap.py",
        "tests/__main__.py",
        "tests/setup_browser.py",
    ],
)
def test_an_old_python_can_read_what_tells_it_that_it_is_old(path: str) -> None:
    source = (REPO / path).read_text(encoding="utf-8")
    ast.parse(source, feature_version=(3, 8))
    assert not re.search(
        r"^(from|import) (tomllib|ai4u_edu\.(?!bootstrap|base\.version))", source, re.MULTILINE
    )
