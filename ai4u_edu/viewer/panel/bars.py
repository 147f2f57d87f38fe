"""Numbers as bars in the panel: how far along its range each one is."""

from collections.abc import Iterable, Sequence
from html import escape

import numpy as np
import numpy.typing as npt

from ai4u_edu.snapshot.theme import Rgb

Floats = npt.NDArray[np.float64]
GAP = 0.15
"""Between two bars of a strip, as a share of a bar's width."""


def number(value: float) -> str:
    """A number as it stands in the panel.

    >>> [number(x) for x in (0.5, -0.25, 12.3456, 1234.5, 3, -0.0001, 1e9)]
    ['0.50', '-0.25', '12.35', '1234', '3', '0.00', '1.00e+09']
    """
    if isinstance(value, int):
        return str(value)
    size = abs(value)
    text = f"{value:.2f}" if size < 1000 else f"{value:.0f}" if size < 1e6 else f"{value:.2e}"
    return "0.00" if text == "-0.00" else text


def amount(value: float) -> str:
    """What was paid: like :func:`number`, but what is small doesn't vanish.

    >>> [amount(x) for x in (100.0, -0.5, -0.0012, 0.0)]
    ['100.00', '-0.50', '-0.0012', '0.00']
    """
    return f"{value:.2g}" if 1e-9 < abs(value) < 0.05 else number(value)


def share(value: float, low: float, high: float) -> float:
    """Where a value is in its range: 0 at the lower end, 1 at the upper one.

    >>> share(5, 0, 20), share(-3, -1, 1), share(1, 1, 1)
    (0.25, 0.0, 0.0)
    """
    return min(max((value - low) / (high - low), 0.0), 1.0) if high > low else 0.0


def bar(value: float, low: float, high: float) -> str:
    """A bar from zero (or from the end of the range that is nearest to it) to a value.

    Of a range that has no end there is no bar.
    """
    if not (np.isfinite(low) and np.isfinite(high)):
        return "<div></div>"
    zero, there = share(0.0, low, high), share(value, low, high)
    left, width = 100 * min(zero, there), 100 * abs(there - zero)
    middle = f'<u class="zero" style="left:{100 * zero:.0f}%"></u>' if low < 0 < high else ""
    return f'<div class="bar"><s style="left:{left:.1f}%;width:{width:.1f}%"></s>{middle}</div>'


def bars(rows: Iterable[tuple[str, float, float, float, str]]) -> str:
    """A line for each (name, value, low, high, unit)."""
    lines = [
        f"<span>{escape(name)}</span>{bar(value, low, high)}<b>{_told(value, low, unit)}</b>"
        for name, value, low, high, unit in rows
    ]
    return f'<div class="bars">{"".join(lines)}</div>'


def _told(value: float, low: float, unit: str) -> str:
    if value < low - 1e-4 * (1 + abs(low)):  # a number that stands for nothing
        return f"<small>({number(value)})</small>"
    return f"{number(value)}{f' <small>{escape(unit)}</small>' if unit else ''}"


def strip(
    values: Floats,
    low: Floats,
    high: Floats,
    colours: Sequence[Rgb] | None = None,
    kind: str = "strip",
) -> str:
    """Many numbers as upright bars side by side, each in its own range, from zero on.

    Args:
        values: (n,).
        low: the lower end of each one's range.
        high: the upper ends.
        colours: of the bars; left out, all look alike.
        kind: CSS classes.
    """
    span = np.maximum(high - low, 1e-9)
    zeros, tips = (np.clip((each - low) / span, 0, 1) for each in (np.zeros(len(values)), values))
    # a hair at least, so that one sees that there is a number, and that it is zero
    tops, heights = 1 - np.maximum(zeros, tips), np.maximum(np.abs(tips - zeros), 0.03)
    groups: dict[Rgb | None, list[str]] = {}
    for place, (top, height) in enumerate(zip(tops.tolist(), heights.tolist(), strict=True)):
        x = place + GAP / 2
        path = f"M{x:.2f} {min(top, 0.97):.2f}h{1 - GAP}v{height:.2f}h-{1 - GAP}z"
        groups.setdefault(colours[place] if colours else None, []).append(path)
    paths = "".join(
        f'<path d="{"".join(each)}"' + (f' fill="rgb{colour}"/>' if colour else "/>")
        for colour, each in groups.items()
    )
    size = f'viewBox="0 0 {len(values)} 1" preserveAspectRatio="none"'
    return f'<svg class="{kind}" {size}>{paths}</svg>'
