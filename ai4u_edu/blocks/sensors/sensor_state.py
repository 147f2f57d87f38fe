"""State of a sensor, kept while the sensor is set up again; and reading a moment twice."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ai4u_edu.blocks.sensors.sensor import Array, Sensor
from ai4u_edu.world import BodyView, WorldView


@dataclass(frozen=True)
class SensorState:
    """State of a sensor and of the sensors inside it."""

    state: dict[str, Any]
    children: "tuple[SensorState, ...]"

    @classmethod
    def capture(cls, sensor: Sensor) -> "SensorState":
        """Copy the present state of a sensor."""
        return cls(sensor.get_state(), tuple(map(cls.capture, _children(sensor))))

    def restore(self, sensor: Sensor) -> bool:
        """Put the state into a sensor that was set up again.

        Returns:
            False if the reading of the sensor, or of one inside it, has another shape or type now.
        """
        out: Array = self.state["_out"]
        same = out.shape == sensor._out.shape and out.dtype == sensor._out.dtype
        children = _children(sensor)
        if not same or len(children) != len(self.children):
            return False
        pairs = zip(self.children, children, strict=True)
        if not all(memory.restore(each) for memory, each in pairs):
            return False
        sensor.set_state(self.state)
        return True


def read_again(sensor: Sensor, body: BodyView, view: WorldView) -> None:
    """Replace the last reading by a new one of the same moment."""
    _unread(sensor)
    sensor.take(body, view)


def depends_on_status(sensor: Sensor) -> bool:
    """Return True if a sensor, or one inside it, reads its agent's reward or end."""
    return sensor.reads_status or any(map(depends_on_status, _children(sensor)))


def read_status_again(sensor: Sensor, body: BodyView, view: WorldView) -> None:
    """Replace the last reading where it depends on the agent's status; others inside it stay.

    Reading those again could pay a reward twice, or draw other noise.
    """
    held = list(_independent(sensor))
    for child in held:
        child.is_held = True
    try:
        read_again(sensor, body, view)
    finally:
        for child in held:
            child.is_held = False


def _independent(sensor: Sensor) -> Iterator[Sensor]:
    """Yield the sensors inside one that do not depend on the agent's status."""
    for child in _children(sensor):
        if depends_on_status(child):
            yield from _independent(child)
        else:
            yield child


def _unread(sensor: Sensor) -> None:
    """Drop the newest of the delayed readings, and of the stack."""
    if sensor._past:
        sensor._past.pop()
    if sensor.stacked_observations > 1 and not sensor._fresh:
        sensor._unstack()
    for child in _children(sensor):
        if not child.is_held:
            _unread(child)


def _children(sensor: Sensor) -> list[Sensor]:
    return [
        each
        for each in getattr(sensor, "_children", ())
        if isinstance(each, Sensor) and isinstance(getattr(each, "_out", None), np.ndarray)
    ]
