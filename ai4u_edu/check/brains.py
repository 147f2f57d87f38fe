"""The checks of controllers and brains."""

from collections.abc import Callable, Sequence
from typing import Any

from ai4u_edu.blocks import Actuator, Block, Brain, Controller, LocalBrain
from ai4u_edu.check.block_check import (
    DEFAULT_DECISIONS,
    BlockCheck,
    Options,
    run_static_checks,
)
from ai4u_edu.check.report import Report
from ai4u_edu.check.rollout import Rollout, Script, fresh, title_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene


def check_controller(
    controller: Controller,
    *,
    actuators: Sequence[Actuator] = (),
    scene: Scene | str | None = None,
    script: Script | None = None,
    seed: int = 0,
    decisions: int = DEFAULT_DECISIONS,
) -> Report:
    """Let a controller drive an agent in a small world, and report what is wrong.

    The controller must have a docstring; survive being written to a scene file and read back;
    answer every percept with an action that the agent's actuators accept, or with a command; answer
    the same for the same seed; keep nothing across a reset; and leave the global random generators
    alone. An answer that never changes gives a warning. Keys are pressed at random meanwhile.

    Args:
        controller: is not changed; the check runs copies of it.
        actuators: added to the agent's RBMoveActuator "move"; one of that name replaces it.
        scene: a Scene or the name of one. By default a small world with the bodies "robot" (the
            agent's), "box", "ball", "other", "wall" and "step" and the area "goal".
        script: called before each decision with the agent and the decision's number.
        seed: for the keys and the world.
        decisions: length of each run.

    >>> from ai4u_edu import WASDRBMoveController
    >>> check_controller(WASDRBMoveController()).ok
    True
    """
    options = Options(scene, script, seed, decisions)
    return _check(controller, options, actuators, lambda copy: LocalBrain(controller=copy))


def check_brain(
    brain: Brain,
    *,
    actuators: Sequence[Actuator] = (),
    scene: Scene | str | None = None,
    script: Script | None = None,
    seed: int = 0,
    decisions: int = DEFAULT_DECISIONS,
) -> Report:
    """Let a brain drive an agent in a small world; checks as in :func:`check_controller`.

    >>> from ai4u_edu import LocalBrain, WASDRBMoveController
    >>> check_brain(LocalBrain(controller=WASDRBMoveController())).ok
    True
    """
    options = Options(scene, script, seed, decisions)
    return _check(brain, options, actuators, lambda copy: copy)


def _check(
    block: Block,
    options: Options,
    actuators: Sequence[Actuator],
    brain_of: Callable[[Any], Brain],
) -> Report:
    scene = options.the_scene()
    report = Report(title_of(block))
    checks = BlockCheck(
        report,
        lambda: Rollout(
            scene,
            brain_of(fresh(block)),
            actuators=fresh(list(actuators)),
            script=options.script,
        ),
        options,
        of=lambda record: record.answer,
        words=_("answers"),
    )
    run_static_checks(report, block, _("what it does"))
    if checks.run():
        checks.changes(warning=True)
    return report
