"""A sensor that joins other sensors' readings."""

import math
from collections.abc import Sequence
from functools import partial
from typing import Annotated

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.errors import BlockError, ReadingError
from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.percept import DTYPES
from ai4u_edu.blocks.sensors.sensor import Array, Sensor
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView

ROUNDING_TOLERANCE = 1e-5
"""Relative tolerance at the ends of the range, for rounding in float32."""


class FloatArrayCompositeSensor(Sensor):
    """The readings of its children, one after another, as one array of floats.

    The children may read anything but text; a bool reads as ``range_max`` or ``range_min``. Their
    readings are flattened, and stacked as a whole. With ``normalize`` every number v becomes
    ``(v - min_value) / (max_value - min_value)``. A child that is not active when the agent is set
    up is left out.

    Reading: (n,), within range_min..range_max. A number outside this range is an error that names
    the child: widen the range, or normalise the child (``normalized`` there, or ``normalize``
    here). Source: AI4U, which neither checks nor clips.
    """

    perception_key: str = "array"
    sensors: Annotated[list[Sensor], Field(min_length=1)]
    """Sensors whose readings are joined, in this order; at least one."""
    range_min: Annotated[float, quantity("")] = -1.0
    """Smallest number of the reading; also the reading of a false bool."""
    range_max: Annotated[float, quantity("")] = 1.0
    """Largest number of the reading, above range_min; also the reading of a true bool."""
    normalize: bool = False
    """True shifts and scales the numbers so that min_value..max_value becomes 0..1."""
    min_value: Annotated[float, quantity("")] = -1.0
    """Number that ``normalize`` maps to 0."""
    max_value: Annotated[float, quantity("")] = 1.0
    """Number that ``normalize`` maps to 1; above min_value."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self._children = [child for child in self.sensors if child.is_active]
        if self.max_value <= self.min_value or self.range_max <= self.range_min:
            raise BlockError(
                _(
                    "{type} {perception_key!r}: expected a max above its min, got range "
                    "{range_min}..{range_max} and values {min_value}..{max_value}",
                    type=type(self).__name__,
                    perception_key=self.perception_key,
                    range_min=self.range_min,
                    range_max=self.range_max,
                    min_value=self.min_value,
                    max_value=self.max_value,
                )
            )

    def inner_blocks(self) -> Sequence[Sensor]:
        """Return the children that are active."""
        return [child for child in self.sensors if child.is_active]

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Set up the children, each with a buffer for its reading."""
        self._children = list(self.inner_blocks())
        self._places: list[Array] = []
        for child in self._children:
            child.on_setup(agent, view)
            kind = child.reading_kind()
            if kind not in DTYPES:
                raise BlockError(
                    _(
                        "{type} {perception_key!r} reads text; a composite takes numbers only",
                        type=type(child).__name__,
                        perception_key=child.perception_key,
                    )
                )
            place = np.zeros(child.observation_space().shape or (), DTYPES[kind])
            child.attach(place, partial(view.random, self._name_of(child)))
            self._places.append(place)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Reset the children; one with ``resetable`` off keeps its state."""
        for child in self._children:
            if child.resetable:
                child.on_reset(agent, view)
            child.restart()

    @property
    def has_ticks(self) -> bool:
        """True if a child has something to do after every tick."""
        return any(child.has_ticks for child in self._children)

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Call the children's on_tick."""
        for child in self._children:
            if child.has_ticks:
                child.on_tick(body, view)

    def space(self) -> Box:
        """Return the range of the numbers that all children read together."""
        shapes = [child.observation_space().shape or () for child in self._children]
        size = sum(math.prod(shape) for shape in shapes)
        return Box(self.range_min, self.range_max, (size,))

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Read all children into ``out``."""
        start = 0
        for child, place in zip(self._children, self._places, strict=True):
            if child.is_held:
                pass
            elif child.is_active:
                child.take(body, view)
            else:
                child.blank()
            part = out[start : start + place.size]
            start += place.size
            if place.dtype == np.bool_:
                part[...] = np.where(place, self.range_max, self.range_min).ravel()
            elif self.normalize:
                part[...] = (place.ravel() - self.min_value) / (self.max_value - self.min_value)
            else:
                part[...] = place.ravel()
        if out.size and not self.range_min <= out.min() <= out.max() <= self.range_max:
            self._trim(out)

    def _trim(self, out: Array) -> None:
        """Clip rounding errors at the ends of the range, and refuse numbers farther outside."""
        low, high = self.range_min, self.range_max
        slack = ROUNDING_TOLERANCE * max(1.0, abs(low), abs(high))
        start = 0
        for child, place in zip(self._children, self._places, strict=True):
            part = out[start : start + place.size]
            start += place.size
            beyond = part[~((part >= low - slack) & (part <= high + slack))]
            if beyond.size:
                raise ReadingError(
                    _(
                        "{type} {perception_key!r}: expected numbers from {low:g} to {high:g} "
                        "(range_min and range_max), got {beyond:g} from its {type2} "
                        "{perception_key2!r}; widen the range, or set normalized=True on that "
                        "sensor",
                        type=type(self).__name__,
                        perception_key=self.perception_key,
                        low=low,
                        high=high,
                        beyond=float(beyond[0]),
                        type2=type(child).__name__,
                        perception_key2=child.perception_key,
                    )
                )
        np.clip(out, low, high, out=out)

    def _name_of(self, child: Sensor) -> str:
        return f"{self.perception_key}/{child.perception_key}"
