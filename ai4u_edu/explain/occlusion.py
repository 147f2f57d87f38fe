"""Occlusion: how far each number of an action moves when a slot of the percept says nothing.

Limits, to be said wherever a result is shown (:data:`LIMITS`): a slot that tells the same as
another one seems to matter less than it does, and a percept with one slot replaced may be one
that never occurs, for which nobody trained the network.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.blocks import Percept
from ai4u_edu.explain.baseline import Baseline, middle_for
from ai4u_edu.explain.errors import NotExplainableError
from ai4u_edu.explain.groups import Group, Kind, groups_by
from ai4u_edu.explain.policy import Floats, Percepts, Policy, PolicyLike
from ai4u_edu.locale import gettext as _

LIMITS = _(
    "One sensor number at a time is replaced by its average, or by the middle of its range. Two "
    "numbers that say the same can both seem unimportant, and the changed numbers may be some that "
    "never occur together."
)
"""The method's limits, in words for people."""
OTHER_NUMBERS = _(
    "the policy's action has other numbers for a changed percept; expected the same actuators in "
    "each answer"
)
SAME_ACTION = 1e-6
"""Largest difference of any number of two actions that count as the same."""
FEW_ALONE = 0.25
"""Share of what all groups do together below which a group alone hardly does anything."""
PROBES = 8
"""Percepts with random numbers that are tried to find out whether anything is looked at."""
MAX_PROBE = 10.0
"""Largest of these numbers."""


@dataclass(frozen=True)
class Occlusion:
    """The result of leaving out n groups of slots, for an action of c numbers."""

    groups: tuple[Group, ...]
    """The groups that were left out, one at a time."""
    components: tuple[str, ...]
    """Names of the action's numbers."""
    action: Floats
    """(c,) the action with everything there."""
    without: Floats
    """(n, c) the action without each group."""
    base: Floats | None = None
    """(c,) the action without all groups: everything has the baseline's values."""
    is_at_baseline: bool = False
    """True if all groups have the baseline's values now, so that nothing was left out."""
    together: tuple[int, ...] = ()
    """Indices of groups that move the action if all of them are left out, while each of them alone
    hardly does; empty if there are none."""
    is_deaf: bool = False
    """True if the action was the same for everything that was tried: nothing is looked at."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the groups."""
        return tuple(group.name for group in self.groups)

    @property
    def shift(self) -> Floats:
        """(n, c) how far each group moves each number: the action minus the one without it."""
        return _difference(self.action, self.without)

    @property
    def importance(self) -> Floats:
        """(n,) the largest movement of any number, in its own unit."""
        if not len(self.components):
            return np.zeros(len(self.groups))
        return np.asarray(np.abs(self.shift).max(axis=1, initial=0.0))

    @property
    def whole(self) -> Floats:
        """(c,) how far all groups together move each number: the action minus the base."""
        return _difference(self.action, self.action if self.base is None else self.base)

    def strongest(self) -> int:
        """Return the index of the group that matters most."""
        return int(self.importance.argmax())


def occlusion(
    policy: PolicyLike,
    percept: Percepts,
    *,
    baseline: Baseline | None = None,
    groups: Kind | Sequence[Group] = "slot",
) -> Occlusion:
    """Return how far each number of the action moves without each slot of a percept.

    Args:
        policy: a function from percept to action, a Controller, a network or its file.
        percept: an agent's, or a mapping from perception key to numbers.
        baseline: a reading for each key, from ``mean_of(percepts)`` or ``middle_of(agent)``; by
            default the middle of the ranges that a network's file describes.
        groups: ``slot`` for each number, ``sensor`` for each reading, or groups of one's own, such
            as ``groups_of_agent(agent)``.

    Raises:
        NotExplainableError: the decision is no function of the percept; says why.
        SetupError: there is no baseline, or it does not fit the percept.

    >>> steer = lambda percept: {"move": [1.0, 2 * percept["eyes"][0]]}
    >>> told = occlusion(steer, {"eyes": np.array([0.5, 0.9])}, baseline={"eyes": np.zeros(2)})
    >>> told.names, told.shift.tolist()
    (('eyes 0', 'eyes 1'), [[0.0, 1.0], [0.0, 0.0]])
    """
    asked = policy if isinstance(policy, Policy) else Policy(policy)
    if baseline is None:
        baseline = _baseline_for(asked)
    keys = asked.inputs(percept)
    chosen = groups_by(groups, percept, keys) if isinstance(groups, str) else list(groups)
    if isinstance(groups, str):
        chosen = [group for group in chosen if group.key in baseline]
    action = asked.decide(percept)
    rows = [asked.decide(without(percept, group, baseline)) for group in chosen]
    again = asked.decide(percept)
    if again.shape != action.shape or not np.array_equal(again, action, equal_nan=True):
        raise NotExplainableError(
            _(
                "the policy gave two different actions for the same percept, so its action does "
                "not follow from the percept alone; expected one that neither draws at random nor "
                "remembers"
            )
        )
    if any(len(row) != len(action) for row in rows):
        raise NotExplainableError(OTHER_NUMBERS)
    table = np.stack(rows) if rows else np.zeros((0, len(action)))
    components = asked.components
    search = _Search(asked, percept, chosen, baseline, action)
    everything = range(len(chosen))
    base = asked.decide(search.without(everything))
    if len(base) != len(action):
        raise NotExplainableError(OTHER_NUMBERS)
    whole, alone = _moved(base, action), max((_moved(row, action) for row in rows), default=0.0)
    is_still = whole <= SAME_ACTION and alone <= SAME_ACTION
    return Occlusion(
        tuple(chosen),
        components,
        action,
        table,
        base,
        is_at_baseline=bool(chosen) and search.is_at_baseline(),
        together=search.needed(whole) if alone < FEW_ALONE * whole else (),
        is_deaf=is_still and search.is_deaf(),
    )


