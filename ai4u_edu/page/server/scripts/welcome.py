"""The description of an agent for a script: its readings and their layout, its actuators."""

from collections.abc import Collection
from typing import Any

import numpy as np
from gymnasium import spaces

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.blocks import Actuator, Percept
from ai4u_edu.blocks.percept import Slot
from ai4u_edu.locale import gettext as _
from ai4u_edu.wire import native
from ai4u_edu.wire.texts import pack_texts


class ObservationSubset:
    """A selection of the readings in an agent's percepts.

    Args:
        agent: the agent.
        keys: of the readings; empty: all.

    Raises:
        NameNotFoundError: there is no such reading.
    """

    def __init__(self, agent: BasicAgent, keys: Collection[str]) -> None:
        layout = agent.bound_blocks.layout
        known = (*layout.slots, *layout.texts)
        for key in keys:
            if key not in known:
                hint = suggest(key, known)
                raise NameNotFoundError(
                    _("there is no sensor called {key!r}; {hint}", key=key, hint=hint)
                )
        wanted = set(keys or known)
        sensors = {sensor.perception_key: sensor for sensor in agent.bound_blocks.sensors}
        self._slots = [slot for key, slot in layout.slots.items() if key in wanted]
        self._texts = [place for place, key in enumerate(layout.texts) if key in wanted]
        self._is_all = len(wanted) == len(known)
        found = []
        offset = 0
        for slot in self._slots:
            place = slot.offset if self._is_all else offset
            offset += slot.size * slot.dtype.itemsize
            sensor = sensors[slot.key]
            low, high = _bounds(sensor.observation_space(), slot)
            found.append(
                native.Reading(
                    key=slot.key,
                    kind="discrete" if _is_discrete(sensor.observation_space()) else "box",
                    sensor_type=sensor.reading_kind(),
                    dtype=slot.dtype.str,  # type: ignore[arg-type]  # DTYPES has no others
                    shape=slot.shape,
                    offset=place,
                    low=low,
                    high=high,
                    unit=sensor.unit,
                    is_input=sensor.is_input,
                )
            )
        for number, place in enumerate(self._texts):
            sensor = sensors[layout.texts[place]]
            space = sensor.observation_space()
            longest = native.MAX_READING_CHARS
            if isinstance(space, spaces.Text):
                longest = min(longest, space.max_length)
            found.append(
                native.Reading(
                    key=layout.texts[place],
                    kind="text",
                    sensor_type=sensor.reading_kind(),
                    dtype="",
                    shape=(longest,),
                    offset=number,
                    low=b"",
                    high=b"",
                    unit=sensor.unit,
                    is_input=sensor.is_input,
                )
            )
        self.readings = tuple(found)

    def extract(self, percept: Percept) -> tuple[bytes, tuple[str, ...]]:
        """Return the numbers, one reading after another, and the texts."""
        texts = tuple([_as_text(percept.texts[place]) for place in self._texts])
        if self._is_all:
            return percept.data, texts
        parts = [
            percept.data[slot.offset : slot.offset + slot.size * slot.dtype.itemsize]
            for slot in self._slots
        ]
        return b"".join(parts), texts


def _as_text(reading: str | tuple[str, ...]) -> str:
    """Return a text reading as it is sent; several texts are packed into one."""
    if isinstance(reading, tuple):
        return pack_texts(reading, native.MAX_READING_CHARS)
    return reading[: native.MAX_READING_CHARS]


def output_of(name: str, actuator: Actuator) -> native.Output:
    """Describe an actuator for a script."""
    low, high = actuator.limits()
    return native.Output(
        name=name,
        kind="discrete" if _is_discrete(actuator.space()) else "box",
        low=tuple(map(float, low)),
        high=tuple(map(float, high)),
        is_output=actuator.is_output,
    )


def _is_discrete(space: spaces.Space[Any]) -> bool:
    return isinstance(space, spaces.Discrete)


def _bounds(space: spaces.Space[Any], slot: Slot) -> tuple[bytes, bytes]:
    """Return the lowest and highest values: one each if all entries share it, else one an entry."""
    if isinstance(space, spaces.Discrete):
        # numbers from 0 on need no more than this; a bool is 0 or 1
        low, high = np.array([space.start]), np.array([space.start + space.n - 1])
    elif isinstance(space, spaces.Box):
        low, high = space.low.ravel(), space.high.ravel()
    else:
        low, high = np.array([-np.inf]), np.array([np.inf])
    if low.size and (low == low[0]).all() and (high == high[0]).all():
        low, high = low[:1], high[:1]
    return low.astype(slot.dtype).tobytes(), high.astype(slot.dtype).tobytes()
