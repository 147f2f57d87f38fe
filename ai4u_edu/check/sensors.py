"""Whether a sensor keeps its promises."""

from itertools import pairwise
from typing import Any

import numpy as np
from gymnasium import spaces

from ai4u_edu.blocks import Sensor
from ai4u_edu.check.block_check import DECISIONS, Exam, Options, short
from ai4u_edu.check.ineffective import warn_of_groups
from ai4u_edu.check.report import Outcome, Report
from ai4u_edu.check.rollout import Script, Trial, fresh, title_of
from ai4u_edu.check.static_checks import check_papers
from ai4u_edu.scenes import Scene


def check_sensor(
    sensor: Sensor,
    *,
    scene: Scene | str | None = None,
    script: Script | None = None,
    seed: int = 0,
    decisions: int = DECISIONS,
) -> Report:
    """Drives a sensor about in a small world, and tells what is wrong with it.

    It has to be documented; come back from a scene file as it was; read finite numbers inside its
    space, in new memory each time; read the same from the same seed; forget everything at a reset;
    move nothing; leave the global generators alone; and read not always the same (where it is no
    input of a policy, that is a warning only). One that looks for groups that are not there gets a
    warning.

    Args:
        sensor: stays as it is; copies of it are driven.
        scene: where, a Scene or the name of one; left out: a small world with bodies "robot" (the
            agent's), "box", "ball", "other", "wall" and "step" and an area "goal".
        script: what a script does besides, called before each decision with the agent and the
            decision's number.
        seed: of the drive and the world.
        decisions: how long each run is.

    >>> from ai4u_edu import VelocitySensor
    >>> check_sensor(VelocitySensor()).ok
    True
    """
    key = sensor.perception_key
    options = Options(scene, script, seed, decisions)
    the_scene = options.the_scene()
    copies: list[Sensor] = []
    reads: list[Any] = []

    def make() -> Trial:
        copy = fresh(sensor)
        if not copies:
            _listen(copy, reads)
        copies.append(copy)
        return Trial(the_scene, copy, script=script)

    report = Report(title_of(sensor))
    exam = Exam(
        report,
        make,
        options,
        of=lambda record: next(iter(record.percepts.values()))[key],
        words="readings",
    )
    check_papers(report, sensor, "what it reads")
    if exam.run(forgets="" if sensor.resetable else "resetable is off"):
        warn_of_groups(report, [("", sensor)], exam.view)
        values = exam.values()
        report.add(
            "finite",
            _not_finite(values),
            outcome=Outcome.NOT_APPLICABLE if isinstance(values[0], str | tuple) else None,
        )
        report.add("in its space", _outside(values, copies[0].observation_space()))
        _unshared(report, reads)
        exam.only_looks(Trial(the_scene, without=sensor, script=script))
        exam.changes(warning=not sensor.is_input)
    return report


def not_in(space: spaces.Space[Any], reading: Any) -> str:
    """What a space holds, if it does not hold a reading; empty if it does."""
    if isinstance(space, spaces.Box):
        array = np.asarray(reading, np.float64)
        slack = 1e-5 * (1 + np.abs(array))
        if (array < space.low - slack).any() or (array > space.high + slack).any():
            return f"numbers from {space.low.min():g} to {space.high.max():g}"
        return ""
    if isinstance(space, spaces.Text):
        texts = reading if isinstance(reading, tuple) else (reading,)
        fits = all(len(each) <= space.max_length for each in texts)
        return "" if fits else f"up to {space.max_length} characters"
    if isinstance(space, spaces.Sequence):
        return next(filter(None, (not_in(space.feature_space, each) for each in reading)), "")
    if isinstance(space, spaces.Tuple):
        if len(reading) != len(space.spaces):
            return f"{len(space.spaces)} texts"
        return next(filter(None, map(not_in, space.spaces, reading)), "")
    return "" if space.contains(np.int64(reading)) else str(space)


def _listen(sensor: Any, reads: list[Any]) -> None:
    """From now on, what the sensor's read returns is also kept in a list."""
    inner = sensor.read

    def read(body: Any, view: Any) -> Any:
        reads.append(inner(body, view))
        return reads[-1]

    sensor.read = read


def _not_finite(values: list[Any]) -> str:
    if isinstance(values[0], str | tuple):
        return "it reads text"
    for number, value in enumerate(values):
        if not np.isfinite(value).all():
            return (
                f"expected finite numbers, got {short(value)} after decision {number}; "
                "does it divide by zero, or take the root of a negative number?"
            )
    return ""


def _outside(values: list[Any], space: spaces.Space[Any]) -> str:
    for number, value in enumerate(values):
        expected = not_in(space, value)
        if expected:
            return (
                f"expected {expected} as its space() says, got {short(value)} after decision "
                f"{number}; widen the space, or cut the reading"
            )
    return ""


def _unshared(report: Report, reads: list[Any]) -> None:
    if not reads:
        why = "it writes its reading in place, and a percept is a copy"
        report.add("unshared", why, outcome=Outcome.NOT_APPLICABLE)
        return
    arrays = [read for read in reads if isinstance(read, np.ndarray)]
    shared = any(np.shares_memory(one, other) for one, other in pairwise(arrays))
    report.add(
        "unshared",
        "expected a new array from every read, got the same memory twice; return a copy of it"
        if shared
        else "",
    )
