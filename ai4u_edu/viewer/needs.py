"""What an agent has to keep in balance, as bars in the panel."""

from collections.abc import Iterable
from html import escape

from ai4u_edu.snapshot import Need
from ai4u_edu.viewer.readings import block, heading, number

COARSE = 50.0
"""Of a variable whose range is wider than this, whole numbers are shown."""


def needs(variables: Iterable[Need]) -> str:
    """A bar for each variable: the level, and in green the zone in which the agent feels well."""
    bars = [_bar(need) for need in variables]
    return block(heading("Inside"), *bars) if bars else ""


def _bar(need: Need) -> str:
    low, high = need.comfort
    left, right = _share(need, low), _share(need, high)
    is_well = low <= need.level <= high
    span = need.range[1] - need.range[0]
    level = f"{need.level:.0f}" if span >= COARSE else number(need.level)
    told = level if is_well else f"<strong>{level} {'low' if need.level < low else 'high'}</strong>"
    return (
        f'<div class="need"><small>{escape(need.name)}</small><b>{told}</b>'
        f'<div><u style="left:{left:.1f}%;width:{right - left:.1f}%"></u>'
        f'<s style="width:{_share(need, need.level):.1f}%"></s></div></div>'
    )


def _share(need: Need, level: float) -> float:
    """Where a level is on its bar, in percent."""
    low, high = need.range
    return 100 * (level - low) / (high - low)
