"""Collected progress of a class: one table of all students, as HTML and CSV.

Students hand in their ``progress.json``; nothing else is read, and nothing leaves the machine.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.csv_table import csv_table
from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons.class_page import Collected, page
from ai4u_edu.lessons.course import exercise_ids
from ai4u_edu.lessons.exercise import find
from ai4u_edu.lessons.progress_file import FILE, Entry, read_entries

HTML_FILE, CSV_FILE = "class.html", "class.csv"
MAX_FILE_BYTES = 5_000_000
"""Limit of a progress file that is read."""
HEADER = ("student", "exercise", "title", "passed", "when", "tries", "mistake", "text")


def collect(folder: Path) -> Collected:
    """Read all progress files in a folder and below it; they stay as they are.

    A student is called after the folder of a ``progress.json``, or after a file of another name:
    ``ann/progress.json`` and ``ann.json`` are both Ann's.

    Raises:
        SetupError: there is no such folder, or no progress in it.
    """
    if not folder.is_dir():
        raise SetupError(f"expected a folder with the files of a class, found none at {folder}")
    students: dict[str, Mapping[str, Entry]] = {}
    problems = []
    for path in sorted(folder.rglob("*.json")):
        place = path.relative_to(folder)
        if any(part.startswith(".") for part in place.parts):
            continue
        name = str(place.parent if path.name == FILE else place.with_suffix(""))
        try:
            students[name] = _entries(path)
        except (OSError, ValueError) as error:
            problems.append(f"{place} is no progress file: {error}")
    if not students:
        raise SetupError(
            f"expected files called {FILE}, one for each student, found none in {folder}"
            + "".join(f"; {each}" for each in problems)
        )
    return Collected(students, problems)


def _entries(path: Path) -> Mapping[str, Entry]:
    if path.stat().st_size > MAX_FILE_BYTES:
        raise ValueError(f"expected at most {MAX_FILE_BYTES} bytes")
    return read_entries(path.read_text(encoding="utf-8"))


def write(collected: Collected, folder: Path) -> list[Path]:
    """Write the tables into a folder; return their paths."""
    paths = [folder / HTML_FILE, folder / CSV_FILE]
    write_atomically(paths[0], page(collected))
    write_atomically(paths[1], table(collected))
    return paths


def table(collected: Collected) -> str:
    """Return one line of CSV for each student and exercise that was begun."""
    return csv_table(HEADER, _rows(collected))


def _rows(collected: Collected) -> Iterator[tuple[object, ...]]:
    exercises = exercise_ids()
    for student, entries in collected.students.items():
        for each in exercises:
            if each in entries:
                entry = entries[each]
                passed = "yes" if entry.passed else "no"
                rest = (entry.when, entry.tries, entry.diagnosis, entry.text)
                yield (student, each, find(each).title, passed, *rest)
