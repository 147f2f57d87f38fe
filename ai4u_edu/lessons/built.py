"""Exercises whose answer is built of blocks: a robot, its sensors, its rewards or its pace.

The robot may be built anywhere, such as in the tab Build of a mission's page; the exercise's own
judge looks at it.
"""

from collections.abc import Callable, Mapping
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.lessons.calls import Judged
from ai4u_edu.lessons.exercise import NotYet, find
from ai4u_edu.locale import gettext as _

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

PAGE_HINTS: Mapping[str, Mapping[str, str]] = {
    "03.1": {
        "actuator": _("An actuator is missing: press *Actuator*, and choose *Drive and jump*."),
        "speed": _("The *speed* of *Drive and jump* is what the number 1 stands for."),
        "turn": _("The *turning speed* of *Drive and jump* is what the number 1 stands for."),
    },
    "03.2": {
        "sensors": _(
            "Press *Sensor*, twice: one tells the direction of the box, the other one whether it "
            "is touched."
        ),
        "bearing": _(
            "One reading has to tell left from right: the sensor *Direction to ...*, with the box "
            "as its target."
        ),
        "touch": _(
            "One reading has to be 1 while the robot touches the box, and -1 otherwise: the "
            "sensor *Bumper*."
        ),
    },
    "03.3": {
        "rewards": _("Press *Reward*: you need *Reach the target* for the box, and *Fall*."),
        "amount": _("The *reward* of *Reach the target* says how much the touch pays."),
        "end": _(
            "The episode goes on after the touch. In the card of the reward, open *More*, and "
            "switch on *cause episode to end*."
        ),
        "fall": _("A fall should cost 1. That is what the reward *Fall* pays."),
    },
    "04.4": {
        "narrow": _(
            "*field of view* is the angle that the rays cover; between few rays there are gaps: "
            "*number of rays*."
        ),
    },
    "04.5": {
        "wall": _(
            "The wall is not seen. Not only rays are stopped by a wall: look at *visibility test* "
            "of *Direction and distance*."
        ),
        "many": _(
            "It works, and with fewer numbers too. *Direction and distance* can tell only one of "
            "its two: look at *info*."
        ),
    },
    "09.2": {
        "linger": _(
            "Somebody gets more than the runner by staying near, or by dancing. A trail must pay "
            "for *getting* nearer, and take it back when the robot goes away again: *Every metre "
            "closer*."
        ),
    },
    "09.3": {
        "time": _(
            "Runner and stroller get the same. Let each decision cost a little: a number below 0 "
            "in *Stand still*."
        ),
        "pays": _("Time pays, but it should cost: the number in *Stand still* has to be below 0."),
    },
}
"""Hints in the words of the tab Build, by exercise and diagnosis; the lessons' are about code."""


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
        hints = {**exercise.hints, **PAGE_HINTS.get(exercise_id, {})}
        return Judged(False, reason.text, hints.get(reason.hint, ""))
    return Judged(True, result if isinstance(result, str) else result.text)
