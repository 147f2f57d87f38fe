"""Location and contents of the course, in the package or in a checkout."""

import re
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.lessons.notebook import Cell, read_cells
from ai4u_edu.locale import gettext as _

TICKET = ".exit"
"""End of the id of an exit ticket, such as ``04.exit``."""


@dataclass(frozen=True)
class Lesson:
    """One notebook of the course, as text."""

    path: Path

    @property
    def number(self) -> str:
        """Two digits."""
        return self.path.name[:2]

    @property
    def name(self) -> str:
        """File name without its suffix."""
        return self.path.stem

    @cached_property
    def cells(self) -> list[Cell]:
        """Return the cells that a student gets."""
        return read_cells(self.path)

    @property
    def title(self) -> str:
        """Return the first heading."""
        return self.cells[0].source.splitlines()[0].lstrip("# ")

    @property
    def duration(self) -> str:
        """Return the time that a class needs, in words: the first cell's "About 45 minutes"."""
        text = self.cells[0].source + self.cells[1].source
        found = re.search(r"^\*(?:About )?([\w ]+(?:minutes|hours))\b", text, re.MULTILINE)
        return found[1] if found else ""

    @property
    def exercises(self) -> list[str]:
        """Return the ids of its exercises, in order; an exit ticket is one of them."""
        return [cell.exercise for cell in self.cells if cell.exercise]


def course_folder() -> Path:
    """Return the folder of the course."""
    here = Path(__file__).resolve().parent
    for folder in (here / "course", here.parent.parent / "lessons"):
        if (folder / "00_start_here.py").is_file():
            return folder
    raise SetupError(
        _(
            "expected the course in {here}, found none; install ai4u-edu again",
            here=str(here / "course"),
        )
    )


def lessons() -> list[Lesson]:
    """Return all lessons, in order."""
    return [Lesson(path) for path in sorted(course_folder().glob("[0-9][0-9]_*.py"))]


def exercise_ids() -> list[str]:
    """Return the ids of all exercises, in the course's order."""
    return [each for one in lessons() for each in one.exercises]


def is_ticket(exercise_id: str) -> bool:
    """Return True for an exit ticket: it has questions, and no code to write."""
    return exercise_id.endswith(TICKET)


def lesson(number: str) -> Lesson:
    """Return a lesson by its number.

    Raises:
        SetupError: there is none.
    """
    for each in lessons():
        if each.number == number:
            return each
    known = [each.number for each in lessons()]
    raise SetupError(
        _("no lesson has the number {number!r}; {hint}", number=number, hint=suggest(number, known))
    )
