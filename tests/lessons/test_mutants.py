"""No small edit of a solution passes where there is one right answer only.

Elsewhere other numbers may be right too: a robot may turn faster, or rest longer.
"""

from pathlib import Path

import pytest

from tests.lessons.mutants import mutants_of, survivors

EXACT = (
    "01.1",
    "01.2",
    "02.1",
    "04.1",
    "04.2",
    "06.1",
    "09.1",
    "09.2",
    "10.3",
    "11.1",
    "11.3",
    "11.4",
    "13.1",
    "13.2",
)
SAMPLE = ("01.1", "13.1")
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
