"""Each exercise: the solution passes; the unfinished cell and plausible wrong answers don't."""

import ast
import math
from collections.abc import Callable
from dataclasses import replace
from decimal import Decimal
from functools import wraps
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu import BasicAgent
from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.checking import judge
from ai4u_edu.lessons.course import course_folder, exercise_ids, is_ticket, lesson, lessons
from ai4u_edu.lessons.diagnoses import COMMON
from ai4u_edu.lessons.exercise import EXERCISES, find
from tests.docs_site.lesson_pages import section
from tests.docs_site.staging import Staging
from tests.lessons.verdicts import is_as_wanted
from tests.lessons.workbook import SLOW, handed_in, tried, try_answer

pytestmark = pytest.mark.needs("lessons", "train")

ALL = exercise_ids()
IDS = [each for each in ALL if not is_ticket(each)]
"""Exercises with code to write; all choices of the others are tried in test_exit_tickets.py."""
LONG_CHECKS = ("15.1", "15.3", "16.1")
"""Exercises whose checks play episodes with whatever they get."""
JUNK = [
    *(True, 10**400, "x", [], {}, object(), int, BasicAgent(body="robot")),
    lambda *_: None,
    lambda *_: True,
    lambda *_: {"move": [1, 0, 0, 0]},
    lambda *_: 1 / 0,
    lambda: None,
    *(math.nan, math.inf, -math.inf, [math.nan, math.nan], np.full((2, 2), math.nan), "0.5"),
    lambda *_: math.nan,
    lambda *_: math.inf,
    lambda *_: -math.inf,
    lambda *_: np.float32("nan"),
    lambda *_: Decimal("nan"),
    lambda *_: 10**400,
    lambda *_: "0.5",
    lambda *_: [math.nan, math.nan],
    lambda *_: np.full(2, math.nan),
    lambda *_: {"move": [math.nan, math.inf, 0, 0]},
]
"""Answers of wrong types and values, which every check must reject without failing."""


def _is_sample(exercise: str, number: int) -> bool:
    """Return True for some answers of quick exercises and their solutions; the rest is nightly."""
    if exercise in SLOW:
        return False
    return number == 0 or (number + sum(map(ord, exercise))) % 20 == 0


def _but_slow(exercises: list[str], also: tuple[str, ...] = ()) -> list[object]:
    """Return exercises as parameters of a test; slow ones are nightly."""
    return [
        pytest.param(each, marks=[pytest.mark.nightly] if each in (*SLOW, *also) else [])
        for each in exercises
    ]


TRIED = [
    pytest.param(each, number, marks=[] if _is_sample(each, number) else pytest.mark.nightly)
    for each in IDS
    for number in range(len(answers_to(each).all))
]


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("AI4U_FAST", "1")


@pytest.mark.parametrize(("exercise", "number"), TRIED)
def test_an_answer_gets_its_verdict(exercise: str, number: int) -> None:
    answer = answers_to(exercise).all[number]
    verdict = try_answer(lesson(exercise[:2]), exercise, answer)
    assert is_as_wanted(answer, verdict), f"{answer.name}: {verdict.hint}: {verdict.text}"
    assert "has a fault" not in verdict.text


@pytest.mark.parametrize("exercise", _but_slow(ALL))
def test_the_unfinished_cell_does_not(exercise: str) -> None:
    one = lesson(exercise[:2])
    (stub,) = [cell.source for cell in one.cells if cell.exercise == exercise]
    verdict = tried(one, exercise, stub)
    assert not verdict.passed
    assert verdict.hint in {next(iter(find(exercise).hints)), "error", "unfinished"}


@pytest.mark.parametrize(
    "exercise", _but_slow([each for each in ALL if each != "00.1"], also=LONG_CHECKS)
)
def test_nothing_thoughtless_passes_and_all_of_it_gets_an_answer(exercise: str) -> None:
    count = len(ast.parse(handed_in(lesson(exercise[:2]), exercise), mode="eval").body.elts)  # type: ignore[attr-defined]
    for junk in JUNK:
        verdict = judge(find(exercise), *[junk] * count)
        assert not verdict.passed, junk
        assert verdict.text
        assert "has a fault" not in verdict.text, junk
        assert verdict.hint in {*find(exercise).hints, *COMMON}


