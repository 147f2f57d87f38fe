"""All lessons run from top to bottom: with the solutions in a real kernel, and unfinished."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.course import Lesson, lessons
from tests.lessons.kernel import executed

ROOT = Path(__file__).resolve().parent.parent.parent
ALL = lessons()


@pytest.mark.timeout(300)
def test_unfinished_they_run_to_the_end_and_every_check_says_not_yet(tmp_path: Path) -> None:
    """In one process, in which they are run one after another."""
    numbers = [each.number for each in ALL]
    done = subprocess.run(
        [sys.executable, "-m", "tests.lessons.run_lessons", str(tmp_path), *numbers],
        cwd=ROOT,
        env={**os.environ, "AI4U_FAST": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    told: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    assert {number: told[number]["error"] for number in numbers if told[number]["error"]} == {}
    checked = {
        exercise: entry["passed"]
        for number in numbers
        for exercise, entry in told[number]["entries"].items()
    }
    assert checked == dict.fromkeys((each for one in ALL for each in one.exercises), False)
    said = {number: told[number]["words"].count("Not yet.") for number in numbers}
    assert said == {each.number: len(each.exercises) for each in ALL}


@pytest.mark.parametrize("lesson", ALL, ids=[each.number for each in ALL])
@pytest.mark.timeout(300)
def test_solved_it_runs_in_a_kernel_and_every_check_passes(
    lesson: Lesson, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("AI4U_FAST", "1")
    done = executed(lesson, tmp_path)
    assert {name: entry.text for name, entry in done.entries.items() if not entry.passed} == {}
    assert sorted(done.entries) == lesson.exercises
    assert done.complaints == []
    kept = {name: entry.code for name, entry in done.entries.items()}
    assert kept == {each: answers_to(each).solution for each in lesson.exercises}
