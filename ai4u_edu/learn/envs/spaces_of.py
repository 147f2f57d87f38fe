"""Gymnasium spaces of an agent, and conversion of percepts to observations."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.blocks import Actuator, Percept, Sensor
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.serialization import to_plain

Observation = Any

FORMS = ("dict", "flat", "image")

_FLOAT = np.dtype(np.float32)


class Observer:
    """Converter from percepts to observations.

    Args:
        agent: the agent; its sensors with ``is_input`` are observed.
        form: ``"dict"`` for one entry a sensor, ``"flat"`` for one array of float32, ``"image"``
            for the picture of the only sensor, (height, width, channels) uint8.
    """

    def __init__(self, agent: BasicAgent, form: str) -> None:
        if form not in FORMS:
            raise SetupError(
                _(
                    "observation: expected one of {forms}, got {form!r}; {hint}",
                    forms=", ".join(FORMS),
                    form=form,
                    hint=suggest(form, FORMS),
                )
            )
        sensors = [sensor for sensor in agent.bound_blocks.sensors if sensor.is_input]
        if not sensors:
            raise SetupError(
                _("agent {id!r} has no sensor that a policy could observe (is_input)", id=agent.id)
            )
        self.flat = form == "flat"
        self._keys = [sensor.perception_key for sensor in sensors]
        each = {sensor.perception_key: _space_of(sensor) for sensor in sensors}
        self.image = _only_picture(agent, each) if form == "image" else ""
        self.space: spaces.Space[Any] = (
            each[self.image] if self.image else _flattened(each) if self.flat else spaces.Dict(each)
        )
        slots = agent.bound_blocks.layout.slots
        self._slots = {key: slots[key] for key in self._keys if key in slots}
        self._arrays = {
            key: (slot.shape, slot.dtype, slot.offset)
            for key, slot in self._slots.items()
            if slot.shape
        }
        self._plain = [key for key in self._keys if key not in self._arrays]
        floats = [slot for slot in self._slots.values() if slot.dtype == np.float32]
        # inputs lie first and side by side in a percept, so all-float ones are one run of bytes
        self._run = (sum(slot.size for slot in floats),) if len(floats) == len(each) else None

    def observe(self, percept: Percept) -> Observation:
        """Return a new observation that shares no memory with the percept."""
        if self.image:
            return _own(percept[self.image])
        if not self.flat:
            data = bytearray(percept.data)  # one copy, in which all arrays lie
            observation: dict[str, Any] = {}
            for key, (shape, dtype, offset) in self._arrays.items():
                observation[key] = np.ndarray(shape, dtype, data, offset)
            for key in self._plain:
                observation[key] = _own(percept[key])
            return observation
        if self._run:
            return np.ndarray(self._run, _FLOAT, percept.data).copy()
        parts = [np.asarray(percept[key], np.float32).ravel() for key in self._keys]
        return np.concatenate(parts)

    def writer(self, batch: Any, index: int) -> Callable[[Percept], None]:
        """Return a function that writes observations into one row of a batch.

        Args:
            batch: as Gymnasium's ``create_empty_array`` makes it of :attr:`space`.
            index: the row.
        """
        if self.image:
            batch = {self.image: batch}
        copies, others = self._copies(batch, index), []
        if not self.flat:
            others = [key for key in self._keys if key not in copies]

        def write(percept: Percept) -> None:
            data = percept.data
            for row, begin, end in copies.values():
                row[:] = data[begin:end]
            for key in others:
                _put(batch, key, index, _own(percept[key]))

        def write_all(percept: Percept) -> None:
            batch[index] = self.observe(percept)

        return write if copies or not self.flat else write_all

    def _copies(self, batch: Any, index: int) -> dict[str, tuple[memoryview, int, int]]:
        """Return the slices of a row that are copied from a percept's bytes, with their source."""
        if self.flat:
            whole = batch[index].data.cast("B")
            return {"": (whole, 0, len(whole))} if self._run else {}
        found = {}
        for key, slot in self._slots.items():
            part = batch[key]
            if isinstance(part, np.ndarray) and part.dtype == slot.dtype and slot.size:
                place = part[index : index + 1].data.cast("B")
                found[key] = place, slot.offset, slot.offset + len(place)
        return found


def action_space_of(agent: BasicAgent) -> spaces.Space[Any]:
    """Return the space of the one actuator with ``is_output``, or a Dict of several."""
    each = {name: actuator.space() for name, actuator in outputs_of(agent).items()}
    return next(iter(each.values())) if len(each) == 1 else spaces.Dict(each)