def without(percept: Percepts, group: Group, baseline: Baseline) -> Percepts:
    """Return a percept in which a group of numbers has the baseline's values.

    Raises:
        SetupError: the baseline has no such reading, or one of another size.
    """
    if group.key not in baseline:
        raise SetupError(
            _(
                "the baseline has no {key!r}; {hint}",
                key=group.key,
                hint=suggest(group.key, baseline),
            )
        )
    reading = np.asarray(percept[group.key])
    other = np.asarray(baseline[group.key])
    if other.size != reading.size or len(group.mask) != reading.size:
        raise SetupError(
            _(
                "{key!r}: expected {size} numbers in the baseline and in the group, got {size2} "
                "and {count}",
                key=group.key,
                size=reading.size,
                size2=other.size,
                count=len(group.mask),
            )
        )
    changed = np.where(group.mask.reshape(reading.shape), other.reshape(reading.shape), reading)
    return changed_percept(percept, {group.key: changed.astype(reading.dtype)})


class _Search:
    """Leaves out several groups at once.

    Args:
        policy: the policy.
        percept: the percept.
        groups: all groups.
        baseline: a reading for each key.
        action: the action on the percept.
    """

    def __init__(
        self,
        policy: Policy,
        percept: Percepts,
        groups: Sequence[Group],
        baseline: Baseline,
        action: Floats,
    ) -> None:
        self._policy, self._percept, self._groups = policy, percept, groups
        self._baseline, self._action = baseline, action

    def without(self, numbers: Iterable[int], baseline: Baseline | None = None) -> Percepts:
        """Return the percept without the groups of these indices."""
        percept = self._percept
        for number in numbers:
            percept = without(percept, self._groups[number], baseline or self._baseline)
        return percept

    def is_at_baseline(self) -> bool:
        """Return True if all groups have the baseline's values now."""
        changed = self.without(range(len(self._groups)))
        keys = dict.fromkeys(group.key for group in self._groups)
        return all(
            np.array_equal(np.asarray(changed[key]), np.asarray(self._percept[key])) for key in keys
        )

    def needed(self, whole: float) -> tuple[int, ...]:
        """Return groups that move the action together, of which none can stay; in n decisions."""
        left = list(range(len(self._groups)))
        for index in range(len(self._groups)):
            fewer = [each for each in left if each != index]
            moved = _moved(self._policy.decide(self.without(fewer)), self._action)
            if moved >= whole / 2:
                left = fewer
        return tuple(left)

    def is_deaf(self) -> bool:
        """Return True if the action stays the same whatever the groups' numbers are."""
        keys = dict.fromkeys(group.key for group in self._groups)
        rng = np.random.default_rng(0)
        for size in np.geomspace(1.0, MAX_PROBE, PROBES):
            other = {key: rng.uniform(-size, size, np.shape(self._percept[key])) for key in keys}
            percept = self.without(range(len(self._groups)), other)
            if _moved(self._policy.decide(percept), self._action) > SAME_ACTION:
                return False
        return True


def _moved(one: Floats, other: Floats) -> float:
    """Return the largest difference of any number of two actions; infinite for other numbers."""
    if len(one) != len(other):
        return math.inf
    is_same = (one == other) | (np.isnan(one) & np.isnan(other))
    apart = np.abs(_difference(one, other))[~is_same]
    return float(np.nan_to_num(apart, nan=math.inf, posinf=math.inf).max(initial=0.0))


def _difference(one: Floats, other: Floats) -> Floats:
    """Return a difference, which is NaN between two infinite numbers."""
    with np.errstate(invalid="ignore"):
        return np.asarray(one - other)


def changed_percept(percept: Percepts, values: Mapping[str, npt.NDArray[Any]]) -> Percepts:
    """Return a percept with other readings; of the same kind, so that a controller can't tell."""
    if not isinstance(percept, Percept):
        return {**percept, **values}
    layout = percept.layout
    memory = bytearray(percept.data)
    for key, value in values.items():
        if key not in layout.slots:
            raise SetupError(
                _(
                    "no numeric reading is called {key!r}; {hint}",
                    key=key,
                    hint=suggest(key, layout.slots),
                )
            )
        layout.view(memory, key)[...] = value
    return Percept(layout, bytes(memory), percept.texts)


def _baseline_for(policy: Policy) -> Baseline:
    found = None if policy.network is None else middle_for(policy.network)
    if found is None:
        raise SetupError(
            _(
                "expected a baseline, as nothing here tells the ranges of the readings: "
                "baseline=middle_of(agent), or baseline=mean_of(percepts) of recorded episodes"
            )
        )
    return found
