"""A sensor of numbers that a script sets."""

from collections.abc import Mapping, Sequence
from typing import Annotated, ClassVar

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.errors import BlockError, ReadingError
from ai4u_edu.base.parameters import Number
from ai4u_edu.blocks.agent_view import AgentInput, AgentView
from ai4u_edu.blocks.sensors.sensor import Array, Sensor
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView


class AgentArraySensor(Sensor):
    """A row of numbers that a script sets, so that it can send information to the agent.

    A value stays until the script sets another one; a reset sets all to 0. A value that is set in
    a handler of ``begin_of_update_state`` is in the percept that follows. Recorded episodes have
    the values, so that a replay senses them too.

    Reading: (size,), each within range_min..range_max (0 is always allowed). Source: AI4U's
    AgentArraySensor.

    >>> message = AgentArraySensor(size=3)
    >>> message.set_value(1, 0.5)
    >>> message.numbers.tolist()
    [0.0, 0.5, 0.0]
    """

    perception_key: str = "__initial_input__"
    size: Annotated[int, Field(ge=1, le=1024)] = 1
    """Count of numbers."""
    range_min: Number = 0.0
    """Smallest number that a script may set."""
    range_max: Number = 1.0
    """Largest number that a script may set; above range_min."""

    carried: ClassVar[tuple[str, ...]] = ("numbers", "_moment")

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.range_max <= self.range_min:
            raise BlockError(
                _(
                    "{title}: expected range_max above range_min, got {range_min:g}..{range_max:g}",
                    title=self._title(),
                    range_min=self.range_min,
                    range_max=self.range_max,
                )
            )
        self.numbers = np.zeros(self.size)
        """The current values."""
        self.script: Mapping[int, Sequence[Sequence[float]]] = {}
        """Values that a replay sets, by the count of readings and resets in the episode before."""
        self._moment = 0
        self._agent: AgentView | None = None

    def space(self) -> Box:
        """Return the range, extended to include 0."""
        low, high = min(self.range_min, 0.0), max(self.range_max, 0.0)
        return Box(low, high, (self.size,))

    def set_value(self, index: int, value: float) -> None:
        """Set one number.

        Raises:
            ReadingError: the index or the number is out of range.
        """
        if not 0 <= index < self.size:
            raise ReadingError(
                _(
                    "{title}: expected an index from 0 to {size}, got {index}",
                    title=self._title(),
                    size=self.size - 1,
                    index=index,
                )
            )
        self._check(value)
        self.numbers[index] = value
        self._note()

    def set_values(self, values: Sequence[float]) -> None:
        """Set all numbers.

        Raises:
            ReadingError: their count is not ``size``, or one is out of range.
        """
        if len(values) != self.size:
            raise ReadingError(
                _(
                    "{title}: expected {size} values, got {count}",
                    title=self._title(),
                    size=self.size,
                    count=len(values),
                )
            )
        for value in values:
            self._check(value)
        self.numbers[:] = values
        self._note()

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Store the agent, which is told of each value that is set."""
        self._agent, self._view = agent, view

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Set all numbers to 0."""
        self.numbers[:] = 0.0

    def restart(self) -> None:
        """Begin an episode; with the world's reset, readings are counted from 0."""
        super().restart()
        if not self._view.ticks:
            self._moment = 0
        elif self.resetable:  # what was set before is gone
            self._moment += 1
        else:
            self._count_moment()

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Write the reading into ``out``."""
        self._count_moment()
        out[...] = self.numbers

    def _note(self) -> None:
        if self._agent is not None:
            values = tuple(map(float, self.numbers))
            self._agent.note_input(AgentInput(self.perception_key, self._moment, values))

    def _count_moment(self) -> None:
        for values in self.script.get(self._moment, ()):
            self.numbers[:] = values
        self._moment += 1

    def _check(self, value: float) -> None:
        # written this way round, nan is refused as well
        if not self.range_min <= value <= self.range_max:
            raise ReadingError(
                _(
                    "{title}: expected values from {range_min:g} to {range_max:g}, got {value}",
                    title=self._title(),
                    range_min=self.range_min,
                    range_max=self.range_max,
                    value=repr(value),
                )
            )

    def _title(self) -> str:
        return f"{type(self).__name__} {self.perception_key!r}"
