"""``check``, ``hint``, ``solution`` and ``progress``, for students."""

import reprlib
from dataclasses import dataclass
from typing import Any

from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.cell_source import written
from ai4u_edu.lessons.exercise import Done, Exercise, NotYet, find, unfinished
from ai4u_edu.lessons.notebook_output import card, put
from ai4u_edu.lessons.progress_file import Entry, ProgressFile
from ai4u_edu.lessons.student_errors import told

YES, NO = "\u2714", "\u2013"
UNFINISHED = "There is still `...` where your answer should be: run its cell once you wrote it."


@dataclass(frozen=True)
class Verdict:
    """Result of a check."""

    passed: bool
    text: str
    hint: str = ""
    """Name of the hint that helps."""
    picture: bytes = b""


def judge(exercise: Exercise, *things: Any) -> Verdict:
    """Run a student's work; return their exception as a sentence."""
    first = next(iter(exercise.hints))
    if not things or any(unfinished(thing) for thing in things):
        return Verdict(False, UNFINISHED, first)
    try:
        found = exercise.judge(*things)
    except NotYet as reason:
        return Verdict(False, reason.text, reason.hint or first, reason.picture)
    except Exception as error:
        return Verdict(False, told(error) or _unusable(things, error), first)
    done = Done(found) if isinstance(found, str) else found
    return Verdict(True, done.text, picture=done.picture)


def check(exercise_id: str, *things: Any) -> None:
    """Check an exercise, show what is right or what happened, and save the result.

    Args:
        exercise_id: such as ``"03.2"``.
        things: what you made in the exercise's cell.

    Raises:
        SetupError: there is no such exercise.
    """
    exercise = find(exercise_id)
    verdict = judge(exercise, *things)
    progress = ProgressFile()
    progress.note(
        exercise_id,
        passed=verdict.passed,
        text=verdict.text,
        hint=verdict.hint,
        picture=verdict.picture,
        code=written(exercise_id),
    )
    if verdict.passed:
        colour, sign, more = "green", f"{YES} Right.", []
    else:
        colour, sign = "vermillion", "Not yet."
        more = [f'Stuck? Run `hint("{exercise_id}")`.']
    lines = [verdict.text, *more, *([progress.trouble] if progress.trouble else [])]
    put(card(colour, sign, lines, verdict.picture), _words(sign, lines))


def hint(exercise_id: str) -> None:
    """Show the hint that the last check pointed to; called again, the next one.

    Raises:
        SetupError: there is no such exercise.
    """
    exercise = find(exercise_id)
    names = list(exercise.hints)
    pointed = ProgressFile().entries().get(exercise_id, Entry()).hint
    start = names.index(pointed) if pointed in names else 0
    asked = _asked.get((exercise_id, pointed), 0)
    _asked[exercise_id, pointed] = asked + 1
    name = names[(start + asked) % len(names)]
    rest = len(names) - 1
    more = [f'{rest} more: run `hint("{exercise_id}")` again.'] if rest and not asked else []
    lines = [exercise.hints[name], *more]
    put(card("blue", "Hint.", lines), _words("Hint.", lines))


_asked: dict[tuple[str, str], int] = {}


def solution(exercise_id: str) -> None:
    """Print one solution; there are others.

    Raises:
        SetupError: there is no such exercise.
    """
    find(exercise_id)
    print(answers_to(exercise_id).solution)  # noqa: T201 - to be copied from


def progress() -> None:
    """Show which exercises are solved."""
    from ai4u_edu.lessons.course import lessons

    progress = ProgressFile()
    entries = progress.entries()
    rows, words, passed, total = [], [], 0, 0
    for lesson in lessons():
        marks = [entries.get(each, Entry()).passed for each in lesson.exercises]
        passed, total = passed + sum(marks), total + len(marks)
        named = list(zip(lesson.exercises, marks, strict=True))
        signs = "   ".join(f"{name} {YES if mark else NO}" for name, mark in named)
        rows.append(f"{lesson.title}: {signs}")
    lines = [f"{passed} of {total} exercises are solved.", *rows]
    words = [*lines, *([progress.trouble] if progress.trouble else [])]
    put(card("blue", "Progress.", words), _words("Progress.", words))


def _unusable(things: tuple[Any, ...], error: Exception) -> str:
    """Return the text for an exception that no line of the student's caused."""
    shown = reprlib.repr(things[0]) if len(things) == 1 else reprlib.repr(things)
    return (
        f"The check could not try out {shown} ({type(error).__name__}: {error}). Is it what the "
        "exercise asks for? If it is, the check itself has a fault."
    )


def _words(sign: str, lines: list[str]) -> str:
    return "\n".join([f"{sign} {lines[0]}", *lines[1:]])
