"""What an agent has to keep in balance."""

import math

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.block import Block
from ai4u_edu.errors import BlockError
from ai4u_edu.parameters import Name, Number
from ai4u_edu.world import BodyView, WorldView

MOVING = 0.05
"""A body that is faster than this (m/s) moves."""


class HomeostaticVariable(Block):
    """One thing inside the agent that has a good range: energy, warmth, water.

    Picture a bar from ``range_min`` to ``range_max`` with a green zone in it, from ``comfort_min``
    to ``comfort_max``, and a mark, the ``level``, that drifts: by ``drift_per_second`` at rest, and
    faster where effort costs more. A HomeostaticReward keeps such variables and lets them drift; a
    CollectActuator feeds them, or a script does with :meth:`add_value`.

    Source: AI4U's HomeostaticVariable; the drift is ours, after the energy of its Platform demo.

    >>> energy = HomeostaticVariable(
    ...     name="energy", range_max=100, comfort_min=40, comfort_max=80, value=50
    ... )
    >>> energy.add_value(70)
    >>> energy.level, energy.check(), energy.discomfort(), energy.normalised()
    (100.0, False, 20.0, 1.0)
    """

    name: Name
    range_min: Number = 0.0
    range_max: Number = 1.0
    comfort_min: Number = 0.0
    comfort_max: Number = 1.0
    value: Number = 1.0
    """The level that an episode begins with."""
    drift_per_second: Number = 0.0
    """How much the level changes by itself; hunger has a negative one."""
    moving_drift_per_second: Number | None = None
    """The same while the body moves over the ground; left out: as at rest."""
    airborne_drift_per_second: Number | None = None
    """The same while the body is in the air; left out: as while it moves."""

    def __post_init__(self) -> None:
        ends = self.range_min, self.comfort_min, self.comfort_max, self.range_max
        if self.range_min >= self.range_max or sorted(ends) != list(ends):
            raise BlockError(
                f"{self._title()}: expected range_min <= comfort_min <= comfort_max <= range_max "
                f"and a range that is not empty, got {' .. '.join(f'{end:g}' for end in ends)}"
            )
        if not self.range_min <= self.value <= self.range_max:
            raise BlockError(
                f"{self._title()}: expected a value within its range "
                f"{self.range_min:g}..{self.range_max:g}, got {self.value:g}"
            )
        self.level = self.value
        """The level now."""

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Begins again with ``value``."""
        self.level = self.value

    def add_value(self, amount: float) -> None:
        """Adds to the level, which stays within the range."""
        self.level = max(self.range_min, min(self.range_max, self.level + amount))

    def drift(self, body: BodyView, seconds: float) -> None:
        """Lets some time pass, in which a body rests, moves or is in the air as it is now."""
        amount = self.drift_per_second
        moving, airborne = self.moving_drift_per_second, self.airborne_drift_per_second
        in_the_air = not body.on_ground
        if moving is not None and (in_the_air or math.hypot(*body.velocity) > MOVING):
            amount = moving
        if airborne is not None and in_the_air:
            amount = airborne
        self.add_value(amount * seconds)

    def check(self) -> bool:
        """Whether the level is in the comfort zone; its ends belong to it."""
        return self.comfort_min <= self.level <= self.comfort_max

    def centroid(self) -> float:
        """The middle of the comfort zone."""
        return (self.comfort_min + self.comfort_max) / 2

    def distance_to_centroid(self) -> float:
        """How far the level is from the middle of the comfort zone."""
        return abs(self.level - self.centroid())

    def discomfort(self) -> float:
        """How far the level is outside of the comfort zone; 0 inside."""
        return max(self.comfort_min - self.level, self.level - self.comfort_max, 0.0)

    def normalised(self) -> float:
        """The level as a share of the range: 0 at its bottom, 1 at its top."""
        return (self.level - self.range_min) / (self.range_max - self.range_min)

    def _title(self) -> str:
        return f"{type(self).__name__} {self.name!r}"
