"""Draws the picture at the head of each lesson: ``python -m tests.lessons.goals [03 ...]``.

A lesson whose picture is not described here gets the picture that the check of its last exercise
gives the solution.
"""

import os
import sys
import tempfile
from collections.abc import Callable
from typing import Any

from ai4u_edu import trained_brain
from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.course import course_folder, lessons
from ai4u_edu.lessons.rollouts import drives
from tests.lessons.workbook import tried


def way(scene: str, brain: Any, seed: int = 1, limit: int = 600) -> bytes:
    """A scene at the end of a drive, and the way there."""
    (drive,) = drives(scene, brain, [seed], limit=limit)
    return drive.picture()


def to_box(percept: Any) -> Any:
    """Turns until the cosine is large, then drives."""
    return {"move": [1, 0, 0, 0] if percept["orientation"][0] > 0.99 else [0, 0.2, 0, 0]}


def solved(exercise: str) -> bytes:
    """The picture that the check of an exercise gives its solution."""
    (lesson,) = (each for each in lessons() if exercise in each.exercises)
    return tried(lesson, exercise, answers_to(exercise).solution).picture


GOALS: dict[str, Callable[[], bytes]] = {
    "00": lambda: way("box_chase", to_box, seed=3),
    "03": lambda: solved("03.2"),
    "04": lambda: solved("04.1"),
    "06": lambda: solved("06.2"),
    "12": lambda: solved("12.1"),
    "13": lambda: solved("13.2"),
    "15": lambda: solved("15.2"),
    "07": lambda: solved("07.2"),
    "08": lambda: solved("08.2"),
    "09": lambda: way("box_chase", trained_brain("zoo:box_chase"), seed=7),
    "10": lambda: solved("10.3"),
    "11": lambda: solved("11.2"),
}


def main() -> None:
    """Draws all, or those whose numbers are given."""
    os.environ["AI4U_FAST"] = "1"
    folder = course_folder() / "pictures"
    wanted = sys.argv[1:]
    with tempfile.TemporaryDirectory() as elsewhere:
        os.chdir(elsewhere)
        for lesson in lessons():
            if wanted and lesson.number not in wanted:
                continue
            drawn = GOALS.get(lesson.number)
            data = drawn() if drawn else solved(lesson.exercises[-1])
            assert data, f"{lesson.number}: no picture"
            path = folder / f"{lesson.number}.png"
            path.write_bytes(data)
            print(f"{path}: {len(data) / 1000:.0f} kB")


if __name__ == "__main__":
    main()
