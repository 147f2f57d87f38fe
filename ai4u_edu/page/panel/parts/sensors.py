"""Sensors' readings: lines, strips of bars, pictures or text for a page, and names for programs."""

import base64
import io
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from msgspec import UNSET, Struct, UnsetType, field
from PIL import Image

from ai4u_edu.base.colors import hex_colour
from ai4u_edu.blocks import CodeLegend, Legend, RayPicture
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.panel.block_words import NUMBER_NAMES
from ai4u_edu.page.panel.gallery import hint_of, words_of
from ai4u_edu.snapshot.block_info import RayLayout, SensorInfo
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

MAX_NAMED_SLOTS = 32
"""Longest reading of which each number has a name; of longer ones a program takes the smallest,
the largest or the mean."""
ValueKind = Literal["bool", "number", "text"]
KINDS: dict[str, ValueKind] = {"b": "bool", "f": "number", "i": "number", "u": "number"}
"""Kinds of values that blocks can use, by numpy's kind."""

Floats = npt.NDArray[np.float64]


class ReadingLine(Struct, frozen=True):
    """One number of a reading."""

    name: str
    value: float | None
    """The number, with four decimals; null if it is not finite."""
    text: str
    """The number as text."""
    unit: str
    """Its unit; empty if it is normalized, or has none."""
    low: float | None
    """Lower bound; null if it has none."""
    high: float | None
    """Upper bound; null if it has none."""
    is_seen: bool
    """False for a number below its range, which stands for "not visible"."""
    older: list[float] | UnsetType = UNSET
    """Its older values, oldest first; left out if readings are not stacked."""


class ReadingStrip(Struct, frozen=True):
    """Many numbers as bars side by side, left to right."""

    caption: str
    zeros: list[float]
    """Position of zero in the range of each number, 0 to 1."""
    shares: list[float]
    """Position of each number in its range, 0 to 1."""
    colours: list[str] | None
    """Colour of each bar as CSS has it; null for one colour."""
    older: list[list[float]]
    """Positions of older readings, oldest first."""


class ReadingPicture(Struct, frozen=True):
    """A picture of a reading, with a pixel for each cell."""

    rows: int
    columns: int
    cells: str
    """Address of the picture: a PNG as a ``data:`` URL."""
    caption: str
    """Its subject; ``earlier`` for an older reading, empty for the groups in its cells."""


class SensorReading(Struct, frozen=True, kw_only=True):
    """A sensor and its reading: one of ``pictures``, ``text``, ``values`` and ``strips``."""

    key: str
    """Its perception key."""
    title: str
    type_name: str = field(name="class")
    """Name of its class."""
    icon: str
    """Name of its icon, as in ``web/shared/icons.js``."""
    help: str
    """A short sentence about it."""
    shape: list[int]
    """Shape of the reading; empty for a single value."""
    stack: int
    """Number of stacked readings, oldest first."""
    pictures: list[ReadingPicture] | UnsetType = UNSET
    text: str | UnsetType = UNSET
    values: list[ReadingLine] | UnsetType = UNSET
    strips: list[ReadingStrip] | UnsetType = UNSET
    is_drawable: bool
    """True if the page's picture can show it."""
    is_shown: bool
    """True if the page's picture shows it."""


def sensor_reading(
    sensor: SensorInfo,
    value: Any,
    colours: Mapping[str, Rgb],
    rays: RayPicture | None,
    *,
    title: str,
    is_drawable: bool,
    is_shown: bool,
) -> SensorReading:
    """Return a reading and what its sensor is.

    Args:
        sensor: description of the sensor.
        value: its reading in the percept.
        colours: colours by group.
        rays: the sensor's rays, if it has some.
        title: the sensor's title.
        is_drawable: True if the page's picture can show it.
        is_shown: True if the page's picture shows it.
    """
    pictures: list[ReadingPicture] | UnsetType = UNSET
    text: str | UnsetType = UNSET
    lines: list[ReadingLine] | UnsetType = UNSET
    strips: list[ReadingStrip] | UnsetType = UNSET
    array = np.asarray(value)
    if sensor.legend is not None:
        pictures = _pictures(value, sensor.legend, colours, sensor.stack)
    elif array.dtype.kind not in "fiu" or array.size != sensor.stack * len(sensor.low):
        text = reading_text(value)
    else:
        rows = array.reshape(sensor.stack, -1).astype(np.float64)
        if len(sensor.low) <= (MAX_NAMED_LINES if sensor.slots else MAX_UNNAMED_LINES):
            lines = _lines(sensor, rows)
        else:
            strips = _strips(sensor, rows, colours, rays)
    return SensorReading(
        key=sensor.key,
        title=title,
        type_name=sensor.block,
        icon=words_of(sensor.block).picture,
        help=hint_of(sensor.block),
        shape=list(np.shape(value)),
        stack=sensor.stack,
        pictures=pictures,
        text=text,
        values=lines,
        strips=strips,
        is_drawable=is_drawable,
        is_shown=is_shown,
    )


