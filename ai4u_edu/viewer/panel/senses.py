"""Sensor readings as HTML for the panel, with names, units and ranges of their numbers."""

from collections.abc import Mapping
from html import escape
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.blocks import RayPicture
from ai4u_edu.snapshot.block_info import SensorInfo
from ai4u_edu.snapshot.theme import RAY_MISS, UNKNOWN_GROUP, Rgb
from ai4u_edu.viewer.panel.bars import bars, number, strip
from ai4u_edu.viewer.panel.pictures import MAX_OLDER_READINGS, pictures
from ai4u_edu.viewer.panel.readings import block, reading

MAX_UNNAMED_LINES = 8
"""Longest reading without names that gets a line for each number; longer ones are strips."""
MAX_NAMED_LINES = 16
"""Longest reading with names that gets a line for each number."""
MAX_BARS = 256
"""Most bars of a strip; of a longer reading only the first numbers are drawn."""


def sense_html(
    sense: SensorInfo,
    value: Any,
    colours: Mapping[str, Rgb],
    rays: RayPicture | None = None,
    *,
    lit: bool = False,
    named: bool = True,
) -> str:
    """Return a reading, with the names, units and ranges of its numbers.

    Args:
        sense: description of the sensor.
        value: its reading in the percept.
        colours: colours by group.
        rays: the sensor's rays, if it has some.
        lit: True if the sensor is drawn in the scene.
        named: True to print the sensor's name; False if a button above shows it.
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
    if len(sense.low) <= (MAX_NAMED_LINES if sense.slots else MAX_UNNAMED_LINES):
        return _lines(sense, rows)
    if array.ndim <= 2:
        return _strips(sense, rows, colours, rays)
    return f"<div>{reading(value)}</div>"


def _lines(sense: SensorInfo, rows: npt.NDArray[np.float64]) -> str:
    """Return a line for each number, and a strip of its older values, oldest first."""
    count = len(sense.low)
    names = sense.slots or tuple(map(str, range(count)) if count > 1 else ("value",))
    units = sense.unit.split(", ")
    units = units if len(units) == count else [sense.unit] * count
    low, high = sense.low.tolist(), sense.high.tolist()
    html = bars(zip(names, rows[-1].tolist(), low, high, units, strict=True))
    if sense.stack == 1:
        return html
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
    """Return bars side by side, with smaller strips of the older readings above."""
    shown = slice(0, MAX_BARS)
    low, high = sense.low[shown], sense.high[shown]
    cut = f", the first {MAX_BARS} of {rows.shape[1]}" if rows.shape[1] > MAX_BARS else ""
    older = [
        strip(row[shown], low, high, kind="strip old") for row in rows[:-1][-MAX_OLDER_READINGS:]
    ]
    latest = rows[-1][shown]
    hit_colours = None if rays is None else _hit_colours(rays, colours)
    if hit_colours is not None and len(latest) == 2 * len(
        hit_colours
    ):  # pairs of group and distance
        drawn = "".join(
            f"{strip(latest[i::2], low[i::2], high[i::2], hit_colours)}<small>{caption}</small>"
            for i, caption in enumerate(("what each ray met", "how far away it is"))
        )
    else:
        fits = hit_colours is not None and len(hit_colours) == len(latest)
        drawn = strip(latest, low, high, hit_colours if fits else None)
    order = "; the rightmost ray comes first" if rays is not None else ""
    ends = f"{number(float(low.min()))} to {number(float(high.max()))} {escape(sense.unit)}"
    return f"{''.join(older)}{drawn}<br><small>{ends.strip()}{order}{cut}</small>"


def _hit_colours(rays: RayPicture, colours: Mapping[str, Rgb]) -> list[Rgb]:
    """Return the colour of the group that each ray hit."""
    known = {"": RAY_MISS, "?": UNKNOWN_GROUP} | dict(colours)
    return [known.get(group, UNKNOWN_GROUP) for group in rays.groups]


def _title(sense: SensorInfo, value: Any) -> str:
    shape = " x ".join(map(str, np.shape(value)))
    stacked = f", the last {sense.stack}" if sense.stack > 1 else ""
    return f"{escape(sense.block)}{f' {shape}' if shape else ''}{stacked}"
