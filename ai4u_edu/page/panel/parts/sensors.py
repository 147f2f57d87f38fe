"""Sensors' readings as JSON: lines with names and units, strips of bars, pictures, or text."""

import base64
import io
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from ai4u_edu.blocks import CodeLegend, Legend, RayPicture
from ai4u_edu.page.panel.gallery import hint_of, words_of
from ai4u_edu.page.panel.parts.colours import hex_colour
from ai4u_edu.snapshot.block_info import SensorInfo
from ai4u_edu.snapshot.numbers import number
from ai4u_edu.snapshot.reading_cells import GREYS, Cells, shaded, split_stack
from ai4u_edu.snapshot.theme import RAY_MISS, UNKNOWN_GROUP, VOID, Rgb

MAX_UNNAMED_LINES = 8
"""Longest reading without names that gets a line for each number; longer ones are strips."""
MAX_NAMED_LINES = 16
"""Longest reading with names that gets a line for each number."""
MAX_BARS = 256
"""Most bars of a strip; of a longer reading only the first numbers are sent."""
MAX_OLDER_READINGS = 4
"""Most older readings of a stack that are sent as strips or pictures: the latest ones."""
MAX_CELLS_PER_SIDE = 96
"""Most rows or columns; of a larger picture only every second, third, ... one is sent."""
MAX_TEXT_CHARS = 400
MAX_LISTED_NUMBERS = 40
RAY_GROUPS, RAY_DISTANCES = slice(-2, None, -2), slice(None, None, -2)
"""Numbers of a reading that alternates groups and distances, from the leftmost ray on."""

Floats = npt.NDArray[np.float64]


def sensor_json(
    sensor: SensorInfo, value: Any, colours: Mapping[str, Rgb], rays: RayPicture | None
) -> dict[str, Any]:
    """Return a reading and what its sensor is.

    Args:
        sensor: description of the sensor.
        value: its reading in the percept.
        colours: colours by group.
        rays: the sensor's rays, if it has some.
    """
    words = words_of(sensor.block)
    return {
        "key": sensor.key,
        "title": words.title,
        "class": sensor.block,
        "icon": words.picture,
        "help": hint_of(sensor.block),
        "shape": list(np.shape(value)),
        "stack": sensor.stack,
        **_reading(sensor, value, colours, rays),
    }


def _reading(
    sensor: SensorInfo, value: Any, colours: Mapping[str, Rgb], rays: RayPicture | None
) -> dict[str, Any]:
    if sensor.legend is not None:
        return {"pictures": _pictures(value, sensor.legend, colours, sensor.stack)}
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or array.size != sensor.stack * len(sensor.low):
        return {"text": reading_text(value)}
    rows = array.reshape(sensor.stack, -1).astype(np.float64)
    if len(sensor.low) <= (MAX_NAMED_LINES if sensor.slots else MAX_UNNAMED_LINES):
        return {"values": _lines(sensor, rows)}
    return {"strips": _strips(sensor, rows, colours, rays)}


def reading_text(value: Any) -> str:
    """Return a reading that is no list of numbers with known ranges as a text.

    >>> reading_text(True), reading_text("robot"), reading_text((1, 2.5))
    ('yes', 'robot', '1, 2.50')
    """
    if isinstance(value, str):
        return value[:MAX_TEXT_CHARS]
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    array = np.asarray(value)
    if array.dtype.kind not in "fiub":
        return ", ".join(map(str, array.ravel()[:MAX_LISTED_NUMBERS].tolist()))[:MAX_TEXT_CHARS]
    texts = [number(each) for each in array.ravel()[:MAX_LISTED_NUMBERS].tolist()]
    rest = ["..."] if array.size > MAX_LISTED_NUMBERS else []
    if isinstance(value, tuple | list) and all(isinstance(each, int | float) for each in value):
        texts = [number(each) for each in value[:MAX_LISTED_NUMBERS]]
    return ", ".join(texts + rest)


def _lines(sensor: SensorInfo, rows: Floats) -> list[dict[str, Any]]:
    """Return each number with its name, unit and range, and its older values, oldest first."""
    count = len(sensor.low)
    names = sensor.slots or tuple(map(str, range(count)) if count > 1 else ("value",))
    units = sensor.unit.split(", ")
    units = units if len(units) == count else [sensor.unit] * count
    return [
        {
            "name": name.replace("_", " "),
            "value": _short(rows[-1, i]),
            "text": number(float(rows[-1, i])),
            "unit": units[i],
            "low": _short(sensor.low[i]),
            "high": _short(sensor.high[i]),
            "is_seen": bool(rows[-1, i] >= sensor.low[i] - 1e-4 * (1 + abs(sensor.low[i]))),
            **({"older": rows[:-1, i].round(4).tolist()} if len(rows) > 1 else {}),
        }
        for i, name in enumerate(names)
    ]


