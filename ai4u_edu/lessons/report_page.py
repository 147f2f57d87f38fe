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
from ai4u_edu.lessons.prediction_values import Prediction, shown
from ai4u_edu.lessons.progress_file import ExerciseProgress, ProgressFile
from ai4u_edu.lessons.translation import translated_title
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext, translate

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
    line = _("The report is in `{file}`, beside your notebooks.", file=path.name)
    put(card("green", _("Written."), [line]), translate(line))


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
            work.append((translated_title(lesson), exercises, guessed))
    return render_html(
        "lessons/report_page.html",
        title=translate(_title(name)),
        summary=translate(
            _(
                "{passed} of {total} exercises solved; {date}.",
                passed=sum(entry.passed for _l, rows, _g in work for _e, entry, *_more in rows),
                total=sum(len(lesson.exercises) for lesson in course),
                date=datetime.now().strftime("%Y-%m-%d %H:%M"),
            )
        ),
        no_code=translate(_("(the code was not found)")),
        seen=translate(_("what the check saw")),
        predictions_head=translate(_("Predictions")),
        work=work,
        colours=PALETTE,
        translate=translate,
        state=_state,
        checks=_checks,
        guessed=_guessed,
    )


def _title(name: str) -> str:
    if name:
        return _("{name}: AI4U Edu lessons", name=name)
    return _("AI4U Edu lessons")


def _state(entry: ExerciseProgress) -> str:
    words = _("solved {when}", when=entry.when) if entry.passed else _("not yet")
    return translate(words)


def _checks(entry: ExerciseProgress) -> str:
    return translate(ngettext("{n} check", "{n} checks", entry.tries))


def _guessed(prediction: Prediction) -> str:
    guess = shown(prediction.guess)
    if prediction.actual is None:
        return translate(_("said {guess}", guess=guess))
    return translate(
        _("said {guess}; it was {actual}", guess=guess, actual=shown(prediction.actual))
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
