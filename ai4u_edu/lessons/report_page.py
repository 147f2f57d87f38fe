"""``report``: one page to hand in. Nothing leaves the machine; the file is the student's."""

import html
import json
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path
from typing import Any

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.colors import PALETTE
from ai4u_edu.lessons.course import lessons
from ai4u_edu.lessons.exercise import find
from ai4u_edu.lessons.notebook import EXERCISE
from ai4u_edu.lessons.notebook_output import address, card, put
from ai4u_edu.lessons.prediction_values import Prediction, shown
from ai4u_edu.lessons.progress_file import ExerciseProgress, ProgressFile

STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:48em;margin:2em auto;padding:0 1em}
pre{background:#f3f5f7;padding:.7em;overflow-x:auto}img{max-width:100%}
h3{margin-bottom:.2em}.text{margin:.2em 0}@media print{h2{break-before:page}}"""
MAX_PICTURE_BYTES = 3_000_000
"""Limit of a picture that is included."""


def report(name: str = "", file: str | Path = "report.html") -> None:
    """Write the page: for each exercise the code, the check's text and its picture.

    Args:
        name: the student's name; left out, none is written.
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
    parts, passed, total = [], 0, 0
    for lesson in lessons():
        done = [each for each in lesson.exercises if each in entries]
        passed += sum(entries[each].passed for each in done)
        total += len(lesson.exercises)
        guessed = {
            name: each for name, each in predictions.items() if name.startswith(lesson.number)
        }
        if done or guessed:
            code = codes(progress.folder / f"{lesson.name}.ipynb")
            parts.append(f"<h2>{html.escape(lesson.title)}</h2>")
            parts += [_exercise(progress, each, entries[each], code) for each in done]
            parts.append(_predictions(guessed))
    whose = f"{html.escape(name)}: " if name else ""
    title = f"{whose}AI4U Edu lessons"
    policy = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
        f"<style>{STYLE}</style></head><body><h1>{title}</h1>"
        f"<p>{passed} of {total} exercises solved; {datetime.now():%Y-%m-%d %H:%M}.</p>"
        + "\n".join(parts)
        + "</body></html>\n"
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


def _exercise(
    progress: ProgressFile, name: str, entry: ExerciseProgress, code: Mapping[str, str]
) -> str:
    colour = PALETTE["green" if entry.passed else "vermillion"]
    how = f"solved {entry.when}" if entry.passed else "not yet"
    checks = f"{entry.tries} check{'' if entry.tries == 1 else 's'}"
    written = html.escape(entry.code or code.get(name, "(the code was not found)"))
    return (
        f"<h3>{html.escape(name)} {html.escape(find(name).title)}</h3>"
        f'<p class="text"><b style="color:{colour}">{html.escape(how)}</b>, {checks}</p>'
        f'<pre>{written}</pre><p class="text">{html.escape(entry.text)}</p>'
        f"{_picture(progress, name)}"
    )


def _predictions(guessed: Mapping[str, Prediction]) -> str:
    """Return the list of a lesson's predictions; empty if there are none."""
    items = "".join(
        f"<li>{html.escape(f'{name}: said {shown(each.guess)}')}"
        + ("" if each.actual is None else html.escape(f"; it was {shown(each.actual)}"))
        + "</li>"
        for name, each in guessed.items()
    )
    return f"<h3>Predictions</h3><ul>{items}</ul>" if items else ""


def _picture(progress: ProgressFile, name: str) -> str:
    path = progress.picture(name)
    try:
        data = path.read_bytes() if path.stat().st_size <= MAX_PICTURE_BYTES else b""
    except OSError:
        return ""
    return f'<img alt="what the check saw" src="{address(data)}">' if data else ""
