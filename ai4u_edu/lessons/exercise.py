"""Exercises: a check that runs a student's work, and hints.

A lesson's exercises stand in ``exercises/lesson_04.py``::

    @exercise("04.2", "Turn to the box", hints={"mirrored": "Left and right are swapped ..."})
    def turns_to_the_box(drive: Any) -> str:
        ...
        raise NotYet("With seed 5 the robot turned away.", hint="mirrored", picture=...)
        ...
        return "Your robot found the box in all 20 worlds."
"""

import reprlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, TypeVar, cast

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED
from ai4u_edu.lessons.time_limit import CALL_LIMIT_S, TOTAL_LIMIT_S
from ai4u_edu.locale import gettext as _

T = TypeVar("T")


class NotYet(Exception):  # noqa: N818 - no error: the student is on the way
    """Raised by a check: the exercise is not solved yet.

    Args:
        text: what happened, in sentences for the student: what was expected, what came, where
            (seed, step).
        hint: name of the diagnosis, whose hint helps; empty if the mistake is not known.
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
    """Hints by name of the diagnosis; the first one is for students who have not begun."""
    call_limit_s: float = CALL_LIMIT_S
    """Longest time (s) that one call of the student's function may take."""
    total_limit_s: float = TOTAL_LIMIT_S
    """Longest time (s) that all calls of a check may take together."""


EXERCISES: dict[str, Exercise] = {}


def exercise(
    exercise_id: str,
    title: str,
    *,
    hints: Mapping[str, str],
    call_limit_s: float = CALL_LIMIT_S,
) -> Callable[[Judge], Judge]:
    """Register a function as the check of an exercise.

    Args:
        exercise_id: the lesson's number, a point, the exercise's number.
        title: a few words.
        hints: hints by name of the diagnosis; at least one.
        call_limit_s: longest time that one call of the student's function may take.
    """

    def register(judge: Judge) -> Judge:
        enter(exercise_id, title, judge, hints, call_limit_s)
        return judge

    return register


def enter(
    exercise_id: str,
    title: str,
    judge: Judge,
    hints: Mapping[str, str],
    call_limit_s: float = CALL_LIMIT_S,
) -> None:
    """Enter an exercise into the list of all."""
    EXERCISES[exercise_id] = Exercise(exercise_id, title, judge, hints, call_limit_s)


def find(exercise_id: Any) -> Exercise:
    """Return an exercise by its id.

    Raises:
        SetupError: there is none of that id.
    """
    if not isinstance(exercise_id, str):
        raise SetupError(
            _(
                "expected an exercise's number in quotes, such as '02.1', got {exercise_id!r}",
                exercise_id=exercise_id,
            )
        )
    number = exercise_id.partition(".")[0]
    try:
        import_module(f"ai4u_edu.lessons.exercises.lesson_{number}")
    except ModuleNotFoundError as error:
        if not (error.name or "").startswith("ai4u_edu.lessons.exercises"):
            raise
    if exercise_id not in EXERCISES:
        from ai4u_edu.lessons.course import exercise_ids

        known = suggest(exercise_id, exercise_ids())
        raise SetupError(
            _(
                "no exercise is called {exercise_id!r}; {known}",
                exercise_id=exercise_id,
                known=known,
            )
        )
    return EXERCISES[exercise_id]


def unfinished(thing: Any) -> bool:
    """Return True while ``...`` still stands for the student's work."""
    return thing is ...


def a_function(thing: Any) -> Callable[..., Any]:
    """Return a student's work if it is callable.

    Raises:
        NotYet: it can't.
    """
    if isinstance(thing, type) or not callable(thing):
        raise NotYet(
            _("Expected a function, got {got}. Give its name, without brackets.", got=named(thing)),
            hint="not-a-function",
        )
    return cast("Callable[..., Any]", thing)


def named(thing: Any) -> str:
    """Return a student's thing in few words, for a sentence."""
    if isinstance(thing, type):
        return _("the class `{name}`", name=thing.__name__)
    return f"`{reprlib.repr(thing)}`"


def a_list_of(kind: type[T], given: Any) -> list[T]:
    """Return a student's list of blocks.

    Raises:
        NotYet: it is one block without a list, or something else.
    """
    name = kind.__name__
    if given is None:
        raise NotYet(NOTHING_RETURNED, hint="no-return")
    if isinstance(given, kind):
        raise NotYet(
            _(
                "Expected a list, got one {name} alone. Put it into a list: `return [...]`.",
                name=name,
            ),
            hint="list",
        )
    if not isinstance(given, list | tuple) or not all(isinstance(each, kind) for each in given):
        text = _("Expected a list with {name} blocks, got {got}.", name=name, got=named(given))
        raise NotYet(text, hint="list")
    return list(given)
