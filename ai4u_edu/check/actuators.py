"""Whether an actuator keeps its promises."""

import math
from typing import Any

from ai4u_edu.base.errors import ActionError
from ai4u_edu.blocks import Actuator
from ai4u_edu.check.block_check import DECISIONS, Exam, Options, said
from ai4u_edu.check.ineffective import warn_of_groups
from ai4u_edu.check.report import Outcome, Report
from ai4u_edu.check.rollout import Pose, Script, Trial, fresh, title_of
from ai4u_edu.check.static_checks import check_papers
from ai4u_edu.scenes import Scene


def check_actuator(
    actuator: Actuator,
    *,
    scene: Scene | str | None = None,
    script: Script | None = None,
    seed: int = 0,
    decisions: int = DECISIONS,
) -> Report:
    """Drives with an actuator in a small world, and tells what is wrong with it.

    It has to be documented; come back from a scene file as it was; take whatever its space holds
    and refuse what is no number; leave all bodies at places that are finite; do the same from the
    same seed; forget everything at a reset; leave the global generators alone; and move something.
    One that looks for groups that are not there gets a warning.

    Args:
        actuator: stays as it is; copies of it (with its ``handler``, if it has one) are driven.
        scene: where, a Scene or the name of one; left out: a small world with bodies "robot" (the
            agent's), "box", "ball", "other", "wall" and "step" and an area "goal". The agent can
            move besides, by an actuator "move", unless this one is called so.
        script: what a script does besides, called before each decision with the agent and the
            decision's number.
        seed: of the drive and the world.
        decisions: how long each run is.

    >>> from ai4u_edu import RBMoveActuator
    >>> check_actuator(RBMoveActuator()).ok
    True
    """
    options = Options(scene, script, seed, decisions)
    the_scene = options.the_scene()
    report = Report(title_of(actuator))
    copies: list[Actuator] = []

    def make() -> Trial:
        copies.append(fresh(actuator))
        return Trial(the_scene, copies[-1], script=script)

    exam = Exam(
        report,
        make,
        options,
        of=lambda record: record.poses,
        words="places of all bodies",
    )
    check_papers(report, actuator, "what it does")
    if exam.run():
        warn_of_groups(report, [("", actuator)], exam.view)
        report.add("finite", _not_finite(exam.values()))
        _refuses(report, copies[0])
        without = exam.drive(Trial(the_scene, without=actuator, script=script))
        _has_effect(report, exam.values(), [record.poses for record in without])
    return report


def _not_finite(values: list[dict[str, Pose]]) -> str:
    for number, poses in enumerate(values):
        for name, pose in poses.items():
            if not math.isfinite(sum(pose)):
                return (
                    f"expected every body at a finite place, got body {name!r} at {pose} after "
                    f"decision {number}; does it divide by zero?"
                )
    return ""


def _refuses(report: Report, actuator: Actuator) -> None:
    size = len(actuator.limits()[0])
    if not size:
        report.add("refuses", "it takes no numbers", outcome=Outcome.NOT_APPLICABLE)
        return
    wrong: list[Any] = [[math.nan] * size, [0.0] * (size + 1), "go"]
    for values in wrong:
        try:
            actuator.accept(values)
            problem = "no error"
        except ActionError:
            continue
        except Exception as error:  # whatever it is, the report says it
            problem = said(error)
        report.add(
            "refuses",
            f"expected an ActionError for the action {values!r}, got {problem}; "
            "let Actuator.accept look at it first",
        )
        return
    report.add("refuses")


def _has_effect(report: Report, values: list[Any], without: list[Any]) -> None:
    idle = values == without
    report.add(
        "has an effect",
        "expected bodies at other places than without it, got all at the same; if it needs "
        "something that is not here, check it in another scene, by scene=..."
        if idle
        else "",
        outcome=Outcome.WARNING if idle else None,
    )
