"""Exit tickets: three questions with choices at the end of a lesson.

A ticket is registered beside the lesson's exercises, in ``exercises/lesson_04.py``::

    exit_ticket(
        "04.exit",
        Question("b", {"a": "What this choice gets wrong.", "c": "..."}),
        Question("a", {"b": "...", "c": "..."}),
        Question("c", {"a": "...", "b": "..."}),
    )

Its cell in the notebook is ``answers = ["", "", ""]``. The check says which answers are right, and
what the first wrong one gets wrong; it never names the right letter.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons.course import TICKET, is_ticket
from ai4u_edu.lessons.exercise import EXERCISES, Exercise, NotYet, named
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join

QUESTIONS = 3
TITLE = _("Exit ticket")
BEGIN = _(
    'Write one letter for each of the three questions into the list: `answers = ["a", "a", "a"]` '
    "has the right form."
)


@dataclass(frozen=True)
class Question:
    """Question of a ticket.

    Attributes:
        right: letter of the right choice.
        wrong: by letter of each other choice: the sentence for students who took it.
    """

    right: str
    wrong: Mapping[str, str]

    @property
    def letters(self) -> list[str]:
        """Letters of all choices, in order."""
        return sorted([self.right, *self.wrong])


TICKETS: dict[str, tuple[Question, ...]] = {}
"""Questions of each ticket, by its id."""


def exit_ticket(exercise_id: str, *questions: Question) -> None:
    """Register the questions as an exercise.

    Args:
        exercise_id: the lesson's number and ``.exit``, such as ``"04.exit"``.
        questions: three of them.

    Raises:
        SetupError: the id is another one, or the questions have no proper choices.
    """
    if not is_ticket(exercise_id) or len(questions) != QUESTIONS:
        raise SetupError(
            f"exit_ticket: expected an id such as '03{TICKET}' and {QUESTIONS} questions, got "
            f"{exercise_id!r} and {len(questions)}"
        )
    for each in questions:
        letters = each.letters
        if len(letters) < 2 or letters != list("abcdefgh"[: len(letters)]):
            raise SetupError(
                f"exit_ticket {exercise_id}: expected the choices a, b, c ..., each once, got "
                f"{', '.join(letters)}"
            )
    hints: dict[str, str] = {"begin": BEGIN}
    for number, question in enumerate(questions, 1):
        hints |= {f"{number}{letter}": text for letter, text in sorted(question.wrong.items())}
    TICKETS[exercise_id] = questions
    EXERCISES[exercise_id] = Exercise(
        exercise_id, TITLE, lambda given: _judge(questions, given), hints
    )


def _judge(questions: tuple[Question, ...], given: Any) -> str:
    """Return a sentence on three right answers.

    Raises:
        NotYet: they are no letters, or not all of them are right.
    """
    pairs = list(zip(questions, _letters(questions, given), strict=True))
    right = [number for number, (each, got) in enumerate(pairs, 1) if got == each.right]
    if len(right) == len(questions):
        return _("All three answers are right.")
    number = next(each for each in range(1, len(questions) + 1) if each not in right)
    question, got = pairs[number - 1]
    wrong = _(
        "Question {number}, {letter}: {text}", number=number, letter=got, text=question.wrong[got]
    )
    raise NotYet(join([_right_ones(right), wrong]), hint=f"{number}{got}")


def _right_ones(right: list[int]) -> str:
    if not right:
        return _("No answer is right yet.")
    if len(right) == 1:
        return _("Question {number} is right.", number=right[0])
    first, second = right
    return _("Questions {first} and {second} are right.", first=first, second=second)


def _letters(questions: tuple[Question, ...], given: Any) -> list[str]:
    """Return a student's letters.

    Raises:
        NotYet: they are something else.
    """
    if not isinstance(given, list | tuple | str):
        text = _("Expected a list of three letters, got {got}.", got=named(given))
        raise NotYet(text, hint="begin")
    if not any(isinstance(each, str) and each.strip() for each in given):
        raise NotYet(join([_("Nothing is answered yet."), BEGIN]), hint="begin")
    # a student who wrote "bac" or "b, a, c" has answered as well
    letters = [each for each in given if each.isalnum()] if isinstance(given, str) else list(given)
    if len(letters) != len(questions):
        raise NotYet(
            _(
                "Expected one letter for each of the three questions, got {count}: {got}.",
                count=len(letters),
                got=named(given),
            ),
            hint="begin",
        )
    return [
        _letter(number, question, each)
        for number, (question, each) in enumerate(zip(questions, letters, strict=True), 1)
    ]


def _letter(number: int, question: Question, given: Any) -> str:
    letter = given.strip().lower() if isinstance(given, str) else ""
    if letter not in question.letters:
        got = named(given) if letter or not isinstance(given, str) else _("nothing")
        raise NotYet(
            _(
                "Question {number}: expected one of the letters {letters}, got {got}.",
                number=number,
                letters=", ".join(question.letters),
                got=got,
            ),
            hint="begin",
        )
    return letter
