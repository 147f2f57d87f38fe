"""No small edit of a solution passes where there is one right answer only.

Elsewhere other numbers may be right too: a robot may turn faster, or rest longer.
"""

from pathlib import Path

import pytest

from tests.lessons.mutants import mutants_of, survivors

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
)
SAMPLE = ("02.1", "18.1")
CASES = [pytest.param(each, marks=[] if each in SAMPLE else pytest.mark.nightly) for each in EXACT]


@pytest.mark.parametrize("exercise", CASES)
def test_no_edit_of_the_solution_passes(
    exercise: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("AI4U_FAST", "1")
    assert survivors(exercise) == []


def test_an_edit_changes_one_thing() -> None:
    names = [each.name for each in mutants_of("def f(x):\n    return x * 2")]
    assert names == ["line 2: Mult to Div", "line 2: 2 to -2", "line 2: 2 to 6"]
