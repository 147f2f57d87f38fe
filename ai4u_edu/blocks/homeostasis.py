"""Internal variables that an agent has to keep in a comfort zone."""

import math
from typing import ClassVar

from ai4u_edu.base.errors import BlockError, ReadingError
from ai4u_edu.base.parameters import Name, Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.block import Block
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView

MOVING_SPEED_M_S = 0.05
"""Speed (m/s) above which a body counts as moving."""


class HomeostaticVariable(Block):
    """An internal variable of the agent with a comfort zone: energy, warmth, water.

    Imagine a bar from ``range_min`` to ``range_max`` with a green zone from ``comfort_min`` to
    ``comfort_max``, and a mark, the ``level``. It drifts by ``drift_per_second`` at rest, and by
    other amounts in motion or in the air. A HomeostaticReward has such variables and lets them
    drift; a CollectActuator changes them, or a script with :meth:`add_value`.

    Source: AI4U's HomeostaticVariable; the drift is ours, after the energy of its Platform demo.

    Differs from AI4U: minValue and maxValue are ``comfort_min`` and ``comfort_max``. Value is
    ``level``; the parameter ``value`` is the level at the beginning of an episode.

    >>> energy = HomeostaticVariable(
    ...     name="energy", range_max=100, comfort_min=40, comfort_max=80, value=50
    ... )
    >>> energy.add_value(70)
    >>> energy.level, energy.check(), energy.discomfort(), energy.normalised()
    (100.0, False, 20.0, 1.0)
    """

    name: Name
    """Name of the variable; unique in its agent."""
    range_min: Number = 0.0
    """Lowest level, in the variable's own unit."""
    range_max: Number = 1.0
    """Highest level, in the variable's own unit; above range_min."""
    comfort_min: Number = 0.0
    """Lower end of the comfort zone; within the range."""
    comfort_max: Number = 1.0
    """Upper end of the comfort zone; within the range, not below comfort_min."""
    value: Number = 1.0
    """Level at the beginning of an episode; within the range."""
    drift_per_second: Number = 0.0
    """Change of the level per second at rest; negative for hunger."""
    moving_drift_per_second: Number | None = None
    """Change per second while the body moves on the ground; left out: as at rest."""
    airborne_drift_per_second: Number | None = None
    """Change per second while the body is in the air; left out: as while it moves."""

    carried: ClassVar[tuple[str, ...]] = ("level", "comfort_min", "comfort_max")

    def __post_init__(self) -> None:
        ends = self.range_min, self.comfort_min, self.comfort_max, self.range_max
        if self.range_min >= self.range_max or sorted(ends) != list(ends):
            raise BlockError(
                _(
                    "{title}: expected range_min <= comfort_min <= comfort_max <= range_max and a "
                    "range that is not empty, got {names}",
                    title=self._title(),
                    names=" .. ".join(f"{end:g}" for end in ends),
                )
            )
        if not self.range_min <= self.value <= self.range_max:
            raise BlockError(
                _(
                    "{title}: expected a value within its range {range_min:g}..{range_max:g}, got "
                    "{value:g}",
                    title=self._title(),
                    range_min=self.range_min,
                    range_max=self.range_max,
                    value=self.value,
                )
            )
        self.level = self.value
        """The present level."""

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Set the level to ``value``."""
        self.level = self.value

    def add_value(self, amount: float) -> None:
        """Add to the level, clamped to the range.

        Raises:
            ReadingError: the amount is not a number (NaN).
        """
        if amount != amount:  # max and min would turn NaN into a full level
            raise ReadingError(
                _(
                    "{title}: expected an amount, got {amount}",
                    title=self._title(),
                    amount=repr(amount),
                )
            )
        self.level = max(self.range_min, min(self.range_max, self.level + amount))

    def drift(self, body: BodyView, seconds: float) -> None:
        """Change the level by the drift of some seconds in the body's present state of motion."""
        amount = self.drift_per_second
        moving, airborne = self.moving_drift_per_second, self.airborne_drift_per_second
        in_the_air = not body.on_ground
        if moving is not None and (in_the_air or math.hypot(*body.velocity) > MOVING_SPEED_M_S):
            amount = moving
        if airborne is not None and in_the_air:
            amount = airborne
        self.add_value(amount * seconds)

    def check(self) -> bool:
        """Return True if the level is in the comfort zone, ends included."""
        return self.check_value(self.level)

    def check_value(self, value: float) -> bool:
        """Return True if a value is in the comfort zone, ends included."""
        return self.comfort_min <= value <= self.comfort_max

    def centroid(self) -> float:
        """Return the middle of the comfort zone."""
        return (self.comfort_min + self.comfort_max) / 2

    def set_centroid(self, value: float) -> None:
        """Move the middle of the comfort zone and keep its width.

        It stays there until it is moved again; a reset does not undo it.

        Raises:
            BlockError: the zone would leave the range.
        """
        half = (self.comfort_max - self.comfort_min) / 2
        low, high = self.range_min + half, self.range_max - half
        if not low <= value <= high:
            raise BlockError(
                _(
                    "{title}: expected a centroid from {low:g} to {high:g}, so that the comfort "
                    "zone stays within the range, got {value}",
                    title=self._title(),
                    low=low,
                    high=high,
                    value=repr(value),
                )
            )
        self.comfort_min = max(self.range_min, value - half)
        self.comfort_max = min(self.range_max, value + half)

    def position_to_centroid(self) -> float:
        """Return the level minus the middle of the comfort zone."""
        return self.level - self.centroid()

    def position_to_min(self) -> float:
        """Return the level minus the lower end of the comfort zone."""
        return self.level - self.comfort_min

    def position_to_max(self) -> float:
        """Return the level minus the upper end of the comfort zone."""
        return self.level - self.comfort_max

    def distance_to_centroid(self) -> float:
        """Return the distance of the level from the middle of the comfort zone."""
        return abs(self.position_to_centroid())

    def distance_to_min(self) -> float:
        """Return the distance of the level from the lower end of the comfort zone."""
        return abs(self.position_to_min())

    def distance_to_max(self) -> float:
        """Return the distance of the level from the upper end of the comfort zone."""
        return abs(self.position_to_max())

    def discomfort(self) -> float:
        """Return the distance of the level from the comfort zone; 0 inside."""
        return max(self.comfort_min - self.level, self.level - self.comfort_max, 0.0)

    def normalised(self) -> float:
        """Return the level as a share of the range: 0 at its bottom, 1 at its top."""
        return self._share(self.level)

    def normalised_comfort(self) -> tuple[float, float]:
        """Return both ends of the comfort zone as shares of the range."""
        return self._share(self.comfort_min), self._share(self.comfort_max)

    def _share(self, level: float) -> float:
        return (level - self.range_min) / (self.range_max - self.range_min)

    def _title(self) -> str:
        return f"{type(self).__name__} {self.name!r}"
