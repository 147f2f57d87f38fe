"""The reason for an action as a sentence, from the slot that matters most."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.explain.groups import Group
from ai4u_edu.explain.occlusion import Occlusion
from ai4u_edu.snapshot.block_info import ActuatorInfo, block_info_of
from ai4u_edu.snapshot.numbers import number

MIN_SHARE = 0.05
"""Share of a component's range that a movement needs to be told."""
SAME_SHARE = 0.01
"""Difference of two movements, relative to the larger one, up to which they are equal."""
MAX_NAMES = 3
"""Most slots that a sentence names."""
NO_NUMBER = "Its action has a number that is none (NaN), so nothing can be said about it."
SMALL_SHARE = 0.001
"""Smallest share that is named of a slot that moves the action little."""
TOLERANCE = 0.25
"""Share of what all slots do together by which the sum of the single ones may differ unnoticed."""
NEUTRAL_SHARE = 0.05
"""Share of a component's range around 0 that counts as doing nothing."""

SIDES = {
    "turn": ("turns right", "turns left", "goes straight"),
    "steering": ("steers right", "steers left", "steers straight"),
    "strafe": ("slides right", "slides left", "does not slide sideways"),
    "forward": ("drives forward", "drives backward", "stands still"),
    "throttle": ("drives forward", "drives backward", "stands still"),
    "jump": ("jumps", "jumps", "does not jump"),
    "forward jump": ("jumps forward", "jumps forward", "does not jump forward"),
    "left": ("turns its left wheel forward", "turns its left wheel back", "stops its left wheel"),
    "right": (
        "turns its right wheel forward",
        "turns its right wheel back",
        "stops its right wheel",
    ),
    "grip": ("closes its hand", "opens its hand", "opens its hand"),
}
"""Words for a number above 0, below 0 and near 0, by the component's name."""


CHOICES = {"GridMoveActuator": ("stays", "goes right", "goes left", "goes up", "goes down")}
"""Words for choices, by the actuator's class."""


class Axis(NamedTuple):
    """One number of an action, for people."""

    name: str
    low: float
    high: float
    is_choice: bool = False
    has_effect: bool = True
    choices: tuple[str, ...] = ()
    """Words for the choices, as ``goes right``; empty if they have none."""

    @property
    def span(self) -> float:
        """Length of its range; 1 if it has no ends."""
        span = self.high - self.low
        return span if 0 < span < float("inf") else 1.0


def axes_of_agent(agent: BasicAgent, actuators: Sequence[str]) -> list[Axis]:
    """Return the numbers of an action that names these actuators, in this order."""
    return axes_of(block_info_of(agent).actuator_infos, actuators)


def axes_of(infos: Sequence[ActuatorInfo], actuators: Sequence[str]) -> list[Axis]:
    """Return the numbers of an action that names these actuators, from their descriptions."""
    known = {info.name: info for info in infos}
    return [
        Axis(
            each.name or info.name,
            each.low,
            each.high,
            info.is_choice,
            each.name not in info.without_effect,
            CHOICES.get(info.block, ()),
        )
        for info in (known[name] for name in actuators if name in known)
        for each in info.components
    ]


def shares_of(told: Occlusion, axes: Sequence[Axis]) -> list[list[float]]:
    """Return for each group how far each number moves, as a share of its range, with its sign.

    A number that has no effect counts as 0; so does one of an action with other numbers. A choice
    that changes counts as 1, as it can't change by half.
    """
    axes = _fitting(told, axes)
    return [
        [_share(float(moved), axis) for moved, axis in zip(row, axes, strict=True)]
        for row in told.shift
    ]


def sentence(told: Occlusion, axes: Sequence[Axis]) -> str:
    """Return why the action is as it is, in a sentence.

    Args:
        told: the result of :func:`~ai4u_edu.explain.occlusion`.
        axes: the action's numbers, as :func:`axes_of_agent` gives them.
    """
    axes = _fitting(told, axes)
    has_effect = [axis.has_effect for axis in axes]
    if not np.isfinite(told.action[has_effect]).all():
        return NO_NUMBER
    shares = shares_of(told, axes)
    sizes = [
        (abs(share), row, axis)
        for row, each in enumerate(shares)
        for axis, share in enumerate(each)
    ]
    # the first of several that are equal
    size, row, index = max(sizes, key=lambda each: each[0], default=(0.0, 0, 0))
    if size < MIN_SHARE:
        return _no_single(told, axes, size, row)
    axis, now = axes[index], float(told.action[index])
    otherwise = float(told.without[row, index])
    equal = [
        number
        for number, each in enumerate(shares)
        if abs(each[index]) >= (1 - SAME_SHARE) * size
        and _words(axis, float(told.without[number, index])) == _words(axis, otherwise)
    ]
    without = "it" if len(equal) == 1 else "one of them"
    if all(told.groups[row].says for row in equal):
        without = "that sensor" if len(equal) == 1 else "one of these sensors"
    return _because(axis, now, otherwise, _reasons(told, equal), without)