def options_space_of(scene: Scene, sim: ControlRequestor) -> spaces.Dict:
    """Return the space of the options of a scene's reset: a number or a pair for each name.

    Args:
        scene: the scene; numbers are tried in a world of its own.
        sim: the environment's world; numbers of brains that it replaced are left out.
    """
    space: dict[str, spaces.Space[Any]] = {}
    present = sim.options.parameters()
    for name, parameter in scene.build().options.changeable().items():
        if name not in present:
            continue
        number, shape = parameter.declared, (2,) if parameter.declared.is_pair else ()
        kind = np.int64 if number.is_whole else np.float64
        info = np.iinfo(np.int64) if number.is_whole else np.finfo(np.float64)
        low = info.min if math.isinf(number.low) else number.low
        high = info.max if math.isinf(number.high) else number.high
        space[name] = spaces.Box(low, high, shape, kind)
    return spaces.Dict(space)


def inputs_of(agent: BasicAgent) -> dict[str, tuple[tuple[int, ...], np.dtype[Any]]]:
    """Return shape and type of each reading of a policy, in the order of the observation."""
    slots = agent.bound_blocks.layout.slots
    keys = [sensor.perception_key for sensor in agent.bound_blocks.sensors if sensor.is_input]
    return {key: (slots[key].shape, slots[key].dtype) for key in keys if key in slots}


def described_blocks(agent: BasicAgent) -> dict[str, Any]:
    """Return what a network's file says of its agent: ``sensors`` and ``actuators``, by key."""
    inputs = inputs_of(agent)
    return {
        "sensors": {
            sensor.perception_key: to_plain(sensor)
            | {"shape": list(inputs[sensor.perception_key][0])}
            for sensor in agent.sensors
            if sensor.perception_key in inputs
        },
        "actuators": {
            name: to_plain(actuator) | {"space": str(actuator.space())}
            for name, actuator in outputs_of(agent).items()
        },
    }


def outputs_of(agent: BasicAgent) -> dict[str, Actuator]:
    """Return the actuators that a policy drives."""
    found = {
        name: actuator
        for name, actuator in agent.bound_blocks.actuators.items()
        if actuator.is_output
    }
    if not found:
        raise SetupError(
            _("agent {id!r} has no actuator for a policy to drive (is_output)", id=agent.id)
        )
    return found


def _only_picture(agent: BasicAgent, each: dict[str, spaces.Space[Any]]) -> str:
    """Return the key of the one observed sensor, which has to be a picture."""
    if len(each) > 1:
        raise SetupError(
            _(
                "observation='image': expected one sensor that is observed, a picture; "
                "agent {id!r} has {each}; set is_input to False on the others, or take "
                "observation='dict'",
                id=agent.id,
                each=str(sorted(each)),
            )
        )
    ((key, space),) = each.items()
    if not isinstance(space, spaces.Box) or len(space.shape) != 3 or space.dtype != np.uint8:
        raise SetupError(
            _(
                "observation='image': expected a picture (height, width, channels) of whole "
                "numbers 0..255, got {key!r}: {space}; a LocalGridSensor with normalized "
                "False gives one",
                key=key,
                space=str(space),
            )
        )
    return key


def _space_of(sensor: Sensor) -> spaces.Space[Any]:
    space = sensor.observation_space()
    if isinstance(space, spaces.Box) and sensor.reading_kind() in ("sfloat", "sfloatarray"):
        return spaces.Box(space.low.astype(np.float32), space.high.astype(np.float32))
    return space


def _flattened(each: dict[str, spaces.Space[Any]]) -> spaces.Box:
    low: list[npt.NDArray[Any]] = []
    high: list[npt.NDArray[Any]] = []
    for key, space in each.items():
        if isinstance(space, spaces.Box):
            low.append(space.low.ravel())
            high.append(space.high.ravel())
        elif isinstance(space, spaces.Discrete):
            low.append(np.array([space.start]))
            high.append(np.array([space.start + space.n - 1]))
        else:
            raise SetupError(
                _(
                    "observation='flat': sensor {key!r} reads {space}, which is no number; set "
                    "its is_input to False, or use observation='dict'",
                    key=key,
                    space=str(space),
                )
            )
    flat_low, flat_high = np.concatenate(low), np.concatenate(high)
    return spaces.Box(flat_low.astype(np.float32), flat_high.astype(np.float32))


def _own(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, str | tuple):
        return value
    if isinstance(value, bool | int):
        return np.int64(value)
    return np.asarray(value, np.float32)


def _put(batch: dict[str, Any], key: str, index: int, value: Any) -> None:
    part = batch[key]
    if isinstance(part, tuple):  # text has no array
        batch[key] = (*part[:index], value, *part[index + 1 :])
    else:
        part[index] = value
