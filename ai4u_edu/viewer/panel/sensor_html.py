"""Sensor readings as HTML for the panel, with names, units and ranges of their numbers."""

from collections.abc import Mapping
from html import escape
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.blocks import RayPicture
from ai4u_edu.snapshot.block_info import SensorInfo
from ai4u_edu.snapshot.numbers import number
from ai4u_edu.snapshot.theme import RAY_MISS, UNKNOWN_GROUP, Rgb
from ai4u_edu.viewer.panel.bars import bars, strip
from ai4u_edu.viewer.panel.html_parts import section
from ai4u_edu.viewer.panel.pictures import MAX_OLDER_READINGS, pictures
from ai4u_edu.viewer.panel.readings import reading

MAX_UNNAMED_LINES = 8
"""Longest reading without names that gets a line for each number; longer ones are strips."""
MAX_NAMED_LINES = 16
"""Longest reading with names that gets a line for each number."""
MAX_BARS = 256
"""Most bars of a strip; of a longer reading only the first numbers are drawn."""


def sensor_html(
    sensor: SensorInfo,
    value: Any,
    colours: Mapping[str, Rgb],
    rays: RayPicture | None = None,
    *,
    lit: bool = False,
    named: bool = True,
) -> str:
    """Return a reading, with the names, units and ranges of its numbers.

    Args:
        sensor: description of the sensor.
        value: its reading in the percept.
        colours: colours by group.
        rays: the sensor's rays, if it has some.
        lit: True if the sensor is drawn in the scene.
        named: True to print the sensor's name; False if a button above shows it.
    """
    name = f"<b>{escape(sensor.key)}</b> " if named else ""
    return section(
        f"<div>{name}<small>{_title(sensor, value)}</small></div>",
        _render_value(sensor, value, colours, rays),
        kind="sense lit" if lit else "sense",
    )


def _render_value(
    sensor: SensorInfo, value: Any, colours: Mapping[str, Rgb], rays: RayPicture | None
) -> str:
    if sensor.legend is not None:
        return pictures(value, sensor.legend, colours, stack=sensor.stack)
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or array.size != sensor.stack * len(sensor.low):
        return f"<div>{reading(value)}</div>"
    rows = array.reshape(sensor.stack, -1).astype(np.float64)
    if len(sensor.low) <= (MAX_NAMED_LINES if sensor.slots else MAX_UNNAMED_LINES):
        return _render_lines(sensor, rows)
    if array.ndim <= 2:
        return _render_strips(sensor, rows, colours, rays)
    return f"<div>{reading(value)}</div>"


def _render_lines(sensor: SensorInfo, rows: npt.NDArray[np.float64]) -> str:
    """Return a line for each number, and a strip of its older values, oldest first."""
    count = len(sensor.low)
    names = sensor.slots or tuple(map(str, range(count)) if count > 1 else ("value",))
    units = sensor.unit.split(", ")
    units = units if len(units) == count else [sensor.unit] * count
    low, high = sensor.low.tolist(), sensor.high.tolist()
    html = bars(zip(names, rows[-1].tolist(), low, high, units, strict=True))
    if sensor.stack == 1:
        return html
    older = [
        f"<span>{escape(name)}</span>{_render_older(rows[:, i], low[i], high[i])}<b></b>"
        for i, name in enumerate(names)
    ]
    past = f"<small>the last {sensor.stack}, oldest first</small>"
    return html + past + f'<div class="bars">{"".join(older)}</div>'


def _render_older(past: npt.NDArray[np.float64], low: float, high: float) -> str:
    ends = np.full(len(past), low), np.full(len(past), high)
    return strip(past, *ends, kind="strip old")


def _render_strips(
    sensor: SensorInfo,
    rows: npt.NDArray[np.float64],
    colours: Mapping[str, Rgb],
    rays: RayPicture | None,
) -> str:
    """Return bars side by side, with smaller strips of the older readings above."""
    shown = slice(0, MAX_BARS)
    low, high = sensor.low[shown], sensor.high[shown]
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
    ends = f"{number(float(low.min()))} to {number(float(high.max()))} {escape(sensor.unit)}"
    return f"{''.join(older)}{drawn}<br><small>{ends.strip()}{order}{cut}</small>"


def _hit_colours(rays: RayPicture, colours: Mapping[str, Rgb]) -> list[Rgb]:
    """Return the colour of the group that each ray hit."""
    known = {"": RAY_MISS, "?": UNKNOWN_GROUP} | dict(colours)
    return [known.get(group, UNKNOWN_GROUP) for group in rays.groups]


def _title(sensor: SensorInfo, value: Any) -> str:
    shape = " x ".join(map(str, np.shape(value)))
    stacked = f", the last {sensor.stack}" if sensor.stack > 1 else ""
    return f"{escape(sensor.block)}{f' {shape}' if shape else ''}{stacked}"
