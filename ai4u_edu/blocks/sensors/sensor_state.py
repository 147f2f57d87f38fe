"""What a sensor remembers, kept while it is set up anew; and a second look at the same moment."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ai4u_edu.blocks.sensors.sensor import Array, Sensor
from ai4u_edu.world import BodyView, WorldView


@dataclass(frozen=True)
class SensorState:
    """A sensor's stack, what it holds back, and whether it has read anything yet."""

    out: Array
    state: dict[str, Any]
    children: "tuple[SensorState, ...]"

    @classmethod
    def of(cls, sensor: Sensor) -> "SensorState":
        """What a sensor remembers now."""
        state = {
            "_raw": sensor._raw.copy(),
            "_past": sensor._past.copy(),
            "_fresh": sensor._fresh,
            "_ever_read": sensor._ever_read,
        }
        return cls(sensor._out.copy(), state, tuple(map(cls.of, _children(sensor))))

    def restore(self, sensor: Sensor) -> bool:
        """Has a sensor that was set up anew go on from here; False if its reading looks different.

        Then it begins anew.
        """
        same = self.out.shape == sensor._out.shape and self.out.dtype == sensor._out.dtype
        children = _children(sensor)
        if not same or len(children) != len(self.children):
            return False
        pairs = zip(self.children, children, strict=True)
        if not all(memory.restore(each) for memory, each in pairs):
            return False
        sensor._out[...] = self.out
        for name, value in self.state.items():
            setattr(sensor, name, value)
        return True


def read_again(sensor: Sensor, body: BodyView, view: WorldView) -> None:
    """Reads once more at the same moment: the new reading takes the place of the last one."""
    _unread(sensor)
    stack = sensor._out.copy() if sensor.stacked_observations > 1 and not sensor._fresh else None
    sensor.take(body, view)
    if stack is not None:
        sensor._out[:-1] = stack[:-1]


def _unread(sensor: Sensor) -> None:
    """Forgets the last reading of those that are held back."""
    if sensor._past:
        sensor._past.pop()
    for child in _children(sensor):
        _unread(child)


def _children(sensor: Sensor) -> list[Sensor]:
    return [
        each
        for each in getattr(sensor, "_children", ())
        if isinstance(each, Sensor) and isinstance(getattr(each, "_out", None), np.ndarray)
    ]
