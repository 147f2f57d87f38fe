"""What an agent has to keep in balance, as bars in the panel."""

from collections.abc import Iterable
from html import escape

from ai4u_edu.snapshot import Need
from ai4u_edu.viewer.panel.bars import number, share
from ai4u_edu.viewer.panel.readings import block, heading

COARSE = 50.0
"""Of a variable whose range is wider than this, whole numbers are shown."""


def needs(variables: Iterable[Need]) -> str:
    """A bar for each variable: the level, and in green the zone in which the agent feels well."""
    bars = "".join(_bar(need) for need in variables)
    return block(heading("Inside"), f'<div class="bars">{bars}</div>') if bars else ""


def _bar(need: Need) -> str:
    low, high = need.comfort
    left, right = (100 * share(end, *need.range) for end in need.comfort)
    is_well = low <= need.level <= high
    span = need.range[1] - need.range[0]
    level = f"{need.level:.0f}" if span >= COARSE else number(need.level)
    told = level if is_well else f"<strong>{level} {'low' if need.level < low else 'high'}</strong>"
    return (
        f'<span>{escape(need.name)}</span><div class="bar">'
        f'<u style="left:{left:.1f}%;width:{right - left:.1f}%"></u>'
        f'<s style="width:{100 * share(need.level, *need.range):.1f}%"></s></div><b>{told}</b>'
    )
