"""Lessons with something in the place of what students are to write."""

import ast
import linecache
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from ai4u_edu.lessons import controls, filming, live
from ai4u_edu.lessons.answers import SampleAnswer, answers_to
from ai4u_edu.lessons.checking import CheckResult, judge
from ai4u_edu.lessons.course import Lesson, is_ticket
from ai4u_edu.lessons.exercise import EXERCISES, Exercise, find
from ai4u_edu.lessons.exercises import lesson_15
from ai4u_edu.lessons.exit_ticket import TICKETS
from ai4u_edu.lessons.live import StallWatch
from ai4u_edu.lessons.notebook import Cell
from ai4u_edu.lessons.time_limit import TimeLimit
from tests.waiting import LIMIT_MS, LIMIT_S

SLOW = ("10.3", "11.1", "11.2", "17.3", "17.4", "17.5", "18.4")
"""Exercises whose answers train a network, or play many episodes."""
SETUP = "setup"
"""Cells with this tag are run before an exercise is tried alone."""


def solution_of(exercise: str) -> str:
    """The code that solves an exercise; of an exit ticket its right letters."""
    if not is_ticket(exercise):
        return answers_to(exercise).solution
    find(exercise)
    return f"answers = {[each.right for each in TICKETS[exercise]]}"


def solved(lesson: Lesson, answers: Mapping[str, str]) -> list[Cell]:
    """A lesson's cells with other code in some exercises."""
    return [
        replace(cell, source=answers[cell.exercise]) if cell.exercise in answers else cell
        for cell in lesson.cells
    ]


def run(cell: Cell, names: dict[str, Any], file: str) -> None:
    """Runs a cell as a notebook does, so that messages can quote its lines."""
    linecache.cache[file] = len(cell.source), None, cell.source.splitlines(True), file
    exec(compile(cell.source, file, "exec"), names)  # noqa: S102 - as a notebook does


def names_after_setup(lesson: Lesson) -> dict[str, Any]:
    """Return the names that a lesson's helpers define."""
    names: dict[str, Any] = {"__name__": "__main__"}
    for number, cell in enumerate(lesson.cells):
        if SETUP in cell.tags:
            run(cell, names, f"<setup {lesson.number}:{number}>")
    return names


def handed_in(lesson: Lesson, exercise: str) -> str:
    """Return the answer passed to the exercise's check in the notebook, as an expression."""
    pattern = re.compile(rf'^check\("{re.escape(exercise)}"', re.MULTILINE)
    calls = [
        node
        for cell in lesson.cells
        if not cell.is_text and pattern.search(cell.source)
        for node in ast.walk(ast.parse(cell.source))
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "check"
        if ast.literal_eval(node.args[0]) == exercise
    ]
    assert len(calls) == 1, f"lesson {lesson.number}: expected one check of {exercise}"
    return "(" + "".join(ast.unparse(each) + ", " for each in calls[0].args[1:]) + ")"


def tried(
    lesson: Lesson,
    exercise: str,
    code: str,
    change: Callable[[Any], Any] = lambda thing: thing,
    *,
    may_be_endless: bool = False,
) -> CheckResult:
    """Return the check's verdict on code in the exercise's cell.

    Args:
        lesson: the exercise's.
        exercise: its id.
        code: in place of the cell's.
        change: makes something else of each thing that is handed in.
        may_be_endless: a call of the code ends after a second or some more, and any verdict on one
            that a busy machine keeps for so long is fine; else it has all the time that it takes.
    """
    names = names_after_setup(lesson)
    try:
        run(Cell(code), names, f"<exercise {exercise}>")
        things = eval(handed_in(lesson, exercise), names)  # noqa: S307 - the course's own
    except Exception as error:
        raise AssertionError(f"{exercise}: the cell itself must run; {error!r}") from error
    known = find(exercise)  # an endless loop needs no 5 s to be one
    quick = replace(known, call_limit_s=known.call_limit_s / 5)
    return judge(quick if may_be_endless else patient(known), *map(change, things))


def try_answer(lesson: Lesson, exercise: str, answer: SampleAnswer) -> CheckResult:
    """Return the check's verdict on an answer.

    Only one that must be found endless, or on which any verdict is right, has a time limit that
    it may reach.
    """
    may_be_endless = not answer.is_right and answer.hint in {"", "endless", "endless-loop", "slow"}
    return tried(lesson, exercise, answer.code, may_be_endless=may_be_endless)


def patient(exercise: Exercise) -> Exercise:
    """Return an exercise with time limits that a busy machine does not reach."""
    return replace(exercise, call_limit_s=LIMIT_S, total_limit_s=LIMIT_S)


def be_patient(lesson: Lesson) -> None:
    """Give the code of a lesson's student all the time that it takes, in this process."""
    for each in lesson.exercises:
        EXERCISES[each] = patient(find(each))
    for module in (filming, controls):
        module.TimeLimit = partial(TimeLimit, LIMIT_S, LIMIT_S)  # type: ignore[attr-defined]
    live.StallWatch = partial(StallWatch, limit_s=LIMIT_S)  # type: ignore[assignment, misc]
    lesson_15.RECEIVE_TIMEOUT_MS, lesson_15.MAX_DIALOGUE_S = round(LIMIT_MS), round(LIMIT_S)
