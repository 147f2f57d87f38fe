"""Numbers as text and bars for the panel, as HTML."""

from collections.abc import Iterable, Sequence
from html import escape

import numpy as np
import numpy.typing as npt

from ai4u_edu.snapshot.numbers import number, share
from ai4u_edu.snapshot.theme import Rgb

Floats = npt.NDArray[np.float64]
BAR_GAP = 0.15
"""Gap between two bars of a strip, as a share of a bar's pitch."""
MIN_BAR_HEIGHT = 0.03
"""Height of a bar of zero, as a share of the strip's height, so that it is visible."""


def bar(value: float, low: float, high: float) -> str:
    """Return a bar from zero (or the end of the range nearest to it) to a value.

    An unbounded range has no bar.
    """
    if not (np.isfinite(low) and np.isfinite(high)):
        return "<div></div>"
    zero, end = share(0.0, low, high), share(value, low, high)
    left, width = 100 * min(zero, end), 100 * abs(end - zero)
    middle = f'<u class="zero" style="left:{100 * zero:.0f}%"></u>' if low < 0 < high else ""
    return f'<div class="bar"><s style="left:{left:.1f}%;width:{width:.1f}%"></s>{middle}</div>'


def bars(rows: Iterable[tuple[str, float, float, float, str]]) -> str:
    """Return a line for each (name, value, low, high, unit)."""
    lines = [
        f"<span>{escape(name)}</span>{bar(value, low, high)}<b>{_value_text(value, low, unit)}</b>"
        for name, value, low, high, unit in rows
    ]
    return f'<div class="bars">{"".join(lines)}</div>'


def _value_text(value: float, low: float, unit: str) -> str:
    if value < low - 1e-4 * (1 + abs(low)):  # a sentinel below the range, for "no reading"
        return f"<small>({number(value)})</small>"
    return f"{number(value)}{f' <small>{escape(unit)}</small>' if unit else ''}"


def strip(
    values: Floats,
    low: Floats,
    high: Floats,
    colours: Sequence[Rgb] | None = None,
    kind: str = "strip",
) -> str:
    """Return many numbers as vertical bars side by side, each in its own range, from zero.

    Args:
        values: (n,).
        low: (n,) lower ends of the ranges.
        high: (n,) upper ends of the ranges.
        colours: the bars' colours; left out, all have the same one.
        kind: CSS classes.
    """
    span = np.maximum(high - low, 1e-9)
    zeros, tips = (np.clip((each - low) / span, 0, 1) for each in (np.zeros(len(values)), values))
    tops = 1 - np.maximum(zeros, tips)
    heights = np.maximum(np.abs(tips - zeros), MIN_BAR_HEIGHT)
    groups: dict[Rgb | None, list[str]] = {}
    for index, (top, height) in enumerate(zip(tops.tolist(), heights.tolist(), strict=True)):
        x = index + BAR_GAP / 2
        y, width = min(top, 1 - MIN_BAR_HEIGHT), 1 - BAR_GAP
        path = f"M{x:.2f} {y:.2f}h{width}v{height:.2f}h-{width}z"
        groups.setdefault(colours[index] if colours else None, []).append(path)
    paths = "".join(
        f'<path d="{"".join(each)}"' + (f' fill="rgb{colour}"/>' if colour else "/>")
        for colour, each in groups.items()
    )
    size = f'viewBox="0 0 {len(values)} 1" preserveAspectRatio="none"'
    return f'<svg class="{kind}" {size}>{paths}</svg>'
