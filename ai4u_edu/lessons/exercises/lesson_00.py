"""Start here."""

import math
from typing import Any

import numpy as np

from ai4u_edu.lessons.exercise import Done, exercise
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.rollouts import Drive, drives, seeds_of
from ai4u_edu.locale import gettext as _

STEPS = 8
SCENE = "box_chase"

STILL = {
    "still": _(
        'An action is `{"move": [forward, turn, 0, 0]}`. The first number drives: 1 is '
        "full speed forward, -1 is full speed backward, and 0 is standing still."
    ),
}


def _turned(drive: Drive, heading: float) -> float:
    """Return the turn since the beginning, degrees counter-clockwise, of less than half a turn."""
    return math.degrees(math.remainder(drive.agent.body.heading - heading, math.tau))


def _turned_somewhere(drive: Drive) -> float:
    """Turn the robot into a direction drawn from the seed; return its heading, radians."""
    heading = float(np.random.default_rng(drive.seed).uniform(-math.pi, math.pi))
    drive.agent.body.move_to(*drive.agent.body.position, heading=heading)
    return heading


@exercise(
    "00.1",
    _("Make it go"),
    hints=STILL
    | {
        "backward": _("Your robot drove backward. What happens if you take the minus sign away?"),
        "circle": _(
            "It drives, and turns at the same time. The second number turns: here it has to be 0."
        ),
    },
)
def goes(drive_it: Any) -> Done:
    """Check that the robot drives forward, wherever it begins."""
    headings: list[float] = []

    def watch(drive: Drive) -> None:
        if drive.steps == 0:
            headings.append(_turned_somewhere(drive))

    for drive in drives(SCENE, drive_it, seeds_of("00.1", 12), limit=STEPS, watch=watch):
        (x, y), (u, v) = drive.trail[0], drive.trail[-1]
        forward = (u - x) * math.cos(headings[-1]) + (v - y) * math.sin(headings[-1])
        if forward < -0.1:
            raise drive.not_yet(
                _("Your robot drove backward ({where}).", where=drive.where), "backward"
            )
        if drive.moved < 0.1:
            raise drive.not_yet(_("Your robot hardly moved ({where}).", where=drive.where), "still")
        if abs(_turned(drive, headings[-1])) > 20:
            raise drive.not_yet(
                _("Your robot turned away from its course ({where}).", where=drive.where), "circle"
            )
        if forward < 0.25:
            raise drive.not_yet(_("Your robot hardly moved ({where}).", where=drive.where), "still")
    return Done(_("Your robot drives forward. It did so in 12 worlds."), drive.picture())


@exercise(
    "00.2",
    _("Make it turn left"),
    hints={
        "still": _(
            "The second number of the action turns. Keep the first one at 0, so that the "
            "robot stays where it is."
        ),
        "right": _("Your robot turned right. Left is the other sign: try a negative number."),
        "moved": _("Your robot drove away. The first number drives: it has to be 0 here."),
    },
)
def turns_left(drive_it: Any) -> Done:
    """Check that the robot turns left on the spot."""
    headings: list[float] = []

    def watch(drive: Drive) -> None:
        if drive.steps == 0:
            headings.append(_turned_somewhere(drive))

    for drive in drives(SCENE, drive_it, seeds_of("00.2", 12), limit=3, watch=watch):
        turned = _turned(drive, headings[-1])
        if drive.moved > 0.2:
            raise drive.not_yet(
                _("Your robot left its place ({where}).", where=drive.where), "moved"
            )
        if turned < -1:
            raise drive.not_yet(
                _(
                    "Your robot turned {turned:.0f} degrees to the right ({where}).",
                    turned=-turned,
                    where=drive.where,
                ),
                "right",
            )
        if turned < 1:
            raise drive.not_yet(
                _("Your robot hardly turned ({where}).", where=drive.where), "still"
            )
    return Done(_("Your robot turns left and stays on its spot."), drive.picture())


@exercise(
    "00.3",
    _("Fix it"),
    hints={
        "backward": _("It runs now, and goes backward. The first number has to be above 0."),
        "curve": _(
            "It runs now, well done. But the robot has to drive a curve to the right: both "
            "the first and the second number have to be above 0."
        ),
    },
)
def is_fixed(drive_it: Any) -> Done:
    """Check that the function runs, and drives a curve to the right."""
    headings: list[float] = []

    def watch(drive: Drive) -> None:
        if drive.steps == 0:
            headings.append(_turned_somewhere(drive))

    for drive in drives(SCENE, drive_it, seeds_of("00.3", 12), limit=4, watch=watch):
        (x, y), (u, v) = drive.trail[0], drive.trail[-1]
        forward = (u - x) * math.cos(headings[-1]) + (v - y) * math.sin(headings[-1])
        if forward < -0.1:
            raise drive.not_yet(
                _("Your robot drove backward ({where}).", where=drive.where), "backward"
            )
        if forward < 0.15 or _turned(drive, headings[-1]) > -1:
            raise drive.not_yet(
                _("No curve to the right yet ({where}).", where=drive.where), "curve"
            )
    return Done(_("Fixed: your robot drives a curve to the right."), drive.picture())


exit_ticket(
    "00.exit",
    Question(
        "a",
        {
            "b": _(
                "Below 0 the second number turns left, and above 0 the first one drives forward."
            ),
            "c": _(
                "The numbers do not come one after another. All four act at the same time, "
                "for one decision."
            ),
        },
    ),
    Question(
        "c",
        {
            "a": _("Python knows only what was run. The text of a cell counts when the cell runs."),
            "b": _(
                "There is a function called `go`: the one from the last time that its cell ran."
            ),
        },
    ),
    Question(
        "b",
        {
            "a": _("Python knows nothing about robots here. It says that a *name* is not known."),
            "c": _(
                "Running it again does not help: the same line fails again. Look for the "
                "name in it."
            ),
        },
    ),
)
