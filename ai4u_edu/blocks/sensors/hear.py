"""A sensor of what others say."""

from typing import Annotated, ClassVar

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.blocks.actuators.speak import MAX_NUMBERS, numbers_named
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Array, Sensor
from ai4u_edu.world import BodyView, WorldView


class HearSensor(Sensor):
    """Messages of the nearest speakers since the last reading: [heard, ...] of each of them.

    ``heard`` is 1 if somebody spoke, and 0 for silence; then all its numbers are 0. The nearest of
    those that spoke comes first. A message with fewer numbers than ``size`` is filled with 0; of a
    longer one, the first are heard. A robot does not hear itself.

    What another robot says in a decision is in this robot's percept after it, whichever of the two
    decides first.

    Reading: (voices * (1 + size),), each -1..1. Source: ours.
    """

    voices: Annotated[int, Field(ge=1, le=16)] = 1
    """Number of speakers that it hears at once, the nearest ones."""
    size: Annotated[int, Field(ge=0, le=MAX_NUMBERS)] = 1
    """Count of numbers of each message."""

    carried: ClassVar[tuple[str, ...]] = ("_since",)

    def __post_init__(self) -> None:
        super().__post_init__()
        self._since = 0

    def space(self) -> Box:
        """Return the range of each number."""
        low = np.full((self.voices, 1 + self.size), -1.0, np.float32)
        low[:, 0] = 0.0
        return Box(low.ravel(), np.ones(low.size, np.float32))

    def slots(self) -> tuple[str, ...]:
        """Return the names of the numbers."""
        names = ("heard", *numbers_named(self.size))
        if self.voices == 1:
            return names
        return tuple(f"{name} ({voice + 1})" for voice in range(self.voices) for name in names)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Hear nothing of what was said before."""
        self._since = view.ticks

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Write the reading into ``out``."""
        out[...] = 0
        voices = out.reshape(self.voices, 1 + self.size)
        for voice, (_, message) in zip(
            voices, view.messages.heard(body, self._since), strict=False
        ):
            numbers = message.numbers[: self.size]
            voice[0] = 1
            voice[1 : 1 + len(numbers)] = numbers
        self._since = view.ticks