def _strips(
    sensor: SensorInfo, rows: Floats, colours: Mapping[str, Rgb], rays: RayPicture | None
) -> list[dict[str, Any]]:
    ends = f"{number(float(sensor.low.min()))} to {number(float(sensor.high.max()))}"
    ends = f"{ends} {sensor.unit}".strip()
    cut = f", the first {MAX_BARS} of {rows.shape[1]}" if rows.shape[1] > MAX_BARS else ""
    count = 0 if rays is None else len(rays.groups)
    everything = slice(None)
    if rays is None or rows.shape[1] not in {count, 2 * count}:
        return [_strip(sensor, rows, everything, f"{ends}{cut}")]
    known = {"": RAY_MISS, "?": UNKNOWN_GROUP} | dict(colours)
    # a sensor reads its rightmost ray first
    hits = [hex_colour(known.get(group, UNKNOWN_GROUP)) for group in reversed(rays.groups)]
    if rows.shape[1] == count:
        caption = f"each ray, left to right: {ends}{cut}"
        return [_strip(sensor, rows, slice(None, None, -1), caption, hits)]
    captions = "what each ray hit", f"distance (left to right): {ends}{cut}"
    return [
        _strip(sensor, rows, part, caption, hits)
        for part, caption in zip((RAY_GROUPS, RAY_DISTANCES), captions, strict=True)
    ]


def _strip(
    sensor: SensorInfo,
    rows: Floats,
    part: slice,
    caption: str,
    colours: Sequence[str] | None = None,
) -> dict[str, Any]:
    """Return bars side by side, as positions in their ranges from 0 to 1, left to right."""
    low, high = sensor.low[part][:MAX_BARS], sensor.high[part][:MAX_BARS]
    span = np.maximum(high - low, 1e-9)

    def shares(values: Floats) -> list[float]:
        positions: list[float] = np.clip((values - low) / span, 0, 1).round(3).tolist()
        return positions

    older = [shares(row[part][:MAX_BARS]) for row in rows[:-1][-MAX_OLDER_READINGS:]]
    return {
        "caption": caption,
        "zeros": shares(np.zeros(len(low))),
        "shares": shares(rows[-1][part][:MAX_BARS]),
        "colours": None if colours is None else list(colours[:MAX_BARS]),
        "older": older,
    }


def _pictures(
    value: Any, legend: Legend, colours: Mapping[str, Rgb], stack: int
) -> list[dict[str, Any]]:
    """Return a reading as pictures: the groups in its cells, distances, and older readings."""
    known = [
        VOID if group == "void" else colours.get(group, UNKNOWN_GROUP) for group in legend.groups
    ]
    array = np.asarray(value)
    made = [_picture(legend.groups_in(value), known, "")]
    if isinstance(legend, CodeLegend) and legend.planes > 1:
        planes = array.reshape(-1, *legend.shape)[1 - legend.planes :]
        made += [_picture(shaded(plane), GREYS, "distance: dark is near") for plane in planes]
    older = split_stack(array, legend, stack)[:-1][-MAX_OLDER_READINGS:]
    return made + [_picture(legend.groups_in(each), known, "earlier") for each in older]


def _picture(cells: Cells, colours: Sequence[Rgb], caption: str) -> dict[str, Any]:
    """Return cells as a PNG with a pixel each; cell 0, of nothing, is transparent."""
    step = -(-max(cells.shape) // MAX_CELLS_PER_SIDE)
    cells = cells[::step, ::step]
    image = Image.fromarray(cells.astype(np.uint8))
    image.putpalette([channel for colour in ((0, 0, 0), *colours) for channel in colour])
    out = io.BytesIO()
    image.save(out, "PNG", transparency=0)
    data = base64.b64encode(out.getvalue()).decode()
    rows, columns = cells.shape
    return {
        "rows": rows,
        "columns": columns,
        "cells": f"data:image/png;base64,{data}",
        "caption": caption,
    }


def _short(value: Any) -> float | None:
    """Return a number with four decimals; None if it is not finite."""
    return round(float(value), 4) if np.isfinite(value) else None
