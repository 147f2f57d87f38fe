"""Baselines: the readings that stand for "this slot says nothing in particular"."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import Sensor
from ai4u_edu.blocks.brains.network import Network
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

Baseline = Mapping[str, npt.NDArray[Any]]
"""A reading for each perception key, in the shape that the percept has."""

_NONE = np.zeros((0,))


def mean_of(percepts: Iterable[Mapping[str, Any]]) -> dict[str, npt.NDArray[Any]]:
    """Return the mean of each numeric reading over many percepts, such as those of a recording.

    A whole number or a yes/no gets its most frequent value, as a mean of them is none.

    Raises:
        SetupError: there are no percepts.

    >>> dark = {"eyes": np.array([0.0, 1.0]), "lit": True}
    >>> bright = {"eyes": np.array([1.0, 1.0]), "lit": True}
    >>> {key: value.tolist() for key, value in mean_of([dark, bright]).items()}
    {'eyes': [0.5, 1.0], 'lit': True}
    """
    rows = list(percepts)
    if not rows:
        raise SetupError(_("expected at least one percept for a baseline, got none"))
    return {
        key: _middle(np.stack([np.asarray(row[key]) for row in rows]))
        for key, value in rows[0].items()
        if np.asarray(value).dtype.kind in "fiub"
    }


def middle_of(agent: BasicAgent) -> dict[str, npt.NDArray[Any]]:
    """Return the middle of the range of each of an agent's readings; 0 where it has no end."""
    return _middles(agent.bound_blocks.sensors)


def middle_for(network: Network) -> dict[str, npt.NDArray[Any]] | None:
    """Return the middle of the ranges of a network's readings, from the scene of its training.

    Returns:
        None if that is no scene of the library, or its agents have other sensors.
    """
    scene = network.about.get("scene")
    if scene not in Scene.names():
        return None
    for agent in Scene.load(scene).build().agents:
        found = middle_of(agent)
        if all(found.get(port.name, _NONE).shape == port.shape for port in network.inputs):
            return {port.name: found[port.name] for port in network.inputs}
    return None


def _middles(sensors: Iterable[Sensor]) -> dict[str, npt.NDArray[Any]]:
    found: dict[str, npt.NDArray[Any]] = {}
    for sensor in sensors:
        space = sensor.observation_space()
        if isinstance(space, spaces.Box):
            low, high = space.low.astype(np.float64), space.high.astype(np.float64)
            has_ends = np.isfinite(low) & np.isfinite(high)
            middle = np.add(low, high, where=has_ends, out=np.zeros_like(low)) / 2
            # a picture of whole codes has no middle: 0 is "nothing there"
            whole = np.issubdtype(space.dtype, np.integer)
            found[sensor.perception_key] = np.zeros_like(space.low) if whole else middle
        elif isinstance(space, spaces.Discrete | spaces.MultiBinary | spaces.MultiDiscrete):
            found[sensor.perception_key] = np.zeros(space.shape or (), np.int64)
    return found


def _middle(values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    if values.dtype.kind == "f":
        return np.asarray(values.mean(axis=0, dtype=np.float64))
    kinds, indices = np.unique(values, return_inverse=True)
    counts = np.stack([(indices.reshape(values.shape) == i).sum(axis=0) for i in range(len(kinds))])
    return np.asarray(kinds[counts.argmax(axis=0)])
