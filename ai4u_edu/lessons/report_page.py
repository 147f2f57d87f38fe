"""``report``: one page to hand in. Nothing leaves the machine; the file is the student's."""

import json
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path
from typing import Any

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.colors import PALETTE
from ai4u_edu.base.html_template import render_html
from ai4u_edu.lessons.course import lessons
from ai4u_edu.lessons.exercise import find
from ai4u_edu.lessons.notebook import EXERCISE
from ai4u_edu.lessons.notebook_output import address, card, put
from ai4u_edu.lessons.prediction_values import shown
from ai4u_edu.lessons.progress_file import ProgressFile

MAX_PICTURE_BYTES = 3_000_000
"""Limit of a picture that is included."""


def report(name: str = "", file: str | Path = "report.html") -> None:
    """Write the page: for each exercise the code, the check's text and its picture.

    Args:
        name: the student's name; default: none is written.
        file: the page's path.
    """
    progress = ProgressFile()
    path = progress.folder / file
    write_atomically(path, page(progress, name))
    line = f"The report is in `{path.name}`, beside your notebooks."
    put(card("green", "Written.", [line]), line)


def page(progress: ProgressFile, name: str = "") -> str:
    """Return the page's HTML; everything from outside is escaped."""
    entries, predictions = progress.entries(), progress.predictions()
    course, work = lessons(), []
    for lesson in course:
        begun = [each for each in lesson.exercises if each in entries]
        guessed = {each: predictions[each] for each in predictions if each[:2] == lesson.number}
        if begun or guessed:
            code = codes(progress.folder / f"{lesson.name}.ipynb")
            exercises = [
                (find(each), entries[each], code.get(each), _picture(progress, each))
                for each in begun
            ]
            work.append((lesson.title, exercises, guessed))
    return render_html(
        "lessons/report_page.html",
        student=name,
        passed=sum(entry.passed for _, exercises, _ in work for _, entry, _, _ in exercises),
        total=sum(len(lesson.exercises) for lesson in course),
        date=f"{datetime.now():%Y-%m-%d %H:%M}",
        work=work,
        colours=PALETTE,
        shown=shown,
    )


def codes(path: Path) -> Mapping[str, str]:
    """Return the sources of a notebook's exercise cells; empty if it can't be read."""
    try:
        plain: Any = json.loads(path.read_text(encoding="utf-8"))
        found = {}
        for cell in plain["cells"]:
            for tag in cell.get("metadata", {}).get("tags", []):
                if str(tag).startswith(EXERCISE):
                    source = cell["source"]
                    text = source if isinstance(source, str) else "".join(source)
                    found[tag.removeprefix(EXERCISE)] = text
    except (OSError, ValueError, TypeError, KeyError, AttributeError):
        return {}
    return found


def _picture(progress: ProgressFile, name: str) -> str:
    path = progress.picture(name)
    try:
        data = path.read_bytes() if path.stat().st_size <= MAX_PICTURE_BYTES else b""
    except OSError:
        return ""
    return address(data) if data else ""
