"""Runs lessons as plain scripts, one after another, and says what came of it as JSON.

``python -m tests.lessons.run_lessons FOLDER 00 01`` with the unfinished cells in place.
"""

import json
import os
import sys
import time
import traceback
from contextlib import redirect_stdout
from dataclasses import asdict
from io import StringIO
from pathlib import Path
from typing import Any

from ai4u_edu.lessons import stop
from ai4u_edu.lessons.course import Lesson, lesson
from ai4u_edu.lessons.progress_file import ProgressFile
from tests.lessons.workbook import run


def through(one: Lesson, folder: Path) -> dict[str, Any]:
    """Runs a lesson's cells in a folder of its own."""
    folder.mkdir()
    os.chdir(folder)
    names: dict[str, Any] = {"__name__": "__main__"}
    error, words, began = "", StringIO(), time.perf_counter()
    with redirect_stdout(words):
        for number, cell in enumerate(one.cells):
            if cell.is_text:
                continue
            try:
                run(cell, names, f"<lesson {one.number}, cell {number}>")
            except Exception:
                error = traceback.format_exc()
                break
        stop()
    entries = {name: asdict(entry) for name, entry in ProgressFile().entries().items()}
    seconds = time.perf_counter() - began
    return {"error": error, "entries": entries, "words": words.getvalue(), "seconds": seconds}


def main() -> None:
    """Runs them."""
    folder = Path(sys.argv[1]).absolute()
    told = {each: through(lesson(each), folder / each) for each in sys.argv[2:]}
    print(json.dumps(told))


if __name__ == "__main__":
    main()
