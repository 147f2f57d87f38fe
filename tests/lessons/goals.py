"""Draws the picture at the head of each lesson: ``python -m tests.lessons.goals [03 ...]``.

A lesson whose picture is not described here gets the picture that the check of its last exercise
gives the solution.
"""

import io
import os
import sys
import tempfile
from collections.abc import Callable
from typing import Any

from ai4u_edu import trained_brain
from ai4u_edu.base.colors import PALETTE
from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.course import course_folder, is_ticket, lessons
from ai4u_edu.lessons.exercises.lesson_14_worlds import explore
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


def visits() -> bytes:
    """Times that walkers stood in each cell: exploring never, at first, or always."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(3.2, 2.4), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(3, 1, sharex=True)
    schedules = {"never": lambda *_: 0, "first": lambda n, _: n < 100, "always": lambda *_: 1}
    for panel, (name, epsilon), colour in zip(
        panels, schedules.items(), ("orange", "green", "blue"), strict=True
    ):
        panel.bar(range(8), explore(lambda *n, e=epsilon: float(e(*n)), seed=1).visits,
                  color=PALETTE[colour], edgecolor="black")  # fmt: skip
        panel.set(ylabel=name, yticks=[])
    panels[-1].set_xlabel("cell of the corridor")
    out = io.BytesIO()
    figure.savefig(out, dpi=100, format="png")
    return out.getvalue()


GOALS: dict[str, Callable[[], bytes]] = {
    "00": lambda: way("box_chase", to_box, seed=3),
    "04": lambda: solved("04.2"),
    "05": lambda: solved("05.1"),
    "08": lambda: solved("08.2"),
    "16": lambda: solved("16.1"),
    "18": lambda: solved("18.2"),
    "20": lambda: solved("20.2"),
    "21": lambda: solved("21.2"),
    "09": lambda: solved("09.2"),
    "15": lambda: solved("15.2"),
    "10": lambda: way("box_chase", trained_brain("zoo:box_chase"), seed=7),
    "11": lambda: solved("11.3"),
    "12": lambda: solved("12.2"),
    "17": lambda: solved("17.4"),
    "13": lambda: way("line_follow", trained_brain("zoo:line_follow")),
    "14": visits,
    "07": lambda: solved("07.1"),
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
            last = [each for each in lesson.exercises if not is_ticket(each)][-1]
            data = drawn() if drawn else solved(last)
            assert data, f"{lesson.number}: no picture"
            path = folder / f"{lesson.number}.png"
            path.write_bytes(data)
            print(f"{path}: {len(data) / 1000:.0f} kB")


if __name__ == "__main__":
    main()
