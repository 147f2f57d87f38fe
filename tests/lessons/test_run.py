"""All lessons run from top to bottom, with the solutions and unfinished; some in a real kernel."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu.lessons.course import lesson, lessons
from tests.lessons.kernel import executed
from tests.lessons.workbook import solution_of

pytestmark = pytest.mark.needs("lessons", "train")

ROOT = Path(__file__).resolve().parent.parent.parent
ALL = [each.number for each in lessons()]
IN_KERNEL = ["00"]
"""Lessons that run in a real kernel each time.

To start a kernel takes longer than most lessons do, so the others run as scripts."""
LONG = ["10", "11", "14", "16"]
"""Lessons that train, or play many matches. 14 runs unfinished, too."""
UNFINISHED = ["00", "07"]
"""Lessons that run unfinished each time: one of each kind. What their checks say of unfinished work
is tested for all exercises."""
SOLVED = ["03", "15"]
"""Lessons that run solved each time: an agent of blocks, a script elsewhere. Whether each
solution passes its check is tested for all exercises."""


def ran(folder: Path, numbers: list[str], *options: str) -> dict[str, Any]:
    """Run lessons as scripts in one process, and return what came of each."""
    done = subprocess.run(
        [sys.executable, "-m", "tests.lessons.run_lessons", *options, str(folder), *numbers],
        cwd=ROOT,
        env={**os.environ, "AI4U_FAST": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    told: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    assert {number: told[number]["error"] for number in numbers if told[number]["error"]} == {}
    return told


@pytest.mark.parametrize(
    "numbers",
    [
        UNFINISHED,
        pytest.param([each for each in ALL if each not in UNFINISHED], marks=pytest.mark.nightly),
    ],
    ids=" ".join,
)
def test_unfinished_they_run_to_the_end_and_every_check_says_not_yet(
    numbers: list[str], tmp_path: Path
) -> None:
    told = ran(tmp_path, numbers)
    for number in numbers:
        exercises = lesson(number).exercises
        passed = {name: entry["passed"] for name, entry in told[number]["entries"].items()}
        assert passed == dict.fromkeys(exercises, False)
        assert told[number]["words"].count("Not yet.") == len(exercises)


@pytest.mark.parametrize(
    "numbers",
    [
        SOLVED,
        pytest.param(
            [each for each in ALL if each not in {*SOLVED, *IN_KERNEL, *LONG}],
            marks=pytest.mark.nightly,
        ),
        pytest.param([each for each in LONG if each not in IN_KERNEL], marks=pytest.mark.nightly),
    ],
    ids=" ".join,
)
def test_solved_they_run_as_scripts_and_every_check_passes(
    numbers: list[str], tmp_path: Path
) -> None:
    told = ran(tmp_path, numbers, "--solved")
    for number in numbers:
        entries = told[number]["entries"]
        assert {name: each["text"] for name, each in entries.items() if not each["passed"]} == {}
        assert sorted(entries) == sorted(lesson(number).exercises)


@pytest.mark.parametrize(
    "number",
    [pytest.param(each, marks=[] if each in IN_KERNEL else [pytest.mark.nightly]) for each in ALL],
)
def test_solved_it_runs_in_a_kernel_and_every_check_passes(
    number: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("AI4U_FAST", "1")
    one = lesson(number)
    done = executed(one, tmp_path)
    assert {name: entry.text for name, entry in done.entries.items() if not entry.passed} == {}
    assert sorted(done.entries) == sorted(one.exercises)
    assert done.complaints == []
    kept = {name: entry.code for name, entry in done.entries.items()}
    assert kept == {each: solution_of(each) for each in one.exercises}
