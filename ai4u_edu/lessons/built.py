"""Exercises whose answer is built of blocks: a robot, its sensors, its rewards or its pace.

The robot may be built anywhere, such as in the tab Build of a mission's page; the exercise's own
judge looks at it.
"""

from collections.abc import Callable, Mapping
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.lessons.calls import Judged
from ai4u_edu.lessons.exercise import NotYet, find

MakeAgent = Callable[[], BasicAgent]
BUILT: Mapping[str, Callable[[MakeAgent], Any]] = {
    "03.1": lambda make: make(),
    "03.2": lambda make: make(),
    "03.3": lambda make: make(),
    "04.4": lambda make: list(make().sensors),
    "04.5": lambda make: list(make().sensors),
    "08.2": lambda make: make().brain.skip_frame,
    "09.2": lambda make: lambda: list(make().rewards),
    "09.3": lambda make: lambda: list(make().rewards),
}
"""Functions that take from a robot the part that a judge gets, by the exercise's id."""


def judge_built(exercise_id: str, make: MakeAgent) -> Judged:
    """Judge a robot.

    Args:
        exercise_id: one of :data:`BUILT`.
        make: makes the robot, new each time.
    """
    exercise = find(exercise_id)
    try:
        result = exercise.judge(BUILT[exercise_id](make))
    except NotYet as reason:
        return Judged(False, reason.text, exercise.hints.get(reason.hint, ""))
    return Judged(True, result if isinstance(result, str) else result.text)
