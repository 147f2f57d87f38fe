"""Base class of actuators: name, space, and the check of an action's numbers."""

import math
from collections.abc import Callable, Sequence
from typing import Any, ClassVar

import numpy as np
from gymnasium import spaces

from ai4u_edu.base.errors import ActionError, BlockError, shown
from ai4u_edu.blocks.block import Block, default_name
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import Body, WorldView


class Actuator(Block):
    """The base of all actuators: implement :meth:`space` and :meth:`act`.

    >>> from gymnasium.spaces import Box
    >>> class Thruster(Actuator):
    ...     '''Pushes forward with some force.'''
    ...     newtons: float = 10.0
    ...     def space(self): return Box(0.0, 1.0, (1,))
    ...     def act(self, body, action): body.apply_force(action[0] * self.newtons, 0.0)
    >>> from ai4u_edu import BasicAgent, CircleShape, ControlRequestor, LocalBrain, World
    >>> world = World()
    >>> robot = world.add_body("robot", CircleShape(radius=0.5))
    >>> agent = BasicAgent(
    ...     body="robot",
    ...     actuators=[Thruster(newtons=20)],
    ...     brains=[LocalBrain(controller=lambda percept: {"thruster": [1.0]})],
    ... )
    >>> sim = ControlRequestor(world, [agent])
    >>> sim.reset()
    >>> percept = sim.step()
    >>> robot.velocity[0] > 0
    True
    """

    action_name: str = ""
    """The action's name; by default made from the class's name."""
    is_active: bool = True
    """False switches the actuator off: its actions have no effect."""
    is_output: bool = True
    """True requires an action for it from a policy."""

    is_continuous: ClassVar[bool] = True

    carried: ClassVar[tuple[str, ...]] = ("clipped",)

    def __post_init__(self) -> None:
        self.action_name = self.action_name or default_name(type(self), "Actuator")

    def space(self) -> spaces.Space[Any]:
        """Return the space of its actions: a Box of shape (n,) or a Discrete space."""
        raise BlockError(
            _(
                "{type} has no space(self): it must say what action it takes, as a Box",
                type=type(self).__name__,
            )
        )

    def slots(self) -> tuple[str, ...]:
        """Return display names of the numbers of an action; empty if they have none."""
        return ()

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Apply an action to the body, for one tick.

        Args:
            body: the agent's body.
            action: n finite numbers within :meth:`space`.
        """
        raise BlockError(_("{type} has no act(self, body, action)", type=type(self).__name__))

    def on_tick(self, body: Body, view: WorldView) -> None:
        """Run after every tick of a decision, whether it acted or not.

        It is called only where a subclass implements it.

        Args:
            body: the agent's body.
            view: read access to the world.
        """

    def limits(self) -> tuple[list[float], list[float]]:
        """Return the lowest and the highest value of each number of an action."""
        space = self.space()
        if isinstance(space, spaces.Box):
            return space.low.ravel().tolist(), space.high.ravel().tolist()
        if isinstance(space, spaces.Discrete):
            start = float(space.start)
            return [start], [start + float(space.n) - 1.0]
        raise BlockError(
            _(
                "{self}: expected space() to be a Box or Discrete, got {space}",
                self=repr(self),
                space=str(space),
            )
        )

    def fixed_at_setup(self) -> dict[str, object]:
        """Return the name by which an action finds it."""
        return {"action_name": self.action_name}

    def prepare(self) -> None:
        """Compute the limits once, at setup."""
        low, high = self.limits()
        self._limits = list(zip(low, high, strict=True))
        self._within_all = max(low, default=0.0), min(high, default=0.0)
        self.clipped = 0
        """Count of numbers that were outside their range and were clipped."""
        self.on_clip: Callable[[tuple[float, ...], tuple[float, ...]], None] | None = None
        """Called with the numbers of an action as given and as clipped, where they differ."""

    def accept(self, values: Any) -> tuple[float, ...]:
        """Check the numbers of an action; clip and count those out of range.

        Raises:
            ActionError: not n finite numbers.
        """
        # a flat float array is the most frequent form
        plain = type(values) is np.ndarray and values.dtype.kind == "f" and values.ndim == 1
        numbers = tuple(values.tolist()) if plain else self._numbers(values)
        if len(numbers) != len(self._limits):
            raise ActionError(
                _(
                    "action {action_name!r}: expected {count} numbers, got {count2}: {got}",
                    action_name=self.action_name,
                    count=len(self._limits),
                    count2=len(numbers),
                    got=shown(values),
                )
            )
        # a sum costs less than a test of each, but that of large numbers may be infinite
        if not math.isfinite(sum(numbers)) and not all(map(math.isfinite, numbers)):
            raise ActionError(
                _(
                    "action {action_name!r}: expected finite numbers, got {got}",
                    action_name=self.action_name,
                    got=shown(values),
                )
            )
        low, high = self._within_all
        if numbers and low <= min(numbers) and max(numbers) <= high:
            return numbers
        cut = tuple(
            low if number < low else high if number > high else number
            for number, (low, high) in zip(numbers, self._limits, strict=True)
        )
        if cut != numbers:
            self.clipped += sum(a != b for a, b in zip(cut, numbers, strict=True))
            if self.on_clip is not None:
                self.on_clip(numbers, cut)
        return cut

    def _numbers(self, values: Any) -> tuple[float, ...]:
        try:
            if type(values) in (tuple, list):
                return tuple(map(float, values))
            if isinstance(values, np.ndarray | np.generic):
                values = values.tolist()
            if isinstance(values, int | float):
                return (float(values),)
            if isinstance(values, Sequence) and not isinstance(values, str | bytes):
                return tuple(map(float, values))
        except (TypeError, ValueError, OverflowError):
            pass
        raise ActionError(
            _(
                "action {action_name!r}: expected {count} numbers, got {got}",
                action_name=self.action_name,
                count=len(self._limits),
                got=shown(values),
            )
        )
