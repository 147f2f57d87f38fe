"""The reason for an action as a sentence, from the slot that matters most."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.explain.groups import Group
from ai4u_edu.explain.occlusion import Occlusion
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, listed
from ai4u_edu.snapshot.block_info import ActuatorInfo, block_info_of
from ai4u_edu.snapshot.numbers import number

MIN_SHARE = 0.05
"""Share of a component's range that a movement needs to be told."""
SAME_SHARE = 0.01
"""Difference of two movements, relative to the larger one, up to which they are equal."""
MAX_NAMES = 3
"""Most slots that a sentence names."""
NO_NUMBER = _("Its action has a number that is none (NaN), so nothing can be said about it.")
SMALL_SHARE = 0.001
"""Smallest share that is named of a slot that moves the action little."""
TOLERANCE = 0.25
"""Share of what all slots do together by which the sum of the single ones may differ unnoticed."""
NEUTRAL_SHARE = 0.05
"""Share of a component's range around 0 that counts as doing nothing."""


class Doing(NamedTuple):
    """Words for what a robot does."""

    now: str
    """After "It", as ``turns right``."""
    would: str
    """After "it would", as ``turn right``."""


_STRAIGHT = Doing(_("goes straight"), _("go straight"))
_FORWARD = Doing(_("drives forward"), _("drive forward"))
_BACKWARD = Doing(_("drives backward"), _("drive backward"))
_STILL = Doing(_("stands still"), _("stand still"))
_JUMPS = Doing(_("jumps"), _("jump"))
_JUMPS_FORWARD = Doing(_("jumps forward"), _("jump forward"))
_OPENS = Doing(_("opens its hand"), _("open its hand"))
SIDES = {
    "turn": (
        Doing(_("turns right"), _("turn right")),
        Doing(_("turns left"), _("turn left")),
        _STRAIGHT,
    ),
    "steering": (
        Doing(_("steers right"), _("steer right")),
        Doing(_("steers left"), _("steer left")),
        Doing(_("steers straight"), _("steer straight")),
    ),
    "strafe": (
        Doing(_("slides right"), _("slide right")),
        Doing(_("slides left"), _("slide left")),
        Doing(_("does not slide sideways"), _("not slide sideways")),
    ),
    "forward": (_FORWARD, _BACKWARD, _STILL),
    "throttle": (_FORWARD, _BACKWARD, _STILL),
    "jump": (_JUMPS, _JUMPS, Doing(_("does not jump"), _("not jump"))),
    "forward jump": (
        _JUMPS_FORWARD,
        _JUMPS_FORWARD,
        Doing(_("does not jump forward"), _("not jump forward")),
    ),
    "left": (
        Doing(_("turns its left wheel forward"), _("turn its left wheel forward")),
        Doing(_("turns its left wheel back"), _("turn its left wheel back")),
        Doing(_("stops its left wheel"), _("stop its left wheel")),
    ),
    "right": (
        Doing(_("turns its right wheel forward"), _("turn its right wheel forward")),
        Doing(_("turns its right wheel back"), _("turn its right wheel back")),
        Doing(_("stops its right wheel"), _("stop its right wheel")),
    ),
    "grip": (Doing(_("closes its hand"), _("close its hand")), _OPENS, _OPENS),
}
"""Words for a number above 0, below 0 and near 0, by the component's name."""

CHOICES = {
    "GridMoveActuator": (
        Doing(_("stays"), _("stay")),
        Doing(_("goes right"), _("go right")),
        Doing(_("goes left"), _("go left")),
        Doing(_("goes up"), _("go up")),
        Doing(_("goes down"), _("go down")),
    )
}
"""Words for choices, by the actuator's class."""


