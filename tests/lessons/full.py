"""Runs the lessons at full length, with the solutions: ``python -m tests.lessons.full [09 ...]``.

Trainings train as long as they do for a student. Says for each lesson whether all checks passed,
how long it took, and its slowest cell.
"""

import os
import sys
import tempfile
from pathlib import Path

from ai4u_edu.lessons.course import lessons
from tests.lessons.kernel import executed


def main() -> int:
    """Runs all, or those whose numbers are given; returns how many are not in order."""
    os.environ.pop("AI4U_FAST", None)
    wanted, bad = sys.argv[1:], 0
    print("lesson  seconds  slowest cell  checks")
    for lesson in lessons():
        if wanted and lesson.number not in wanted:
            continue
        with tempfile.TemporaryDirectory() as folder:
            done = executed(lesson, Path(folder))
        failed = [each for each in lesson.exercises if not done.entries[each].passed]
        bad += bool(failed or done.complaints)
        said = f"not passed: {', '.join(failed)}" if failed else "all passed"
        told = f"; {done.complaints[0]}" if done.complaints else ""
        print(
            f"{lesson.number:<6}  {done.seconds:7.1f}  {done.slowest:12.1f}  {said}{told}",
            flush=True,
        )
    return bad


if __name__ == "__main__":
    sys.exit(main())
