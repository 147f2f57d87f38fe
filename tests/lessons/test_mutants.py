"""Wrong answers pass no check, although they are made of the solution.

Small edits are tried where there is one right answer only: elsewhere other numbers may be right
too, as a robot may turn faster, or rest longer. Answers by the clock, constants and tables of what
the messages say are tried everywhere.
"""

from pathlib import Path

import numpy as np
import pytest

from ai4u_edu.lessons.exercises import lesson_06, lesson_09
from tests.lessons import by_the_clock, tables
from tests.lessons.mutants import mutants_of, survivors

pytestmark = pytest.mark.needs("lessons", "train")

EXACT = (
    "02.1",
    "02.2",
    "03.1",
    "05.1",
    "05.2",
    "08.1",
    "10.1",
    "10.2",
    "11.3",
    "12.1",
    "12.3",
    "18.1",
    "18.2",
    "14.2",
    "13.2",
    "13.3",
    "17.1",
    "17.2",
    "21.3",
)
SAMPLE = ("02.1", "18.1")
CASES = [pytest.param(each, marks=[] if each in SAMPLE else pytest.mark.nightly) for each in EXACT]


TRIES, NIGHTLY_TRIES = 4, 30
"""Schedules that are tried for each reading; a few by default, where the check is quick."""
CLOCK_SAMPLE = ("05.1", "06.3")
CLOCK_CASES = [
    *(pytest.param(each, TRIES) for each in CLOCK_SAMPLE),
    *(
        pytest.param(each, NIGHTLY_TRIES, marks=pytest.mark.nightly)
        for each in by_the_clock.drivers()
    ),
]
TABLE_SAMPLE = ("01.4", "09.4", "10.5", "17.1")
TABLE_CASES = [
    pytest.param(each, marks=[] if each in TABLE_SAMPLE else pytest.mark.nightly)
    for each in tables.exercises()
]


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("AI4U_FAST", "1")


@pytest.mark.parametrize("exercise", CASES)
def test_no_edit_of_the_solution_passes(exercise: str) -> None:
    assert survivors(exercise) == []


@pytest.mark.parametrize(("exercise", "tries"), CLOCK_CASES)
def test_no_driver_by_the_clock_passes(exercise: str, tries: int) -> None:
    assert by_the_clock.survivor(exercise, tries) == ""


@pytest.mark.parametrize("exercise", TABLE_CASES)
def test_no_constant_and_no_table_passes(exercise: str) -> None:
    assert tables.survivors(exercise) == []


@pytest.mark.nightly  # the search tries some hundred schedules
def test_the_search_finds_a_schedule_where_a_check_lets_robots_push(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(lesson_06, "MAX_BUMP_DECISIONS", 1000)
    assert by_the_clock.survivor("06.3", 300) != ""


def test_a_table_passes_where_a_check_asks_the_same_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lesson_09, "chance_for", lambda *_: np.random.default_rng(0))
    assert tables.survivors("09.4") != []


def test_an_edit_changes_one_thing() -> None:
    names = [each.name for each in mutants_of("def f(x):\n    return x * 2")]
    assert names == ["line 2: Mult to Div", "line 2: 2 to -2", "line 2: 2 to 6"]