class Axis(NamedTuple):
    """One number of an action, for people."""

    name: str
    low: float
    high: float
    is_choice: bool = False
    has_effect: bool = True
    choices: tuple[Doing, ...] = ()
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
    without = _("it") if len(equal) == 1 else _("one of them")
    if all(told.groups[row].says for row in equal):
        without = _("that sensor") if len(equal) == 1 else _("one of these sensors")
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
        return _("Left out one by one, the slots move it the other way than all of them together.")
    if part > 1 + TOLERANCE:
        return _(
            "Left out one by one, the slots explain {part:.0%} of what all do together: some need "
            "each other.",
            part=part,
        )
    if part < 1 - TOLERANCE:
        return _(
            "Left out one by one, the slots explain {part:.0%} of what all do together: some stand "
            "in for others.",
            part=part,
        )
    return _(
        "Left out one by one, the slots explain {part:.0%} of what all do together.", part=part
    )


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
    none = np.flatnonzero(~np.isfinite(told.without).all(axis=1))
    if len(none):
        return _(
            "Without {name}, its action would have a number that is none (NaN).",
            name=told.names[none[0]],
        )
    if told.base is None:
        return _(
            "No single number decides: without any one of them the action moves by less than "
            "{share:.0%} of its range.",
            share=MIN_SHARE,
        )
    whole = [abs(_share(float(each), axis)) for each, axis in zip(told.whole, axes, strict=True)]
    largest = max(whole, default=0.0)
    if largest >= MIN_SHARE:
        index = whole.index(largest)
        now, base = float(told.action[index]), float(told.base[index])
        if 1 < len(told.together) <= MAX_NAMES:
            without = _("both") if len(told.together) == 2 else _("all of them")
            reasons = _("{reasons} together", reasons=_reasons(told, told.together))
            return _because(axes[index], now, base, reasons, without)
        return _(
            "Many numbers decide together: each of them alone moves the action by less than "
            "{share:.0%} of its range, all of them by {largest:.0%}.",
            share=MIN_SHARE,
            largest=largest,
        )
    if told.is_deaf:
        return _("It looks at nothing: the action is the same whatever it senses.")
    if told.is_at_baseline:
        return _(
            "All that it senses now is as in the comparison, so there is nothing to leave out. Let "
            "it move on."
        )
    if size >= SMALL_SHARE:
        return _(
            "Nothing that it senses moves the action much: {name} moves it most, by {share:.1%} of "
            "its range.",
            name=told.names[row],
            share=size,
        )
    return _(
        "Nothing that it senses now decides: it would do the same if all of it were as in the "
        "comparison."
    )


def _because(axis: Axis, now: float, otherwise: float, reasons: str, without: str) -> str:
    words, other = _words(axis, now), _words(axis, otherwise)
    values = {"does": words.now, "reasons": reasons, "without": without}
    if words != other:
        return _(
            "It {does} because {reasons}. Without {without}, it would {would}.",
            would=other.would,
            **values,
        )
    values |= {"size": number(abs(now)), "other": number(abs(otherwise))}
    if abs(now) > abs(otherwise):
        return _(
            "It {does} more because {reasons}: {size}. Without {without}, it would be {other}.",
            **values,
        )
    return _(
        "It {does} less because {reasons}: {size}. Without {without}, it would be {other}.",
        **values,
    )


def _reasons(told: Occlusion, rows: Sequence[int]) -> str:
    """Return the reasons of groups, joined; a few of many."""
    groups = [told.groups[row] for row in rows[:MAX_NAMES]]
    # in English a clause does not follow an "of"
    groups.sort(key=lambda group: not (group.sees or group.says))
    named = [_reason(group) for group in groups]
    if len(rows) > MAX_NAMES:
        more = len(rows) - MAX_NAMES
        return _("{names} and {more} more", names=join(named, ", "), more=more)
    return listed(named)


def _reason(group: Group) -> str:
    if group.sees == "nothing":
        return _("{ray} sees nothing", ray=group.name)
    if group.sees == "something":
        return _("{ray} sees something", ray=group.name)
    if group.sees:
        return _("{ray} sees the {thing}", ray=group.name, thing=group.sees)
    if group.says:
        return group.says
    if group.name == f"all of {group.key}":
        return _("of what its {sensor} shows", sensor=group.key.replace("_", " "))
    return _("of {name}", name=group.name)


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


def _words(axis: Axis, value: float) -> Doing:
    if axis.is_choice and 0 <= value < len(axis.choices):
        return axis.choices[int(value)]
    if axis.is_choice:
        return Doing(
            _("chooses {name} {value:g}", name=axis.name, value=value),
            _("choose {name} {value:g}", name=axis.name, value=value),
        )
    above, below, neither = SIDES.get(axis.name) or _sides_of(axis.name)
    if abs(value) <= NEUTRAL_SHARE * axis.span:
        return neither
    return above if value > 0 else below


def _sides_of(name: str) -> tuple[Doing, Doing, Doing]:
    """Return the words for a number without words of its own."""
    return (
        Doing(_("has {name} above 0", name=name), _("have {name} above 0", name=name)),
        Doing(_("has {name} below 0", name=name), _("have {name} below 0", name=name)),
        Doing(_("has {name} near 0", name=name), _("have {name} near 0", name=name)),
    )
