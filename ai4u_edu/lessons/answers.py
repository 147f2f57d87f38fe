"""Solutions, and plausible wrong answers with the hint that each should lead to.

Each exercise has one file in the course's folder ``answers``. Its cells::

    # %% tags=["solution"]
    ...
    # %% tags=["wrong", "mirrored"]
    ...

A wrong answer's second tag is the hint's name. Students get no such file; ``solution("03.2")``
prints the first cell.
"""

from dataclasses import dataclass

from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons.course import course_folder
from ai4u_edu.lessons.notebook import read_cells


@dataclass(frozen=True)
class Wrong:
    """A plausible wrong answer."""

    code: str
    hint: str
    """Name of the hint that the check should point to."""


@dataclass(frozen=True)
class Answers:
    """Possible contents of an exercise's cell."""

    solution: str
    wrong: tuple[Wrong, ...]


def answers_to(exercise: str) -> Answers:
    """Return the answers to an exercise.

    Raises:
        SetupError: there are none, or a cell is not marked.
    """
    path = course_folder() / "answers" / f"{exercise}.py"
    if not path.is_file():
        raise SetupError(f"exercise {exercise}: expected its answers in {path}, found none")
    cells = read_cells(path)
    solutions = [cell.source for cell in cells if cell.tags == ("solution",)]
    wrong = [Wrong(cell.source, cell.tags[1]) for cell in cells if cell.tags[:1] == ("wrong",)]
    if len(solutions) != 1 or len(wrong) != len(cells) - 1:
        raise SetupError(
            f'{path}: expected one cell with tags=["solution"], the others with '
            'tags=["wrong", "the hint\'s name"]'
        )
    return Answers(solutions[0], tuple(wrong))
