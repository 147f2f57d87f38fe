"""Collected progress of a class: one table of all students, as HTML and CSV.

Students hand in their ``progress.json``; nothing else is read, and nothing leaves the machine.
"""

import html
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.csv_table import csv_table
from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons.course import Lesson, exercise_ids, is_ticket, lessons
from ai4u_edu.lessons.diagnoses import COMMON
from ai4u_edu.lessons.exercise import Exercise, find
from ai4u_edu.lessons.notebook_output import marked
from ai4u_edu.lessons.progress_file import FILE, ExerciseProgress, read_entries

MAX_FILE_BYTES = 5_000_000
"""Limit of a progress file that is read."""
HEADER = ("student", "exercise", "title", "passed", "when", "tries", "mistake", "text")
COMMON_MISTAKES = 3
"""Mistakes of an exercise that the page shows, most frequent first."""
HARDEST = 5
"""Exercises that the page names at its head."""
POLICY = "default-src 'none'; style-src 'unsafe-inline'"
STYLE = """body{font:15px/1.4 system-ui,sans-serif;margin:1em;color:#1b2530}
table{border-collapse:separate;border-spacing:0;margin:.7em 0}
td,th{border:solid #c9ced4;border-width:0 1px 1px 0;padding:.1em .3em;background:#fff}
a{color:inherit}code{background:#f3f5f7}
#students{font-size:13px;border-left:1px solid #c9ced4}
#students td{text-align:center;min-width:1.1em}#students .first{border-left:2px solid #7d8791}
#students thead{position:sticky;top:0;z-index:2}#students thead th{border-top:1px solid #c9ced4}
#students [scope=row]{position:sticky;left:0;z-index:1;text-align:left;max-width:11em;
overflow:hidden;white-space:nowrap;text-overflow:ellipsis;font-weight:normal}
#students thead .name{position:sticky;left:0;z-index:3}
#students .passed{background:#cdeee2}#students .tried{background:#fbdfcc;font-weight:bold}
#mistakes{border:solid #c9ced4;border-width:1px 0 0 1px}#mistakes tr{scroll-margin-top:1em}
#mistakes th,#mistakes td{text-align:left;vertical-align:top;padding:.2em .5em}
#mistakes .count{text-align:right}#mistakes th{white-space:nowrap}
ul{margin:0;padding-left:1.2em}"""


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
        course = [each for each in lessons() if begun.intersection(each.exercises)]
        exercises = [each for one in course for each in one.exercises]
        parts = [*_hardest(self, exercises), _students(self, course)]
        parts += ["<h2>Mistakes</h2>", _mistakes(self, exercises)]
        if self.problems:
            parts.append("<h2>Files that could not be read</h2>")
            parts.append(_list(html.escape(each) for each in self.problems))
        return (
            '<!doctype html><html lang="en"><head><meta charset="utf-8">'
            "<title>AI4U Edu lessons: the class</title>"
            f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
            f"<style>{STYLE}</style></head><body><h1>AI4U Edu lessons: the class</h1>"
            f"<p>{len(self.students)} students. A number is the count of checks: green if the "
            "exercise is solved, red and in brackets if it is not solved yet. E is the exit ticket "
            "of a lesson. Lessons that nobody has begun are left out.</p>"
            + "\n".join(parts)
            + "</body></html>\n"
        )


def collect(folder: Path) -> ClassProgress:
    """Read all progress files in a folder and below it; they stay as they are.

    A student is called after the folder of a ``progress.json``, or after a file of another name:
    ``ann/progress.json`` and ``ann.json`` are both Ann's.

    Raises:
        SetupError: there is no such folder, or no progress in it.
    """
    if not folder.is_dir():
        raise SetupError(f"expected a folder with the files of a class, found none at {folder}")
    students: dict[str, Mapping[str, ExerciseProgress]] = {}
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
    return ClassProgress(students, problems)


def _entries(path: Path) -> Mapping[str, ExerciseProgress]:
    if path.stat().st_size > MAX_FILE_BYTES:
        raise ValueError(f"expected at most {MAX_FILE_BYTES} bytes")
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


def _entries_of(collected: ClassProgress, exercise: str) -> list[ExerciseProgress]:
    return [one[exercise] for one in collected.students.values() if exercise in one]


