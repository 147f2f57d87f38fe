"""Answers to exercises: solutions, and wrong ones with the diagnosis that each should get.

Each exercise has one file in the course's folder ``answers``. Its cells::

    # %% tags=["solution"]
    # %% tags=["right", "drives backward"]
    # %% tags=["wrong", "mirrored", "takes left for right"]
    # %% tags=["lucky", "always the same number"]

``right`` is another solution. ``wrong`` is a misconception: the name of the diagnosis that the
check should find, then a few words (default: the diagnosis). ``lucky`` is a guess, or an answer
that is hard-coded. Students get no such file; ``solution("04.2")`` prints the first cell.
"""

from dataclasses import dataclass

from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons.course import course_folder
from ai4u_edu.lessons.notebook import Cell, read_cells

KINDS = ("solution", "right", "wrong", "lucky")


@dataclass(frozen=True)
class SampleAnswer:
    """Possible content of an exercise's cell."""

    kind: str
    """One of KINDS."""
    code: str
    name: str
    """A few words, unique in the exercise."""
    hint: str = ""
    """Name of the diagnosis that the check should find; empty where any will do."""

    @property
    def is_right(self) -> bool:
        """Return True if the check has to accept it."""
        return self.kind in {"solution", "right"}


@dataclass(frozen=True)
class Answers:
    """Possible contents of an exercise's cell."""

    all: tuple[SampleAnswer, ...]

    @property
    def solution(self) -> str:
        """Return the code that students may look at."""
        return self.all[0].code

    @property
    def wrong(self) -> tuple[SampleAnswer, ...]:
        """Return the misconceptions."""
        return tuple(each for each in self.all if each.kind == "wrong")


def answers_to(exercise: str) -> Answers:
    """Return the answers to an exercise.

    Raises:
        SetupError: there are none, or a cell is not marked.
    """
    path = course_folder() / "answers" / f"{exercise}.py"
    if not path.is_file():
        raise SetupError(f"exercise {exercise}: expected its answers in {path}, found none")
    found = [_answer(cell, str(path)) for cell in read_cells(path)]
    names = [each.name for each in found]
    if [each.kind for each in found].count("solution") != 1 or found[0].kind != "solution":
        raise SetupError(f'{path}: expected one cell with tags=["solution"], as the first one')
    if len(set(names)) < len(names):
        raise SetupError(f"{path}: expected a different name for each answer, got {names}")
    return Answers(tuple(found))


def _answer(cell: Cell, path: str) -> SampleAnswer:
    kind, *rest = cell.tags or ("",)
    wanted = {"solution": (0,), "right": (1,), "wrong": (1, 2), "lucky": (1,)}.get(kind, ())
    if len(rest) not in wanted:
        raise SetupError(
            f'{path}, line {cell.line}: expected tags=["solution"], tags=["right", "a few words"], '
            'tags=["wrong", "diagnosis", "a few words"] or tags=["lucky", "a few words"], got '
            f"{list(cell.tags)}"
        )
    hint = rest[0] if kind == "wrong" else ""
    return SampleAnswer(kind, cell.source, rest[-1] if rest else "solution", hint)