class Spoiler:
    """Puts something else in the place of all numbers that a student's functions return.

    Args:
        number: what is returned instead.
        first_call: from which call of all on; a check that tries several cases must look at all.
    """

    METHODS = ("read", "on_update", "decide", "__call__", "step")

    def __init__(self, number: float, first_call: int) -> None:
        self.number, self.first_call = number, first_call
        self.calls = self.spoiled = 0

    def handed_in(self, thing: Any) -> Any:
        """A student's answer with other numbers in it."""
        if isinstance(thing, type):
            for name in self.METHODS:
                if name in vars(thing):
                    setattr(thing, name, self._function(vars(thing)[name]))
            return thing
        if callable(thing) and hasattr(thing, "__name__"):
            return self._function(thing)
        return self._value(thing)

    def _function(self, function: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(function)
        def spoil(*args: Any, **keywords: Any) -> Any:
            given = function(*args, **keywords)
            self.calls += 1
            return self._value(given) if self.calls >= self.first_call else given

        return spoil

    def _value(self, value: Any) -> Any:
        if isinstance(value, dict):
            return {key: self._value(each) for key, each in value.items()}
        if isinstance(value, list | tuple):
            return type(value)([self._value(each) for each in value])
        if isinstance(value, np.ndarray):
            self.spoiled += 1
            return np.full_like(value, self.number, dtype=float)
        if isinstance(value, int | float | np.number) and not isinstance(value, bool):
            self.spoiled += 1
            return self.number
        return value


@pytest.mark.parametrize(
    ("number", "first_call"),
    [
        (math.inf, 2),
        pytest.param(math.nan, 1, marks=pytest.mark.nightly),
        pytest.param(math.nan, 2, marks=pytest.mark.nightly),
        pytest.param(math.inf, 1, marks=pytest.mark.nightly),
    ],
)
@pytest.mark.parametrize("exercise", _but_slow(IDS, also=LONG_CHECKS))
def test_what_is_no_finite_number_never_passes(
    exercise: str, number: float, first_call: int
) -> None:
    one = lesson(exercise[:2])
    spoiler = Spoiler(number, first_call)
    solution = answers_to(exercise).solution
    verdict = tried(one, exercise, solution, spoiler.handed_in, may_be_endless=True)
    assert not (verdict.passed and spoiler.spoiled), verdict.text


@pytest.mark.parametrize("exercise", IDS)
def test_an_exercise_has_answers_of_all_kinds(exercise: str) -> None:
    kinds = [each.kind for each in answers_to(exercise).all]
    counts = {kind: kinds.count(kind) for kind in ("right", "wrong", "lucky")}
    assert counts["right"] >= 2, counts  # and the solution
    assert counts["wrong"] >= 4, counts
    assert counts["lucky"] >= 3, counts


@pytest.mark.parametrize("exercise", IDS)
def test_docs_describe_a_check_with_its_diagnoses_and_answers(exercise: str) -> None:
    text = section(Staging(Path()), find(exercise), answers_to(exercise))
    assert all(f"| {each.kind} | {each.name} |" in text for each in answers_to(exercise).all)


@pytest.mark.parametrize("missing", ["title", "docstring", "hint"])
def test_docs_refuse_a_check_without_description(missing: str) -> None:
    check = find("00.1")
    without = {
        "title": replace(check, title=""),
        "docstring": replace(check, judge=lambda *_: ""),
        "hint": replace(check, hints={**check.hints, "still": ""}),
    }
    with pytest.raises(ValueError, match=r"00\.1: expected a"):
        section(Staging(Path()), without[missing], answers_to("00.1"))


@pytest.mark.parametrize("one", lessons(), ids=lambda one: one.number)
def test_a_lesson_has_three_exercises_with_wrong_answers_and_a_picture(one: object) -> None:
    from ai4u_edu.lessons.course import Lesson

    assert isinstance(one, Lesson)
    exercises = [each for each in one.exercises if not is_ticket(each)]
    assert len(exercises) >= 3
    for number, exercise in enumerate(exercises, 1):
        assert exercise == f"{one.number}.{number}"
        known = find(exercise).hints
        hints = [wrong.hint for wrong in answers_to(exercise).wrong]
        assert hints
        assert set(hints) <= {*known, *COMMON}
        assert all(text.endswith((".", "?")) for text in known.values())
    picture = course_folder() / "pictures" / f"{one.number}.png"
    assert f"pictures/{picture.name}" in one.cells[0].source
    assert picture.stat().st_size < 60_000


def test_no_answers_lie_about_without_an_exercise() -> None:
    for one in lessons():
        for exercise in one.exercises:
            find(exercise)
    assert sorted(EXERCISES) == sorted(ALL)  # those of a stretch come after the exit ticket
    assert sorted(path.stem for path in (course_folder() / "answers").iterdir()) == IDS