def explained(told: Occlusion, axes: Sequence[Axis]) -> str:
    """Return how much of what all slots do together the single ones explain, in a sentence.

    Empty if that is not known, or for an action that can't change by half.

    Args:
        told: as for :func:`sentence`.
        axes: as for :func:`sentence`.
    """
    axes = _fitting(told, axes)
    if told.base is None or not told.groups:
        return ""
    shares = np.array(shares_of(told, axes)).reshape(len(told.groups), len(axes))
    whole = np.array(
        [_share(float(each), axis) for each, axis in zip(told.whole, axes, strict=True)]
    )
    index = int(np.abs(whole).argmax()) if len(whole) else 0
    if not len(whole) or axes[index].is_choice or abs(whole[index]) < MIN_SHARE:
        return ""
    part = float(shares[:, index].sum() / whole[index])
    if part < 0:
        return "Left out one by one, the slots move it the other way than all of them together."
    text = f"Left out one by one, the slots explain {part:.0%} of what all do together"
    if part > 1 + TOLERANCE:
        return f"{text}: some need each other."
    return f"{text}: some stand in for others." if part < 1 - TOLERANCE else f"{text}."


def decisive(told: Occlusion, axes: Sequence[Axis]) -> frozenset[str]:
    """Return the names of the slots that matter most; empty if no single one decides."""
    sizes = [max(map(abs, each), default=0.0) for each in shares_of(told, axes)]
    size = max(sizes, default=0.0)
    if size < MIN_SHARE:
        return frozenset()
    least = (1 - SAME_SHARE) * size
    return frozenset(told.names[row] for row, each in enumerate(sizes) if each >= least)


def _no_single(told: Occlusion, axes: Sequence[Axis], size: float, row: int) -> str:
    """Return a sentence for a decision that no slot alone explains, with its cause."""
    text = (
        f"No single number decides: without any one of them the action moves by less than "
        f"{MIN_SHARE:.0%} of its range."
    )
    none = np.flatnonzero(~np.isfinite(told.without).all(axis=1))
    if len(none):
        return f"Without {told.names[none[0]]}, its action would have a number that is none (NaN)."
    if told.base is None:
        return text
    whole = [abs(_share(float(each), axis)) for each, axis in zip(told.whole, axes, strict=True)]
    largest = max(whole, default=0.0)
    if largest >= MIN_SHARE:
        index = whole.index(largest)
        now, base = float(told.action[index]), float(told.base[index])
        if 1 < len(told.together) <= MAX_NAMES:
            reasons = _reasons(told, told.together)
            without = "both" if len(told.together) == 2 else "all of them"
            return _because(axes[index], now, base, reasons, without, " together")
        return (
            f"Many numbers decide together: each of them alone moves the action by less than "
            f"{MIN_SHARE:.0%} of its range, all of them by {largest:.0%}."
        )
    if told.is_deaf:
        return "It looks at nothing: the action is the same whatever it senses."
    if told.is_at_baseline:
        return (
            "All that it senses now is as in the comparison, so there is nothing to leave out. "
            "Let it move on."
        )
    if size >= SMALL_SHARE:
        return (
            f"Nothing that it senses moves the action much: {told.names[row]} moves it most, by "
            f"{size:.1%} of its range."
        )
    return (
        "Nothing that it senses now decides: it would do the same if all of it were as in the "
        "comparison."
    )


def _because(
    axis: Axis, now: float, otherwise: float, reasons: str, without: str, how: str = ""
) -> str:
    words, other = _words(axis, now), _words(axis, otherwise)
    if words != other:
        return (
            f"It {words} because {reasons}{how}. Without {without}, it would {_infinitive(other)}."
        )
    more = "more" if abs(now) > abs(otherwise) else "less"
    return (
        f"It {words} {more} because {reasons}{how}: {number(abs(now))}. "
        f"Without {without}, it would be {number(abs(otherwise))}."
    )


def _reasons(told: Occlusion, rows: Sequence[int]) -> str:
    """Return the reasons of groups, joined; a few of many."""
    named = [_reason(told.groups[row]) for row in rows[:MAX_NAMES]]
    named.sort(key=lambda reason: reason.startswith("of "))  # a clause does not follow an "of"
    if len(rows) > MAX_NAMES:
        return f"{', '.join(named)} and {len(rows) - MAX_NAMES} more"
    return " and ".join([", ".join(named[:-1]), named[-1]] if len(named) > 1 else named)


def _reason(group: Group) -> str:
    if group.sees:
        seen = group.sees if group.sees in ("nothing", "something") else f"the {group.sees}"
        return f"{group.name} sees {seen}"
    if group.says:
        return group.says
    if group.name == f"all of {group.key}":
        return f"of what its {group.key.replace('_', ' ')} shows"
    return f"of {group.name}"


def _fitting(told: Occlusion, axes: Sequence[Axis]) -> Sequence[Axis]:
    if len(axes) == len(told.components):
        return axes
    return [Axis(name, -1.0, 1.0) for name in told.components]


def _share(moved: float, axis: Axis) -> float:
    if not axis.has_effect or not math.isfinite(moved):
        return 0.0
    if axis.is_choice:
        return float(moved != 0)
    return moved / axis.span


def _words(axis: Axis, value: float) -> str:
    if axis.is_choice and 0 <= value < len(axis.choices):
        return axis.choices[int(value)]
    if axis.is_choice:
        return f"chooses {axis.name} {value:g}"
    above, below, neither = SIDES.get(
        axis.name,
        (f"has {axis.name} above 0", f"has {axis.name} below 0", f"has {axis.name} near 0"),
    )
    if abs(value) <= NEUTRAL_SHARE * axis.span:
        return neither
    return above if value > 0 else below


def _infinitive(words: str) -> str:
    first, *rest = words.split(" ")
    known = {"does": "", "has": "have", "goes": "go"}
    return " ".join(filter(None, [known.get(first, first.removesuffix("s")), *rest]))