def reading_text(value: Any) -> str:
    """Return a reading that is no list of numbers with known ranges as a text.

    >>> reading_text(True), reading_text("robot"), reading_text((1, 2.5))
    ('yes', 'robot', '1, 2.50')
    """
    if isinstance(value, str):
        return value[:MAX_TEXT_CHARS]
    if isinstance(value, bool | np.bool_):
        return _("yes") if value else _("no")
    array = np.asarray(value)
    if array.dtype.kind not in "fiub":
        return ", ".join(map(str, array.ravel()[:MAX_LISTED_NUMBERS].tolist()))[:MAX_TEXT_CHARS]
    texts = [number(each) for each in array.ravel()[:MAX_LISTED_NUMBERS].tolist()]
    rest = ["..."] if array.size > MAX_LISTED_NUMBERS else []
    if isinstance(value, tuple | list) and all(isinstance(each, int | float) for each in value):
        texts = [number(each) for each in value[:MAX_LISTED_NUMBERS]]
    return ", ".join(texts + rest)


def _lines(sensor: SensorInfo, rows: Floats) -> list[ReadingLine]:
    """Return each number with its name, unit and range, and its older values, oldest first."""
    count = len(sensor.low)
    names = sensor.slot_words or tuple(map(str, range(count)) if count > 1 else (_("value"),))
    units = sensor.unit.split(", ")
    units = units if len(units) == count else [sensor.unit] * count
    return [
        ReadingLine(
            name=NUMBER_NAMES.get(name, name),
            value=_short(rows[-1, i]),
            text=number(float(rows[-1, i])),
            unit=units[i],
            low=_short(sensor.low[i]),
            high=_short(sensor.high[i]),
            is_seen=bool(rows[-1, i] >= sensor.low[i] - 1e-4 * (1 + abs(sensor.low[i]))),
            older=rows[:-1, i].round(4).tolist() if len(rows) > 1 else UNSET,
        )
        for i, name in enumerate(names)
    ]


def _strips(
    sensor: SensorInfo, rows: Floats, colours: Mapping[str, Rgb], rays: RayPicture | None
) -> list[ReadingStrip]:
    low, high = number(float(sensor.low.min())), number(float(sensor.high.max()))
    ends = _("{low} to {high}", low=low, high=high)
    if sensor.unit:
        ends = _("{low} to {high} {unit}", low=low, high=high, unit=sensor.unit)
    if rows.shape[1] > MAX_BARS:
        ends = _("{ends}, the first {n} of {total}", ends=ends, n=MAX_BARS, total=rows.shape[1])
    count = 0 if rays is None else len(rays.groups)
    everything = slice(None)
    if rays is None or rows.shape[1] not in {count, 2 * count}:
        return [_strip(sensor, rows, everything, ends)]
    known = {"": RAY_MISS, "?": UNKNOWN_GROUP} | dict(colours)
    # a sensor reads its rightmost ray first
    hits = [hex_colour(known.get(group, UNKNOWN_GROUP)) for group in reversed(rays.groups)]
    if rows.shape[1] == count:
        caption = _("each ray, left to right: {ends}", ends=ends)
        return [_strip(sensor, rows, slice(None, None, -1), caption, hits)]
    captions = _("what each ray hit"), _("distance (left to right): {ends}", ends=ends)
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
) -> ReadingStrip:
    """Return bars side by side, as positions in their ranges from 0 to 1, left to right."""
    low, high = sensor.low[part][:MAX_BARS], sensor.high[part][:MAX_BARS]
    span = np.maximum(high - low, 1e-9)

    def shares(values: Floats) -> list[float]:
        positions: list[float] = np.clip((values - low) / span, 0, 1).round(3).tolist()
        return positions

    older = [shares(row[part][:MAX_BARS]) for row in rows[:-1][-MAX_OLDER_READINGS:]]
    return ReadingStrip(
        caption=caption,
        zeros=shares(np.zeros(len(low))),
        shares=shares(rows[-1][part][:MAX_BARS]),
        colours=None if colours is None else list(colours[:MAX_BARS]),
        older=older,
    )


