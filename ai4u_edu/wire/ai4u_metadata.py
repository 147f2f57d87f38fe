"""The metadata of AI4U's handshake: shapes and ranges, of which a script makes its spaces."""

import json
from collections.abc import Iterable
from typing import NamedTuple

SENSOR_TYPES = {
    "sfloat": 0,
    "sstring": 1,
    "sbool": 2,
    "sint": 3,
    "sbytearray": 4,
    "sfloatarray": 5,
    "sintarray": 6,
    "sstrings": 7,
    "simage": 8,
}
"""Numbers of AI4U's types in the metadata; fields on the wire have other numbers (``Kind``)."""


class ModelInput(NamedTuple):
    """A reading that is part of a policy's observation."""

    name: str
    shape: tuple[int, ...]
    type: str
    """One of :data:`SENSOR_TYPES`."""
    low: float
    high: float


class ModelOutput(NamedTuple):
    """An actuator that a policy drives."""

    name: str
    is_continuous: bool
    shape: tuple[int, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]


def metadata(inputs: Iterable[ModelInput], outputs: Iterable[ModelOutput]) -> str:
    """Return the metadata as JSON.

    An infinite bound is written as JavaScript's ``Infinity``, which Python reads.

    >>> metadata([ModelInput("eyes", (2,), "sfloatarray", 0.0, 1.0)], [])
    '{"inputs": [{"name": "eyes", "shape": [2], "type": 5, "rangeMin": 0.0, "rangeMax": 1.0, \
"dataType": 5}], "outputs": []}'
    """
    return json.dumps(
        {
            "inputs": [
                {
                    "name": name,
                    "shape": list(shape),
                    "type": SENSOR_TYPES[kind],
                    "rangeMin": low,
                    "rangeMax": high,
                    "dataType": SENSOR_TYPES[kind],
                }
                for name, shape, kind, low, high in inputs
            ],
            "outputs": [
                {
                    "name": name,
                    "isContinuous": continuous,
                    "shape": list(shape),
                    "rangeMin": list(low),
                    "rangeMax": list(high),
                }
                for name, continuous, shape, low, high in outputs
            ],
        }
    )
