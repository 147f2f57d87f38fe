"""Tiers leave out tests by their marks, orders can be drawn, and `--fast` needs one extra alone."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.__main__ import machine, workers
from tests.tiers import ROOT, marks_of_file

pytestmark = pytest.mark.slow
FILES = {
    "test_plain.py": "def test_one(): pass\ndef test_two(): pass\ndef test_three(): pass\n",
    "test_marked.py": "import pytest\nimport no_such_package\n"
    "pytestmark = pytest.mark.needs('train')\ndef test_trains(): pass\n",
    "test_later.py": "import pytest\n@pytest.mark.nightly\ndef test_long(): pass\n"
    "@pytest.mark.slow\ndef test_slow(): pass\n",
    "helper.py": "import no_such_package\n",
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


def collected(folder: Path, *options: str) -> list[str]:
    """Return the names of the tests that pytest would run in a folder, in their order."""
    conftest = f"--confcutdir={ROOT} -p tests.conftest".split()
    command = [sys.executable, "-m", "pytest", *conftest, f"-c{ROOT / 'pyproject.toml'}"]
    command += ["--collect-only", "-q", "-n0", *options, str(folder)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
    return [line.rpartition("::")[2] for line in done.stdout.splitlines() if "::" in line]


def test_fast_imports_no_file_that_needs_another_package(folder: Path) -> None:
    assert sorted(collected(folder, "--fast")) == ["test_one", "test_three", "test_two"]


def test_nightly_tests_run_in_the_nightly_tier_alone(folder: Path) -> None:
    (folder / "test_marked.py").unlink()
    plain = ["test_one", "test_slow", "test_three", "test_two"]
    assert sorted(collected(folder)) == plain
    assert sorted(collected(folder, "--nightly")) == sorted([*plain, "test_long"])


def test_seed_draws_the_same_order_each_time(folder: Path) -> None:
    (folder / "test_marked.py").unlink()
    drawn = collected(folder, "--seed", "1")
    assert drawn != (usual := collected(folder))
    assert sorted(drawn) == sorted(usual)
    assert collected(folder, "--seed", "1") == drawn


def test_fast_refuses_packages_of_other_extras(folder: Path) -> None:
    (folder / "test_plain.py").write_text("import sphinx\ndef test_one(): pass\n")
    with pytest.raises(AssertionError, match=r"No module named 'sphinx'"):
        collected(folder, "--fast")


def test_marks_of_a_file_are_read_in_all_their_forms() -> None:
    one, several = "pytestmark = pytest.mark.slow\n", "pytestmark = [\n    pytest.mark.slow,\n]\n"
    assert marks_of_file("import pytest\n\n" + one) == marks_of_file(several) == {"slow"}
    assert marks_of_file("def f():\n    " + one) == set()


@pytest.mark.nightly
def test_fast_passes_in_an_environment_made_from_nothing(tmp_path: Path) -> None:
    clone = tmp_path / "clone"
    subprocess.run(["git", "clone", "--quiet", str(ROOT), str(clone)], check=True)
    python = Path(sys.base_prefix) / "bin" / "python3"
    command = [str(python), "-m", "tests", "--fast"]
    done = subprocess.run(command, cwd=clone, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-5000:]


@pytest.mark.parametrize(
    ("cores", "memory_gb", "count"),
    [(1, 8.0, 2), (2, 24.0, 4), (8, 8.0, 4), (64, 256.0, 16), (4, 1.0, 1), (4, float("inf"), 8)],
)
def test_as_many_processes_run_tests_as_the_machine_has_room_for(
    cores: int, memory_gb: float, count: int
) -> None:
    assert workers(cores, memory_gb) == count


def test_this_machine_is_known() -> None:
    cores, memory_gb = machine()
    assert cores >= 1
    assert memory_gb > 0.5