def _pictures(
    value: Any, legend: Legend, colours: Mapping[str, Rgb], stack: int
) -> list[ReadingPicture]:
    """Return a reading as pictures: the groups in its cells, distances, and older readings."""
    known = [
        VOID if group == "void" else colours.get(group, UNKNOWN_GROUP) for group in legend.groups
    ]
    array = np.asarray(value)
    older = split_stack(array, legend, stack)[:-1][-MAX_OLDER_READINGS:]
    if isinstance(legend, CodeLegend):
        latest = array.reshape(-1, *legend.shape)[-legend.planes :]
        distances = latest[legend.has_codes :]
        greys = [_picture(shaded(plane), GREYS, _("distance: dark is near")) for plane in distances]
        if not legend.has_codes:
            shades = [shaded(each.reshape(legend.shape)) for each in older]
            return greys + [_picture(cells, GREYS, "earlier") for cells in shades]
    else:
        greys = []
    earlier = [_picture(legend.groups_in(each), known, "earlier") for each in older]
    return [_picture(legend.groups_in(value), known, ""), *greys, *earlier]


def _picture(cells: Cells, colours: Sequence[Rgb], caption: str) -> ReadingPicture:
    """Return cells as a PNG with a pixel each; cell 0, of nothing, is transparent."""
    step = -(-max(cells.shape) // MAX_CELLS_PER_SIDE)
    cells = cells[::step, ::step]
    image = Image.fromarray(cells.astype(np.uint8))
    image.putpalette([channel for colour in ((0, 0, 0), *colours) for channel in colour])
    out = io.BytesIO()
    image.save(out, "PNG", transparency=0)
    data = base64.b64encode(out.getvalue()).decode()
    rows, columns = cells.shape
    return ReadingPicture(rows, columns, f"data:image/png;base64,{data}", caption)


def _short(value: Any) -> float | None:
    """Return a number with four decimals; None if it is not finite."""
    return round(float(value), 4) if np.isfinite(value) else None


class SensorSlot(Struct, frozen=True):
    """One number of a reading."""

    name: str
    """Its name; empty if it is the only one and has none."""
    unit: str
    """Its unit; empty if it is normalized, or has none."""
    low: float | None
    """Lower bound; null if it has none."""
    high: float | None
    """Upper bound; null if it has none."""


class ProgramSensor(Struct, frozen=True):
    """A sensor as a program reads it."""

    key: str
    """Its perception key."""
    title: str
    type_name: str = field(name="class")
    """Name of its class."""
    kind: ValueKind
    unit: str
    """Unit of the reading; empty if it is normalized, or has none."""
    shape: list[int]
    """Shape of the reading; empty for a single value."""
    stack: int
    """Number of stacked readings, oldest first."""
    slots: list[SensorSlot]
    """Its numbers; empty if there are too many of them, or several axes."""
    rays: RayLayout | None
    """Order of the numbers of a flat fan of rays; null for another sensor."""


def program_sensor(sensor: SensorInfo, value: Any) -> ProgramSensor:
    """Return a sensor's name, and those of its numbers with units and ranges.

    Args:
        sensor: description of the sensor.
        value: its reading in the percept.
    """
    array = np.asarray(value)
    count = len(sensor.low)
    axes = array.ndim - (sensor.stack > 1)
    is_listed = axes == 1 and count <= MAX_NAMED_SLOTS and sensor.rays is None
    return ProgramSensor(
        key=sensor.key,
        title=words_of(sensor.block).title,
        type_name=sensor.block,
        kind=KINDS.get(array.dtype.kind, "text"),
        unit=sensor.unit,
        shape=list(array.shape),
        stack=sensor.stack,
        slots=_slots(sensor) if is_listed else [],
        rays=sensor.rays,
    )


def _slots(sensor: SensorInfo) -> list[SensorSlot]:
    count = len(sensor.low)
    names = sensor.slots or tuple(map(str, range(count)) if count > 1 else ("",))
    units = sensor.unit.split(", ")
    units = units if len(units) == count else [sensor.unit] * count
    ranges = zip(sensor.low.tolist(), sensor.high.tolist(), strict=True)
    return [
        SensorSlot(name.replace("_", " "), unit, _short(low), _short(high))
        for name, unit, (low, high) in zip(names, units, ranges, strict=True)
    ]
