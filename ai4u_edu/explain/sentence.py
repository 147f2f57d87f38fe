"""The reason for an action as a sentence, from the slot that matters most."""

from collections.abc import Sequence
from typing import NamedTuple

from ai4u_edu.agent import BasicAgent
from ai4u_edu.explain.groups import Group
from ai4u_edu.explain.occlusion import Occlusion
from ai4u_edu.snapshot.block_info import ActuatorInfo, block_info_of
from ai4u_edu.snapshot.numbers import number

MIN_SHARE = 0.05
"""Share of a component's range that a movement needs to be told."""
NEUTRAL_SHARE = 0.05
"""Share of a component's range around 0 that counts as doing nothing."""

SIDES = {
    "turn": ("turns right", "turns left", "goes straight"),
    "steering": ("steers right", "steers left", "steers straight"),
    "strafe": ("slides right", "slides left", "does not slide sideways"),
    "forward": ("drives forward", "drives backward", "stands still"),
    "throttle": ("drives forward", "drives backward", "stands still"),
    "jump": ("jumps", "jumps", "does not jump"),
}
"""Words for a number above 0, below 0 and near 0, by the component's name."""


class Axis(NamedTuple):
    """One number of an action, for people."""

    name: str
    low: float
    high: float
    is_choice: bool = False
    has_effect: bool = True

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
        )
        for info in (known[name] for name in actuators if name in known)
        for each in info.components
    ]


def shares_of(told: Occlusion, axes: Sequence[Axis]) -> list[list[float]]:
    """Return for each group how far each number moves, as a share of its range, with its sign.

    A number that has no effect counts as 0; so does one of an action with other numbers. A choice
    that changes counts as 1, as it can't change by half.
    """
    if len(axes) != len(told.components):
        axes = [Axis(name, -1.0, 1.0) for name in told.components]
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
    shares = shares_of(told, axes)
    if len(axes) != len(told.components):
        axes = [Axis(name, -1.0, 1.0) for name in told.components]
    sizes = [
        (abs(share), row, axis)
        for row, each in enumerate(shares)
        for axis, share in enumerate(each)
    ]
    # the first of several that are equal
    size, row, index = max(sizes, key=lambda each: each[0], default=(0.0, 0, 0))
    if size < MIN_SHARE:
        return (
            f"No single slot decides: without any one of them the action moves by less than "
            f"{MIN_SHARE:.0%} of its range."
        )
    axis, group = axes[index], told.groups[row]
    now, otherwise = float(told.action[index]), float(told.without[row, index])
    words, other = _words(axis, now), _words(axis, otherwise)
    reason = _reason(group)
    if words != other:
        return f"It {words} because {reason}; without it, it would {_infinitive(other)}."
    only = ("", "only ") if abs(now) > abs(otherwise) else ("only ", "")
    return (
        f"It {words} by {only[0]}{number(abs(now))} because {reason}; without it, it would by "
        f"{only[1]}{number(abs(otherwise))}."
    )


def _reason(group: Group) -> str:
    if group.sees:
        seen = group.sees if group.sees in ("nothing", "something") else f"the {group.sees}"
        return f"{group.name} sees {seen}"
    return f"of {group.name}"


def _share(moved: float, axis: Axis) -> float:
    if not axis.has_effect:
        return 0.0
    if axis.is_choice:
        return float(moved != 0)
    return moved / axis.span


def _words(axis: Axis, value: float) -> str:
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
