"""Whether a brain, or a controller, keeps its promises."""

from collections.abc import Callable, Sequence
from typing import Any

from ai4u_edu.blocks import Actuator, Block, Brain, Controller, LocalBrain
from ai4u_edu.check.block_check import DECISIONS, Exam, Options
from ai4u_edu.check.report import Report
from ai4u_edu.check.rollout import Script, Trial, fresh, title_of
from ai4u_edu.check.static_checks import check_papers
from ai4u_edu.scenes import Scene


def check_controller(
    controller: Controller,
    *,
    actuators: Sequence[Actuator] = (),
    scene: Scene | str | None = None,
    script: Script | None = None,
    seed: int = 0,
    decisions: int = DECISIONS,
) -> Report:
    """Lets a controller drive in a small world, and tells what is wrong with it.

    It has to be documented; come back from a scene file as it was; answer every percept with an
    action that the agent's actuators take, or a command; answer the same from the same seed; forget
    everything at a reset; leave the global generators alone. One that always answers the same gets
    a warning. Meanwhile keys are pressed at random.

    Args:
        controller: stays as it is; copies of it drive.
        actuators: what the agent has besides an RBMoveActuator "move", or in its place.
        scene: where, a Scene or the name of one; left out: a small world with bodies "robot" (the
            agent's), "box", "ball", "other", "wall" and "step" and an area "goal".
        script: what a script does besides, called before each decision with the agent and the
            decision's number.
        seed: of the keys and the world.
        decisions: how long each run is.

    >>> from ai4u_edu import WASDRBMoveController
    >>> check_controller(WASDRBMoveController()).ok
    True
    """
    options = Options(scene, script, seed, decisions)
    return _examined(controller, options, actuators, lambda copy: LocalBrain(controller=copy))


def check_brain(
    brain: Brain,
    *,
    actuators: Sequence[Actuator] = (),
    scene: Scene | str | None = None,
    script: Script | None = None,
    seed: int = 0,
    decisions: int = DECISIONS,
) -> Report:
    """As :func:`check_controller`, for a whole brain.

    >>> from ai4u_edu import LocalBrain, WASDRBMoveController
    >>> check_brain(LocalBrain(controller=WASDRBMoveController())).ok
    True
    """
    options = Options(scene, script, seed, decisions)
    return _examined(brain, options, actuators, lambda copy: copy)


def _examined(
    block: Block,
    options: Options,
    actuators: Sequence[Actuator],
    brain_of: Callable[[Any], Brain],
) -> Report:
    scene = options.the_scene()
    report = Report(title_of(block))
    exam = Exam(
        report,
        lambda: Trial(
            scene,
            brain_of(fresh(block)),
            actuators=fresh(list(actuators)),
            script=options.script,
        ),
        options,
        of=lambda record: record.answer,
        words="answers",
    )
    check_papers(report, block, "what it does")
    if exam.run():
        exam.changes(warning=True)
    return report
