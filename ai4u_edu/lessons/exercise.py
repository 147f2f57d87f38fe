"""Exercises: a check that runs a student's work, and hints.

A lesson's exercises stand in ``exercises/lesson_03.py``::

    @exercise("03.2", "Turn to the box", hints={"mirrored": "Left and right are swapped ..."})
    def turns_to_the_box(drive: Any) -> str:
        ...
        raise NotYet("With seed 5 the robot turned away.", hint="mirrored", picture=...)
        ...
        return "Your robot found the box in all 20 worlds."
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, cast

from ai4u_edu.base.errors import SetupError, suggest


class NotYet(Exception):  # noqa: N818 - no error: the student is on the way
    """Raised by a check: the exercise is not solved yet.

    Args:
        text: what happened, in sentences for the student: what was expected, what came, where
            (seed, step).
        hint: the name of the hint that helps with this.
        picture: of the moment, as PNG or GIF.
    """

    def __init__(self, text: str, *, hint: str = "", picture: bytes = b"") -> None:
        super().__init__(text)
        self.text, self.hint, self.picture = text, hint, picture


@dataclass(frozen=True)
class Done:
    """An exercise is solved."""

    text: str
    """Sentence on what was right."""
    picture: bytes = b""


Judge = Callable[..., "str | Done"]
"""Function from a student's work to a sentence on what is right; or it raises :class:`NotYet`."""


@dataclass(frozen=True)
class Exercise:
    """Task for a student, with its check and hints."""

    id: str
    title: str
    judge: Judge
    hints: Mapping[str, str] = field(default_factory=dict)
    """Hints by name; the first one is for students who have not begun."""


EXERCISES: dict[str, Exercise] = {}


def exercise(exercise_id: str, title: str, *, hints: Mapping[str, str]) -> Callable[[Judge], Judge]:
    """Register a function as the check of an exercise.

    Args:
        exercise_id: the lesson's number, a point, the exercise's number.
        title: a few words.
        hints: hints by name; at least one.
    """

    def enter(judge: Judge) -> Judge:
        EXERCISES[exercise_id] = Exercise(exercise_id, title, judge, hints)
        return judge

    return enter


def find(exercise_id: Any) -> Exercise:
    """Return an exercise by its id.

    Raises:
        SetupError: there is none of that id.
    """
    if not isinstance(exercise_id, str):
        raise SetupError(
            f"expected an exercise's number in quotes, such as '01.1', got {exercise_id!r}"
        )
    number = exercise_id.partition(".")[0]
    try:
        import_module(f"ai4u_edu.lessons.exercises.lesson_{number}")
    except ModuleNotFoundError as error:
        if not (error.name or "").startswith("ai4u_edu.lessons.exercises"):
            raise
    if exercise_id not in EXERCISES:
        from ai4u_edu.lessons.course import lessons

        known = [each for lesson in lessons() for each in lesson.exercises]
        raise SetupError(f"no exercise is called {exercise_id!r}; {suggest(exercise_id, known)}")
    return EXERCISES[exercise_id]


def unfinished(thing: Any) -> bool:
    """Return True while ``...`` still stands for the student's work."""
    return thing is ... or thing is None


def a_function(thing: Any) -> Callable[..., Any]:
    """Return a student's work if it is callable.

    Raises:
        NotYet: it can't.
    """
    if not callable(thing):
        raise NotYet(f"Expected a function, got `{thing!r}`. Give its name, without brackets.")
    return cast("Callable[..., Any]", thing)
