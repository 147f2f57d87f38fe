"""The numbers of a sensor's reading, as a program of blocks names them."""

from dataclasses import asdict
from typing import Any

import numpy as np

from ai4u_edu.page.panel.gallery import words_of
from ai4u_edu.snapshot.block_info import SensorInfo

MAX_NAMED_SLOTS = 32
"""Longest reading of which each number has a name; of longer ones a program takes the smallest,
the largest or the mean."""
KINDS = {"b": "bool", "f": "number", "i": "number", "u": "number"}
"""Kinds of values that blocks can use, by numpy's kind."""


def sensor_slots(sensor: SensorInfo, value: Any) -> dict[str, Any]:
    """Return a sensor's name, and those of its numbers with units and ranges.

    Args:
        sensor: description of the sensor.
        value: its reading in the percept.
    """
    array = np.asarray(value)
    count = len(sensor.low)
    axes = array.ndim - (sensor.stack > 1)
    is_listed = axes == 1 and count <= MAX_NAMED_SLOTS and sensor.rays is None
    return {
        "key": sensor.key,
        "title": words_of(sensor.block).title,
        "class": sensor.block,
        "kind": KINDS.get(array.dtype.kind, "text"),
        "unit": sensor.unit,
        "shape": list(array.shape),
        "stack": sensor.stack,
        "slots": _slots(sensor) if is_listed else [],
        "rays": None if sensor.rays is None else asdict(sensor.rays),
    }


def _slots(sensor: SensorInfo) -> list[dict[str, Any]]:
    count = len(sensor.low)
    names = sensor.slots or tuple(map(str, range(count)) if count > 1 else ("",))
    units = sensor.unit.split(", ")
    units = units if len(units) == count else [sensor.unit] * count
    ranges = zip(sensor.low.tolist(), sensor.high.tolist(), strict=True)
    return [
        {"name": name.replace("_", " "), "unit": unit, "low": _short(low), "high": _short(high)}
        for name, unit, (low, high) in zip(names, units, ranges, strict=True)
    ]


def _short(value: float) -> float | None:
    """Return a number with four decimals; None if it is not finite."""
    return round(value, 4) if np.isfinite(value) else None
