"""The spaces of a remote agent, as Gymnasium's spaces."""

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ai4u_edu.base.errors import shown
from ai4u_edu.locale import gettext as _
from ai4u_edu.remote.errors import RemoteError
from ai4u_edu.wire.native import MAX_WORLD_FRAME_BYTES, Output, Reading
from ai4u_edu.wire.texts import SEVERAL

_NO_SPACE = (ValueError, IndexError, AssertionError, TypeError, OverflowError)
"""Errors of numpy and Gymnasium for bounds and shapes that don't fit together."""


def reading_space(reading: Reading) -> spaces.Space[Any]:
    """Return the space of a reading.

    Raises:
        RemoteError: the world's description makes no space.
    """
    try:
        if math.prod(reading.shape) > MAX_WORLD_FRAME_BYTES:
            raise ValueError(
                _("shape {shape} is larger than any percept", shape=shown(reading.shape))
            )
        if reading.kind == "text":
            text = spaces.Text(reading.shape[0])
            return spaces.Sequence(text) if reading.sensor_type == SEVERAL else text
        low, high = (np.frombuffer(bound, reading.dtype) for bound in (reading.low, reading.high))
        if reading.kind == "discrete":
            return spaces.Discrete(int(high[0]) - int(low[0]) + 1, start=int(low[0]))
        dtype: Any = np.dtype(reading.dtype)
        return spaces.Box(
            _spread(low, reading.shape), _spread(high, reading.shape), reading.shape, dtype
        )
    except _NO_SPACE as error:
        raise RemoteError(
            _(
                "reading {key!r}: expected a space, got one that is none ({problem})",
                key=reading.key,
                problem=str(error),
            )
        ) from None


def output_space(output: Output) -> spaces.Space[Any]:
    """Return the space of an actuator's actions.

    Raises:
        RemoteError: the world's description makes no space.
    """
    try:
        if output.kind == "discrete":
            start = int(output.low[0])
            return spaces.Discrete(int(output.high[0]) - start + 1, start=start)
        with np.errstate(over="ignore"):  # what float32 can't hold is as good as infinite
            low, high = np.array(output.low, np.float32), np.array(output.high, np.float32)
        return spaces.Box(low, high, dtype=np.float32)
    except _NO_SPACE as error:
        raise RemoteError(
            _(
                "actuator {name!r}: expected a space, got one that is none ({problem})",
                name=output.name,
                problem=str(error),
            )
        ) from None


def observation_space(readings: Iterable[Reading], form: str = "dict") -> spaces.Dict | spaces.Box:
    """Return the space of a policy's observation.

    Args:
        readings: of the agent; those with ``is_input`` are used.
        form: ``"dict"`` for one entry a reading, ``"flat"`` for one array of float32.
    """
    each = {reading.key: reading_space(reading) for reading in readings if reading.is_input}
    if not each:
        raise RemoteError(_("the agent has no sensor that a policy could observe (is_input)"))
    if form == "dict":
        return spaces.Dict(each)
    bounds = [_bounds(key, space) for key, space in each.items()]
    low = np.concatenate([low for low, _ in bounds]).astype(np.float32)
    high = np.concatenate([high for _, high in bounds]).astype(np.float32)
    return spaces.Box(low, high)


def action_space(outputs: Mapping[str, Output]) -> spaces.Space[Any]:
    """Return the space of the one actuator that a policy drives, or a Dict of several."""
    each = {name: output_space(output) for name, output in outputs.items() if output.is_output}
    if not each:
        raise RemoteError(_("the agent has no actuator for a policy to drive (is_output)"))
    return next(iter(each.values())) if len(each) == 1 else spaces.Dict(each)


def _spread(bound: npt.NDArray[Any], shape: tuple[int, ...]) -> npt.NDArray[Any]:
    return np.full(shape, bound[0]) if bound.size == 1 else bound.reshape(shape)


def _bounds(key: str, space: spaces.Space[Any]) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    if isinstance(space, spaces.Box):
        return space.low.ravel(), space.high.ravel()
    if isinstance(space, spaces.Discrete):
        return np.array([space.start]), np.array([space.start + space.n - 1])
    raise RemoteError(
        _(
            "observation='flat': sensor {key!r} reads {space}, which is no number; use "
            "observation='dict'",
            key=key,
            space=str(space),
        )
    )
