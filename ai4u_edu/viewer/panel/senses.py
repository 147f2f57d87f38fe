"""What the brain sees: each sensor's reading as HTML for the panel, number by number."""

from collections.abc import Mapping
from html import escape
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.blocks import RayPicture
from ai4u_edu.snapshot.block_info import SensorInfo
from ai4u_edu.snapshot.theme import RAY_MISS, UNKNOWN_GROUP, Rgb
from ai4u_edu.viewer.panel.bars import bars, number, strip
from ai4u_edu.viewer.panel.pictures import pictures
from ai4u_edu.viewer.panel.readings import block, reading

ONE_BY_ONE = 8
"""So many numbers without names stand one below the other; more are bars side by side."""
MOST_LINES = 16
"""So many with names do."""
MOST_BARS = 256
"""So many bars are drawn; of a longer reading only the first ones."""
OLDER = 4
"""Of stacked readings so many older ones are drawn at most: the latest of them."""


def sense_html(
    sense: SensorInfo,
    value: Any,
    colours: Mapping[str, Rgb],
    rays: RayPicture | None = None,
    *,
    lit: bool = False,
    named: bool = True,
) -> str:
    """A reading, with the names, units and ranges of its numbers.

    Args:
        sense: what is known of it beforehand.
        value: what stands in the percept.
        colours: of the groups.
        rays: what its rays met, if it has some.
        lit: whether it is shown in the scene.
        named: whether its name stands above it; not if there is a button with it.
    """
    name = f"<b>{escape(sense.key)}</b> " if named else ""
    return block(
        f"<div>{name}<small>{_title(sense, value)}</small></div>",
        _drawn(sense, value, colours, rays),
        kind="sense lit" if lit else "sense",
    )


def _drawn(
    sense: SensorInfo, value: Any, colours: Mapping[str, Rgb], rays: RayPicture | None
) -> str:
    if sense.legend is not None:
        return pictures(value, sense.legend, colours, stack=sense.stack)
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or array.size != sense.stack * len(sense.low):
        return f"<div>{reading(value)}</div>"
    rows = array.reshape(sense.stack, -1).astype(np.float64)
    if len(sense.low) <= (MOST_LINES if sense.slots else ONE_BY_ONE):
        return _lines(sense, rows)
    if array.ndim <= 2:
        return _strips(sense, rows, colours, rays)
    return f"<div>{reading(value)}</div>"


def _lines(sense: SensorInfo, rows: npt.NDArray[np.float64]) -> str:
    """A line a number; with its older values below it, oldest first."""
    count = len(sense.low)
    names = sense.slots or tuple(map(str, range(count)) if count > 1 else ("value",))
    units = sense.unit.split(", ")
    units = units if len(units) == count else [sense.unit] * count
    low, high = sense.low.tolist(), sense.high.tolist()
    html = bars(zip(names, rows[-1].tolist(), low, high, units, strict=True))
    if sense.stack == 1:
        return html
    # each number's past: a strip of its own, the latest at the right
    older = [
        f"<span>{escape(name)}</span>{_strip(rows[:, i], low[i], high[i])}<b></b>"
        for i, name in enumerate(names)
    ]
    past = f"<small>the last {sense.stack}, oldest first</small>"
    return html + past + f'<div class="bars">{"".join(older)}</div>'


def _strip(past: npt.NDArray[np.float64], low: float, high: float) -> str:
    ends = np.full(len(past), low), np.full(len(past), high)
    return strip(past, *ends, kind="strip old")


def _strips(
    sense: SensorInfo,
    rows: npt.NDArray[np.float64],
    colours: Mapping[str, Rgb],
    rays: RayPicture | None,
) -> str:
    """Bars side by side; older readings above, smaller."""
    shown = slice(0, MOST_BARS)
    low, high = sense.low[shown], sense.high[shown]
    cut = f", the first {MOST_BARS} of {rows.shape[1]}" if rows.shape[1] > MOST_BARS else ""
    older = [strip(row[shown], low, high, kind="strip old") for row in rows[:-1][-OLDER:]]
    latest = rows[-1][shown]
    met = None if rays is None else _met(rays, colours)
    if met is not None and len(latest) == 2 * len(met):  # what each ray met, and how far away
        drawn = "".join(
            f"{strip(latest[each::2], low[each::2], high[each::2], met)}<small>{what}</small>"
            for each, what in enumerate(("what each ray met", "how far away it is"))
        )
    else:
        drawn = strip(latest, low, high, met if met and len(met) == len(latest) else None)
    way = "; the rightmost ray comes first" if rays is not None else ""
    ends = f"{number(float(low.min()))} to {number(float(high.max()))} {escape(sense.unit)}"
    return f"{''.join(older)}{drawn}<br><small>{ends.strip()}{way}{cut}</small>"


def _met(rays: RayPicture, colours: Mapping[str, Rgb]) -> list[Rgb]:
    """The colours of what each ray met."""
    known = {"": RAY_MISS, "?": UNKNOWN_GROUP} | dict(colours)
    return [known.get(group, UNKNOWN_GROUP) for group in rays.groups]


def _title(sense: SensorInfo, value: Any) -> str:
    shape = " x ".join(map(str, np.shape(value)))
    stacked = f", the last {sense.stack}" if sense.stack > 1 else ""
    return f"{escape(sense.block)}{f' {shape}' if shape else ''}{stacked}"
