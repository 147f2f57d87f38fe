"""Collected progress of a class: one table of all students, as HTML and CSV.

Students hand in their ``progress.json``; nothing else is read, and nothing leaves the machine.
"""

import csv
import html
import io
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons.course import Lesson, exercise_ids, lessons
from ai4u_edu.lessons.diagnoses import COMMON
from ai4u_edu.lessons.exercise import Exercise, find
from ai4u_edu.lessons.progress_file import FILE, Entry, read_entries

HTML_FILE, CSV_FILE = "class.html", "class.csv"
MAX_FILE_BYTES = 5_000_000
"""Limit of a progress file that is read."""
COMMON_MISTAKES = 3
"""Mistakes of an exercise that the page shows, most frequent first."""
HEADER = ("student", "exercise", "title", "passed", "when", "tries", "mistake", "text")
POLICY = "default-src 'none'; style-src 'unsafe-inline'"
STYLE = """body{font:15px/1.5 system-ui,sans-serif;margin:2em;color:#1b2530}
table{border-collapse:collapse;margin:1em 0}td,th{border:1px solid #c9ced4;padding:.2em .5em}
thead th{position:sticky;top:0;background:#fff}tbody th{text-align:left}td{text-align:center}
.passed{background:#cdeee2}.tried{background:#fbdfcc}ul{margin:.2em 0}"""


@dataclass(frozen=True)
class Collected:
    """The progress of a class.

    Attributes:
        students: entries by exercise id, by the student's file or folder.
        problems: sentences on files that could not be read.
    """

    students: Mapping[str, Mapping[str, Entry]]
    problems: list[str]


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
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(HEADER)
    exercises = exercise_ids()
    for student, entries in collected.students.items():
        for each in exercises:
            if each in entries:
                entry = entries[each]
                passed = "yes" if entry.passed else "no"
                rest = (entry.when, entry.tries, entry.diagnosis, entry.text)
                row = (student, each, find(each).title, passed, *rest)
                writer.writerow([_harmless(cell) for cell in row])
    return out.getvalue()


def page(collected: Collected) -> str:
    """Return the HTML of the class: a table, and what was difficult; all of it escaped."""
    course = lessons()
    exercises = [each for one in course for each in one.exercises]
    parts = [_table(collected, course, exercises), *_difficult(collected, exercises)]
    if collected.problems:
        parts.append("<h2>Files that could not be read</h2>")
        parts.append(_list(html.escape(each) for each in collected.problems))
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        "<title>AI4U Edu lessons: the class</title>"
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
        f"<style>{STYLE}</style></head><body><h1>AI4U Edu lessons: the class</h1>"
        f"<p>{len(collected.students)} students. A number is the count of checks; green is "
        "solved, red is not solved yet.</p>" + "\n".join(parts) + "</body></html>\n"
    )


def _table(collected: Collected, course: list[Lesson], exercises: list[str]) -> str:
    heads = "".join(
        f'<th colspan="{len(each.exercises)}" title="{html.escape(each.title)}">{each.number}</th>'
        for each in course
        if each.exercises
    )
    numbers = "".join(
        f'<th scope="col" title="{html.escape(find(each).title)}">{each.partition(".")[2]}</th>'
        for each in exercises
    )
    rows = []
    for student, entries in collected.students.items():
        solved = sum(entry.passed for entry in entries.values())
        cells = "".join(_cell(each, entries.get(each)) for each in exercises)
        rows.append(f'<tr><th scope="row">{html.escape(student)}</th><td>{solved}</td>{cells}</tr>')
    return (
        f'<table><thead><tr><th rowspan="2">student</th><th rowspan="2">solved</th>{heads}</tr>'
        f"<tr>{numbers}</tr></thead><tbody>{''.join(rows)}</tbody></table>"
    )


def _cell(exercise: str, entry: Entry | None) -> str:
    if entry is None:
        return "<td></td>"
    kind, word = ("passed", "solved") if entry.passed else ("tried", "not yet")
    title = html.escape(f"{exercise} {word}: {entry.text}")
    return f'<td class="{kind}" title="{title}">{entry.tries}</td>'


def _difficult(collected: Collected, exercises: list[str]) -> Iterator[str]:
    """Yield a paragraph for each exercise with known mistakes: how many made which."""
    yield "<h2>Mistakes</h2>"
    for each in exercises:
        entries = [one[each] for one in collected.students.values() if each in one]
        counts = Counter(name for entry in entries for name in entry.diagnoses)
        if not counts:
            continue
        exercise, stuck = find(each), sum(not entry.passed for entry in entries)
        yield f"<h3>{html.escape(f'{each} {exercise.title}')}</h3>"
        yield f"<p>{len(entries)} began, {stuck} did not solve it yet.</p>"
        yield _list(
            html.escape(f"{count}: {_hint(exercise, name)}")
            for name, count in counts.most_common(COMMON_MISTAKES)
        )


def _hint(exercise: Exercise, diagnosis: str) -> str:
    """Return the hint of a diagnosis, the exercise's own or the common one; else its id."""
    name = diagnosis.rpartition("/")[2]
    return {**COMMON, **exercise.hints}.get(name, diagnosis)


def _list(items: Iterator[str]) -> str:
    return f"<ul>{''.join(f'<li>{each}</li>' for each in items)}</ul>"


def _harmless(cell: object) -> object:
    """Return a cell that no spreadsheet takes for a formula."""
    is_formula = isinstance(cell, str) and cell[:1] in ("=", "+", "-", "@", "\t", "\r")
    return f"'{cell}" if is_formula else cell
