"""Collected progress of a class: one table of all students, as HTML and CSV.

Students hand in their ``progress.json``; nothing else is read, and nothing leaves the machine.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.csv_table import csv_table
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.html_template import render_html
from ai4u_edu.lessons.course import exercise_ids, is_ticket, lessons
from ai4u_edu.lessons.diagnoses import COMMON
from ai4u_edu.lessons.exercise import Exercise, find
from ai4u_edu.lessons.notebook_output import marked
from ai4u_edu.lessons.progress_file import FILE, ExerciseProgress, read_entries
from ai4u_edu.lessons.translation import translated_title
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join

MAX_COLLECTED_BYTES = 5_000_000
"""Limit of a progress file that is read."""
HEADER = ("student", "exercise", "title", "passed", "when", "tries", "mistake", "text")
COMMON_MISTAKES = 3
"""Mistakes of an exercise that the page shows, most frequent first."""
HARDEST = 5
"""Exercises that the page names at its head."""


@dataclass(frozen=True)
class ClassProgress:
    """The progress of a class.

    Attributes:
        students: entries by exercise id, by the student's file or folder.
        problems: sentences on files that could not be read.
    """

    students: Mapping[str, Mapping[str, ExerciseProgress]]
    problems: list[str]

    def write(self, folder: Path) -> list[Path]:
        """Write page and table into a folder; return their paths."""
        paths = [folder / "class.html", folder / "class.csv"]
        write_atomically(paths[0], self.page())
        write_atomically(paths[1], self.table())
        return paths

    def table(self) -> str:
        """Return one line of CSV for each student and exercise that was begun."""
        return csv_table(HEADER, _rows(self))

    def page(self) -> str:
        """Return the HTML of the class, all of it escaped: a table, and what was difficult.

        Lessons that nobody has begun are left out.
        """
        begun = {exercise for entries in self.students.values() for exercise in entries}
        course = [
            (lesson, [_exercise(self, each) for each in lesson.exercises])
            for lesson in lessons()
            if begun.intersection(lesson.exercises)
        ]
        exercises = [each for _, columns in course for each in columns]
        hardest = sorted(exercises, key=lambda each: -each.stuck)[:HARDEST]
        return render_html(
            "lessons/collecting.html",
            collected=self,
            course=course,
            all_exercises=exercises,
            hardest=[each for each in hardest if each.stuck],
            marked=marked,
            translated_title=translated_title,
        )


class _ExerciseColumn(NamedTuple):
    """An exercise, and how the class did it."""

    id: str
    title: str
    label: str
    """Heading of its column."""
    begun: int
    """Students who began it."""
    stuck: int
    """Students of them who have not solved it."""
    mistakes: list[tuple[int, str]]
    """Students who made a mistake, and its hint; the most frequent ones."""


def collect(folder: Path) -> ClassProgress:
    """Read all progress files in a folder and below it; they stay as they are.

    A student is called after the folder of a ``progress.json``, or after a file of another name:
    ``ann/progress.json`` and ``ann.json`` are both Ann's.

    Raises:
        SetupError: there is no such folder, or no progress in it.
    """
    if not folder.is_dir():
        raise SetupError(
            _(
                "expected a folder with the files of a class, found none at {folder}",
                folder=str(folder),
            )
        )
    students: dict[str, Mapping[str, ExerciseProgress]] = {}
    problems: list[str] = []
    for path in sorted(folder.rglob("*.json")):
        place = path.relative_to(folder)
        if any(part.startswith(".") for part in place.parts):
            continue
        name = str(place.parent if path.name == FILE else place.with_suffix(""))
        try:
            students[name] = _entries(path)
        except (OSError, ValueError) as error:
            problems.append(
                _("{place} is no progress file: {problem}", place=str(place), problem=str(error))
            )
    if not students:
        none = _(
            "expected files called {file}, one for each student, found none in {folder}",
            file=FILE,
            folder=str(folder),
        )
        raise SetupError(join([none, *problems], "; "))
    return ClassProgress(students, problems)


def _entries(path: Path) -> Mapping[str, ExerciseProgress]:
    if path.stat().st_size > MAX_COLLECTED_BYTES:
        raise ValueError(_("expected at most {most} bytes", most=MAX_COLLECTED_BYTES))
    return read_entries(path.read_text(encoding="utf-8"))


def _rows(collected: ClassProgress) -> Iterator[tuple[object, ...]]:
    exercises = exercise_ids()
    for student, entries in collected.students.items():
        for each in exercises:
            if each in entries:
                entry = entries[each]
                passed = "yes" if entry.passed else "no"
                rest = (entry.when, entry.tries, entry.diagnosis, entry.text)
                yield (student, each, find(each).title, passed, *rest)


def _exercise(collected: ClassProgress, name: str) -> _ExerciseColumn:
    exercise = find(name)
    entries = [each[name] for each in collected.students.values() if name in each]
    mistakes = Counter(each for entry in entries for each in entry.diagnoses)
    return _ExerciseColumn(
        name,
        exercise.title,
        "E" if is_ticket(name) else name.partition(".")[2],
        len(entries),
        sum(not entry.passed for entry in entries),
        [
            (count, _hint(exercise, diagnosis))
            for diagnosis, count in mistakes.most_common(COMMON_MISTAKES)
        ],
    )


def _hint(exercise: Exercise, diagnosis: str) -> str:
    """Return the hint of a diagnosis, the exercise's own or the common one; else its id."""
    name = diagnosis.rpartition("/")[2]
    text = {**COMMON, **exercise.hints}.get(name, diagnosis)
    is_choice = is_ticket(exercise.id) and name in exercise.hints and name[:1].isdigit()
    return (
        _("Question {number}, {choice}: {text}", number=name[0], choice=name[1:], text=text)
        if is_choice
        else text
    )
