"""Sensor readings as HTML for the panel, with names, units and ranges of their numbers."""

from collections.abc import Mapping, Sequence
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
RAY_GROUPS, RAY_DISTANCES = slice(-2, None, -2), slice(None, None, -2)
"""Places of codes and distances in the pairs that a ray sensor reads, leftmost ray first."""


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
    ends = f"{number(float(sensor.low.min()))} to {number(float(sensor.high.max()))}"
    ends = f"{ends} {escape(sensor.unit)}".strip()
    cut = f", the first {MAX_BARS} of {rows.shape[1]}" if rows.shape[1] > MAX_BARS else ""
    count = 0 if rays is None else len(rays.groups)
    if rays is None or rows.shape[1] not in {count, 2 * count}:
        drawn = _strips(rows, sensor)
        return f"{drawn}<br><small>{ends}{cut}</small>"
    known = {"": RAY_MISS, "?": UNKNOWN_GROUP} | dict(colours)
    # a sensor reads its rightmost ray first
    hits = [known.get(group, UNKNOWN_GROUP) for group in reversed(rays.groups)]
    if rows.shape[1] == count:
        drawn = _strips(rows[:, ::-1], sensor, slice(None, None, -1), hits)
        return f"{drawn}<br><small>each ray, left to right: {ends}{cut}</small>"
    captions = "what each ray hit", f"distance (left to right): {ends}{cut}"
    return "".join(
        f"{_strips(rows[:, part], sensor, part, hits)}<small>{caption}</small>"
        for part, caption in zip((RAY_GROUPS, RAY_DISTANCES), captions, strict=True)
    )


def _strips(
    rows: npt.NDArray[np.float64],
    sensor: SensorInfo,
    part: slice = slice(None),
    colours: Sequence[Rgb] | None = None,
) -> str:
    """Return a strip of the latest row, below smaller ones of the rows before.

    Args:
        rows: (n, m) numbers, oldest row first.
        sensor: description of the sensor, with the range of each number of a reading.
        part: where in a reading the m numbers are.
        colours: the m bars' colours in the latest row.
    """
    low, high = sensor.low[part][:MAX_BARS], sensor.high[part][:MAX_BARS]
    older = [
        strip(row[:MAX_BARS], low, high, kind="strip old")
        for row in rows[:-1][-MAX_OLDER_READINGS:]
    ]
    latest = strip(rows[-1][:MAX_BARS], low, high, colours[:MAX_BARS] if colours else None)
    return "".join([*older, latest])


def _title(sensor: SensorInfo, value: Any) -> str:
    shape = " x ".join(map(str, np.shape(value)))
    stacked = f", the last {sensor.stack}" if sensor.stack > 1 else ""
    return f"{escape(sensor.block)}{f' {shape}' if shape else ''}{stacked}"
