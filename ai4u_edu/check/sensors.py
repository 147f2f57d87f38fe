"""The check of a sensor."""

from itertools import pairwise
from typing import Any

import numpy as np
from gymnasium import spaces

from ai4u_edu.blocks import Sensor
from ai4u_edu.check.block_check import (
    DEFAULT_DECISIONS,
    BlockCheck,
    Options,
    run_static_checks,
    short,
    warn_of_groups,
)
from ai4u_edu.check.report import Outcome, Report
from ai4u_edu.check.rollout import Rollout, Script, fresh, title_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene


def check_sensor(
    sensor: Sensor,
    *,
    scene: Scene | str | None = None,
    script: Script | None = None,
    seed: int = 0,
    decisions: int = DEFAULT_DECISIONS,
) -> Report:
    """Drive an agent at random in a small world, and report what is wrong with a sensor.

    The sensor must have a docstring; survive being written to a scene file and read back; read
    finite numbers inside its space, in a new array each time; read the same for the same seed; keep
    nothing across a reset; move nothing; leave the global random generators alone; and change its
    reading at some time (only a warning if it is no policy input). A group that no body carries
    gives a warning.

    Args:
        sensor: is not changed; the check runs copies of it.
        scene: a Scene or the name of one. By default a small world with the bodies "robot" (the
            agent's), "box", "ball", "other", "wall" and "step" and the area "goal".
        script: called before each decision with the agent and the decision's number.
        seed: for the random actions and the world.
        decisions: length of each run.

    >>> from ai4u_edu import VelocitySensor
    >>> check_sensor(VelocitySensor()).ok
    True
    """
    options = Options(scene, script, seed, decisions)
    the_scene = options.the_scene()
    copies: list[Sensor] = []
    reads: list[Any] = []

    def make() -> Rollout:
        copy = fresh(sensor)
        if not copies:
            _record_reads(copy, reads)
        copies.append(copy)
        return Rollout(the_scene, copy, script=script)

    report = Report(title_of(sensor))
    checks = BlockCheck(
        report,
        make,
        options,
        of=lambda record: next(iter(record.percepts.values()))[sensor.perception_key],
        words=_("readings"),
    )
    run_static_checks(report, sensor, _("what it reads"))
    if checks.run(reset_exemption="" if sensor.resetable else _("resetable is off")):
        warn_of_groups(report, [("", sensor)], checks.view)
        values = checks.values()
        is_text = isinstance(values[0], str | tuple)
        outcome = Outcome.NOT_APPLICABLE if is_text else None
        report.add(_("finite"), _not_finite(values), outcome=outcome)
        report.add(_("in its space"), _out_of_space(values, copies[0].observation_space()))
        _unshared(report, reads)
        checks.only_looks(Rollout(the_scene, without=sensor, script=script))
        checks.changes(warning=not sensor.is_input)
    return report


def not_in(space: spaces.Space[Any], reading: Any) -> str:
    """Return a description of a space that does not contain a reading; empty if it does."""
    if isinstance(space, spaces.Box):
        array = np.asarray(reading, np.float64)
        slack = 1e-5 * (1 + np.abs(array))
        if (array < space.low - slack).any() or (array > space.high + slack).any():
            low, high = float(space.low.min()), float(space.high.max())
            return _("numbers from {low:g} to {high:g}", low=low, high=high)
        return ""
    if isinstance(space, spaces.Text):
        texts = reading if isinstance(reading, tuple) else (reading,)
        fits = all(len(each) <= space.max_length for each in texts)
        return "" if fits else _("up to {count} characters", count=space.max_length)
    if isinstance(space, spaces.Sequence):
        return next(filter(None, (not_in(space.feature_space, each) for each in reading)), "")
    if isinstance(space, spaces.Tuple):
        if len(reading) != len(space.spaces):
            return _("{count} texts", count=len(space.spaces))
        return next(filter(None, map(not_in, space.spaces, reading)), "")
    return "" if space.contains(np.int64(reading)) else str(space)


def _record_reads(sensor: Any, reads: list[Any]) -> None:
    """Wrap the sensor's ``read`` so that every result is also appended to a list."""
    inner = sensor.read

    def read(body: Any, view: Any) -> Any:
        reads.append(inner(body, view))
        return reads[-1]

    sensor.read = read


def _not_finite(values: list[Any]) -> str:
    if isinstance(values[0], str | tuple):
        return _("it reads text")
    for number, value in enumerate(values):
        if not np.isfinite(value).all():
            return _(
                "expected finite numbers, got {got} after decision {number}; does it divide by "
                "zero, or take the root of a negative number?",
                got=short(value),
                number=number,
            )
    return ""


def _out_of_space(values: list[Any], space: spaces.Space[Any]) -> str:
    for number, value in enumerate(values):
        expected = not_in(space, value)
        if expected:
            return _(
                "expected {expected} as its space() says, got {got} after decision {number}; widen "
                "the space, or cut the reading",
                expected=expected,
                got=short(value),
                number=number,
            )
    return ""


def _unshared(report: Report, reads: list[Any]) -> None:
    if not reads:
        why = _("it writes its reading in place, and a percept is a copy")
        report.add(_("unshared"), why, outcome=Outcome.NOT_APPLICABLE)
        return
    arrays = [read for read in reads if isinstance(read, np.ndarray)]
    shared = any(np.shares_memory(one, other) for one, other in pairwise(arrays))
    report.add(
        _("unshared"),
        _("expected a new array from every read, got the same memory twice; return a copy of it")
        if shared
        else "",
    )