def _hardest(collected: ClassProgress, exercises: list[str]) -> Iterator[str]:
    """Yield a paragraph on the exercises that most students began and have not solved."""
    stuck = Counter(
        {
            each: sum(not entry.passed for entry in _entries_of(collected, each))
            for each in exercises
        }
    )
    named = [f"{_link(each)} ({count})" for each, count in stuck.most_common(HARDEST) if count]
    if named:
        yield f"<p>Most often not solved yet: {', '.join(named)}.</p>"


def _students(collected: ClassProgress, course: list[Lesson]) -> str:
    """Return the table of students and exercises."""
    heads, numbers, totals = "", "", ""
    for lesson in course:
        title = html.escape(lesson.title)
        heads += (
            f'<th colspan="{len(lesson.exercises)}" class="first" title="{title}">'
            f"{lesson.number}</th>"
        )
        for index, each in enumerate(lesson.exercises):
            kind = "" if index else ' class="first"'
            title = html.escape(f"{each} {find(each).title}")
            label = "E" if is_ticket(each) else each.partition(".")[2]
            numbers += f'<th scope="col"{kind} title="{title}">{_link(each, label)}</th>'
            solved = sum(entry.passed for entry in _entries_of(collected, each))
            totals += f"<td{kind}>{solved}</td>"
    rows = [f'<tr><th scope="row">solved by</th><td></td>{totals}</tr>']
    for student, entries in collected.students.items():
        name = html.escape(student)
        cells = "".join(
            _cell(each, entries.get(each), "" if index else "first")
            for lesson in course
            for index, each in enumerate(lesson.exercises)
        )
        solved = sum(entry.passed for entry in entries.values())
        rows.append(f'<tr><th scope="row" title="{name}">{name}</th><td>{solved}</td>{cells}</tr>')
    return (
        '<table id="students"><thead><tr><th rowspan="2" class="name">student</th>'
        f'<th rowspan="2">solved</th>{heads}</tr><tr>{numbers}</tr></thead>'
        f"<tbody>{''.join(rows)}</tbody></table>"
    )


def _cell(exercise: str, entry: ExerciseProgress | None, kind: str) -> str:
    if entry is None:
        return f'<td class="{kind}"></td>' if kind else "<td></td>"
    word = "solved" if entry.passed else "not yet"
    title = html.escape(f"{exercise} {word}: {entry.text}")
    kind = f"{'passed' if entry.passed else 'tried'} {kind}".strip()
    text = entry.tries if entry.passed else f"({entry.tries})"
    return f'<td class="{kind}" title="{title}">{text}</td>'


def _mistakes(collected: ClassProgress, exercises: list[str]) -> str:
    """Return the table of exercises with known mistakes: how many made which."""
    rows = []
    for each in exercises:
        entries = _entries_of(collected, each)
        counts = Counter(name for entry in entries for name in entry.diagnoses)
        if not counts:
            continue
        exercise, stuck = find(each), sum(not entry.passed for entry in entries)
        items = _list(
            marked(f"{count}: {_hint(exercise, name)}")
            for name, count in counts.most_common(COMMON_MISTAKES)
        )
        rows.append(
            f'<tr id="{_anchor(each)}"><th scope="row">{each}</th>'
            f"<td>{html.escape(exercise.title)}</td>"
            f'<td class="count">{len(entries)}</td><td class="count">{stuck}</td>'
            f"<td>{items}</td></tr>"
        )
    heads = ("exercise", "title", "began", "not yet", "students: the hint that they got")
    head = "".join(f'<th scope="col">{each}</th>' for each in heads)
    return (
        f'<table id="mistakes"><thead><tr>{head}</tr></thead><tbody>{"".join(rows)}</tbody></table>'
    )


def _hint(exercise: Exercise, diagnosis: str) -> str:
    """Return the hint of a diagnosis, the exercise's own or the common one; else its id."""
    name = diagnosis.rpartition("/")[2]
    text = {**COMMON, **exercise.hints}.get(name, diagnosis)
    is_choice = is_ticket(exercise.id) and name in exercise.hints and name[:1].isdigit()
    return f"Question {name[0]}, {name[1:]}: {text}" if is_choice else text


def _link(exercise: str, label: str = "") -> str:
    return f'<a href="#{_anchor(exercise)}">{label or exercise}</a>'


def _anchor(exercise: str) -> str:
    return f"exercise-{exercise}"


def _list(items: Iterator[str]) -> str:
    return f"<ul>{''.join(f'<li>{each}</li>' for each in items)}</ul>"
