"""The check of an actuator."""

import math
from typing import Any

from ai4u_edu.base.errors import ActionError
from ai4u_edu.blocks import Actuator
from ai4u_edu.check.block_check import (
    DEFAULT_DECISIONS,
    BlockCheck,
    Options,
    format_error,
    run_static_checks,
    warn_of_groups,
)
from ai4u_edu.check.report import Outcome, Report
from ai4u_edu.check.rollout import Pose, Rollout, RolloutStep, Script, fresh, title_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene


def check_actuator(
    actuator: Actuator,
    *,
    scene: Scene | str | None = None,
    script: Script | None = None,
    seed: int = 0,
    decisions: int = DEFAULT_DECISIONS,
) -> Report:
    """Drive an agent at random with an actuator in a small world, and report what is wrong.

    The actuator must have a docstring; survive being written to a scene file and read back; accept
    every action in its space and refuse what is not a number; leave all bodies at finite positions;
    do the same for the same seed; keep nothing across a reset; leave the global random generators
    alone; and move something. A group that no body carries gives a warning.

    Args:
        actuator: is not changed; the check drives copies of it (with its ``handler``, if any).
        scene: a Scene or the name of one. By default a small world with the bodies "robot" (the
            agent's), "box", "ball", "other", "wall" and "step" and the area "goal". There the agent
            also has an actuator "move", unless this one has that name.
        script: called before each decision with the agent and the decision's number.
        seed: for the random actions and the world.
        decisions: length of each run.

    >>> from ai4u_edu import RBMoveActuator
    >>> check_actuator(RBMoveActuator()).ok
    True
    """
    options = Options(scene, script, seed, decisions)
    the_scene = options.the_scene()
    report = Report(title_of(actuator))
    copies: list[Actuator] = []

    def make() -> Rollout:
        copies.append(fresh(actuator))
        return Rollout(the_scene, copies[-1], script=script)

    checks = BlockCheck(
        report,
        make,
        options,
        of=_effects,
        words=_("places of all bodies and traces"),
    )
    run_static_checks(report, actuator, _("what it does"))
    if checks.run():
        warn_of_groups(report, [("", actuator)], checks.view)
        report.add(_("finite"), _not_finite([poses for poses, _traces in checks.values()]))
        _refuses(report, copies[0])
        without = checks.drive(Rollout(the_scene, without=actuator, script=script))
        _has_effect(report, checks.values(), [_effects(record) for record in without])
    return report


def _effects(record: RolloutStep) -> tuple[dict[str, Pose], object]:
    return record.poses, record.traces


def _not_finite(values: list[dict[str, Pose]]) -> str:
    for number, poses in enumerate(values):
        for name, pose in poses.items():
            if not math.isfinite(sum(pose)):
                return _(
                    "expected every body at a finite place, got body {name!r} at {pose} after "
                    "decision {number}; does it divide by zero?",
                    name=name,
                    pose=str(pose),
                    number=number,
                )
    return ""


def _refuses(report: Report, actuator: Actuator) -> None:
    size = len(actuator.limits()[0])
    if not size:
        report.add(_("refuses"), _("it takes no numbers"), outcome=Outcome.NOT_APPLICABLE)
        return
    wrong: list[Any] = [[math.nan] * size, [0.0] * (size + 1), "go"]
    for values in wrong:
        try:
            actuator.accept(values)
            problem: str = _("no error")
        except ActionError:
            continue
        except Exception as error:  # whatever it is, the report says it
            problem = format_error(error)
        report.add(
            _("refuses"),
            _(
                "expected an ActionError for the action {values}, got {problem}; let "
                "Actuator.accept look at it first",
                values=repr(values),
                problem=problem,
            ),
        )
        return
    report.add(_("refuses"))


def _has_effect(report: Report, values: list[Any], without: list[Any]) -> None:
    idle = values == without
    report.add(
        _("has an effect"),
        _(
            "expected bodies at other places than without it, or ink, got all the same; if it "
            "needs something that is not here, check it in another scene, by scene=..."
        )
        if idle
        else "",
        outcome=Outcome.WARNING if idle else None,
    )
