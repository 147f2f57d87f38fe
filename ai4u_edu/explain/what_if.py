"""The action on a percept in which some numbers were changed by hand."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.blocks import Percept
from ai4u_edu.explain.groups import groups_of
from ai4u_edu.explain.occlusion import changed_percept
from ai4u_edu.explain.policy import Policy
from ai4u_edu.explain.sentence import Axis, axes_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.snapshot import AgentState
from ai4u_edu.snapshot.block_info import SensorInfo

MAX_DIALS = 128
"""Most numbers of one percept that can be changed by hand; those of larger readings can't."""
Changes = Mapping[tuple[str, int], float]
"""Values by perception key and index in one reading."""


@dataclass(frozen=True)
class Dial:
    """One number of the latest reading of a sensor, which can be changed."""

    key: str
    index: int
    name: str
    value: float
    low: float
    high: float


class WhatIf(NamedTuple):
    """The action as it is, and as it would be."""

    dials: tuple[Dial, ...]
    axes: tuple[Axis, ...]
    now: tuple[float, ...]
    then: tuple[float, ...]


def what_if(policy: Policy, agent: AgentState, changes: Changes) -> WhatIf:
    """Return a policy's action on an agent's percept, and on a changed one.

    Args:
        policy: the agent's.
        agent: the agent's state.
        changes: a changed number also changes in all older readings of a stack.

    Raises:
        SetupError: there is no such number.
    """
    percept = agent.percept
    inputs = set(policy.inputs(percept))
    infos = [info for info in agent.sensor_infos if info.key in inputs]
    now = policy.decide(percept)
    then = policy.decide(changed_by(percept, infos, changes))
    axes = axes_of(agent.actuator_infos, list(policy.answer(percept)))
    if len(axes) != len(now):
        axes = [Axis(name, -1.0, 1.0) for name in policy.components]
    dials = tuple(dial for info in infos for dial in _dials(info, agent))[:MAX_DIALS]
    return WhatIf(dials, tuple(axes), tuple(now.tolist()), tuple(then.tolist()))


def changed_by(percept: Percept, infos: Sequence[SensorInfo], changes: Changes) -> Percept:
    """Return a percept with other numbers, within the sensors' ranges.

    Raises:
        SetupError: there is no such number.
    """
    known = {info.key: info for info in infos}
    values: dict[str, npt.NDArray[Any]] = {}
    for (key, index), value in changes.items():
        if key not in known:
            raise SetupError(
                _("no input is called {key!r}; {hint}", key=key, hint=suggest(key, known))
            )
        info = known[key]
        if not 0 <= index < len(info.low):
            raise SetupError(
                _(
                    "{key}: expected a number from 0 to {count}, got {index}",
                    key=key,
                    count=len(info.low) - 1,
                    index=index,
                )
            )
        reading = values.setdefault(key, np.array(percept[key]))
        rows = reading.reshape(info.stack, -1)
        rows[:, index] = np.clip(value, info.low[index], info.high[index])
    changed = changed_percept(percept, values)
    assert isinstance(changed, Percept)  # noqa: S101 - it was one
    return changed


def _dials(info: SensorInfo, agent: AgentState) -> list[Dial]:
    reading = np.asarray(agent.percept[info.key])
    if reading.size != info.stack * len(info.low):
        return []
    latest = reading.reshape(info.stack, -1)[-1]
    found = []
    for group in groups_of([info], agent.rays, agent.spots, agent.percept):
        numbers = np.flatnonzero(group.mask[: len(info.low)])
        name = group.name
        parts: list[str] = [name]
        if len(numbers) > 1:
            parts = [_("what {ray} sees", ray=name), _("how far {ray} sees", ray=name)]
        found += [
            Dial(
                info.key,
                int(index),
                part,
                float(latest[index]),
                float(info.low[index]),
                float(info.high[index]),
            )
            for index, part in zip(numbers, parts, strict=False)
        ]
    return [dial for dial in found if np.isfinite([dial.low, dial.high]).all()]
