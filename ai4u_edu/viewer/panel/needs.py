"""An agent's needs (homeostatic variables), as bars in the panel."""

from collections.abc import Iterable
from html import escape

from ai4u_edu.snapshot import Need
from ai4u_edu.snapshot.numbers import number, share
from ai4u_edu.viewer.panel.html_parts import heading, section

MIN_COARSE_RANGE = 50.0
"""Width of a variable's range from which its level is shown as a whole number."""


def needs(variables: Iterable[Need]) -> str:
    """Return a bar for each variable: its level, and in green the comfort zone."""
    bars = "".join(_bar(need) for need in variables)
    return section(heading("Inside"), f'<div class="bars">{bars}</div>') if bars else ""


def _bar(need: Need) -> str:
    low, high = need.comfort
    left, right = (100 * share(end, *need.range) for end in need.comfort)
    is_well = low <= need.level <= high
    span = need.range[1] - need.range[0]
    level = f"{need.level:.0f}" if span >= MIN_COARSE_RANGE else number(need.level)
    text = level if is_well else f"<strong>{level} {'low' if need.level < low else 'high'}</strong>"
    return (
        f'<span>{escape(need.name)}</span><div class="bar">'
        f'<u style="left:{left:.1f}%;width:{right - left:.1f}%"></u>'
        f'<s style="width:{100 * share(need.level, *need.range):.1f}%"></s></div><b>{text}</b>'
    )
