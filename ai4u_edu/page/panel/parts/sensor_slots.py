"""The numbers of a sensor's reading, as a program of blocks names them."""

from typing import Any, Literal

import numpy as np
from msgspec import Struct, field

from ai4u_edu.page.panel.gallery import words_of
from ai4u_edu.snapshot.block_info import RayLayout, SensorInfo

MAX_NAMED_SLOTS = 32
"""Longest reading of which each number has a name; of longer ones a program takes the smallest,
the largest or the mean."""
ValueKind = Literal["bool", "number", "text"]
KINDS: dict[str, ValueKind] = {"b": "bool", "f": "number", "i": "number", "u": "number"}
"""Kinds of values that blocks can use, by numpy's kind."""


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


def _short(value: float) -> float | None:
    """Return a number with four decimals; None if it is not finite."""
    return round(value, 4) if np.isfinite(value) else None
