"""Runs lessons as plain scripts, one after another, and says what came of it as JSON.

``python -m tests.lessons.run_lessons FOLDER 00 01`` with the unfinished cells in place; with
``--solved`` the solutions are there instead.
"""

import argparse
import json
import os
import traceback
from contextlib import redirect_stdout
from dataclasses import asdict
from io import StringIO
from pathlib import Path
from typing import Any

from ai4u_edu.lessons import stop
from ai4u_edu.lessons.course import Lesson, lesson
from ai4u_edu.lessons.progress_file import ProgressFile
from tests.lessons.workbook import be_patient, run, solution_of, solved


def through(one: Lesson, folder: Path, *, is_solved: bool) -> dict[str, Any]:
    """Runs a lesson's cells in a folder of its own."""
    answers = {each: solution_of(each) for each in one.exercises} if is_solved else {}
    folder.mkdir()
    os.chdir(folder)
    names: dict[str, Any] = {"__name__": "__main__"}
    be_patient(one)
    error, words = "", StringIO()
    with redirect_stdout(words):
        for number, cell in enumerate(solved(one, answers)):
            if cell.is_text:
                continue
            try:
                run(cell, names, f"<lesson {one.number}, cell {number}>")
            except Exception:
                error = traceback.format_exc()
                break
        stop()
    entries = {name: asdict(entry) for name, entry in ProgressFile().entries().items()}
    return {"error": error, "entries": entries, "words": words.getvalue()}


def main() -> None:
    """Runs them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("lessons", nargs="+")
    parser.add_argument("--solved", action="store_true")
    options = parser.parse_args()
    folder = options.folder.absolute()
    told = {
        each: through(lesson(each), folder / each, is_solved=options.solved)
        for each in options.lessons
    }
    print(json.dumps(told))


if __name__ == "__main__":
    main()
