"""Conditions for And and Or: whether a property has a value."""

from ai4u_edu.base.errors import BlockError
from ai4u_edu.base.parameters import Number, WholeNumber
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.properties import find_property
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class EvalValue(RewardFunc):
    """A condition; it pays nothing on its own, but AndRewardFunc and OrRewardFunc ask it."""

    abstract = True

    property: str
    """Of the agent's body or the target's, when the decision is over: x, y, z (m), heading_deg,
    speed (m/s), vz (m/s), turning_speed (rad/s), on_ground or fallen. Of the agent: steps, its
    decisions in this episode before this one; or the perception key of one of its sensors (key[2]
    for the third number of a longer reading), as it was sensed when the decision was taken."""
    target: str = ""
    """A body's name; left out: the agent itself."""
    reward: Number = 1.0
    """What And and Or pay for it where they have ``update_children``."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the property."""
        self._look = find_property(self.property, self.target, agent, view)

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Nothing."""
        return 0.0

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Whether the property is as it should be."""
        return self.fits(self._look(body, view))

    def fits(self, number: float) -> bool:
        """Whether a number is as it should be."""
        raise NotImplementedError  # each condition has its own


class EvalBoolValue(EvalValue):
    """Condition: a property is true (or, with ``value=False``, is not); a number is true above 0.

    So a TouchSensor's key will do: +1 is true, -1 is false. Like any condition it pays nothing on
    its own: give it to AndRewardFunc or OrRewardFunc. Example: not on the ground =
    ``EvalBoolValue(property="on_ground", value=False)``.

    Source: AI4U's EvalBoolValue, which looks any property up that a Godot node has.
    """

    value: bool = True
    """True asks that the property is true, False that it is not."""

    def fits(self, number: float) -> bool:
        """Whether it is true as it should be, or false."""
        return (number > 0) == self.value


class EvalIntValue(EvalValue):
    """Condition: a property is a whole number from ``min_value`` to ``max_value``, ends included.

    Like any condition it pays nothing on its own: give it to AndRewardFunc or OrRewardFunc.
    Example: the first ten decisions = ``EvalIntValue(property="steps", min_value=0, max_value=9)``.

    Source: AI4U's EvalIntValue.
    """

    min_value: WholeNumber
    """Smallest whole number that fits."""
    max_value: WholeNumber
    """Largest whole number that fits; not below min_value."""

    def __post_init__(self) -> None:
        super().__post_init__()
        _check_order(self, self.min_value, self.max_value)

    def fits(self, number: float) -> bool:
        """Whether it is whole and within."""
        return number == int(number) and self.min_value <= number <= self.max_value


class EvalFloatValue(EvalValue):
    """Condition: a property is a number from ``min_value`` to ``max_value``, ends included.

    Like any condition it pays nothing on its own: give it to AndRewardFunc or OrRewardFunc.
    Example: out of energy = ``EvalFloatValue(property="homeostatic", min_value=0, max_value=0.01)``
    with a HomeostaticSensor of one variable.

    Source: AI4U's EvalFloatValue.
    """

    min_value: Number
    """Smallest number that fits, in the property's unit."""
    max_value: Number
    """Largest number that fits, in the property's unit; not below min_value."""

    def __post_init__(self) -> None:
        super().__post_init__()
        _check_order(self, self.min_value, self.max_value)

    def fits(self, number: float) -> bool:
        """Whether it is within."""
        return self.min_value <= number <= self.max_value


def _check_order(block: EvalValue, low: float, high: float) -> None:
    if low > high:
        raise BlockError(
            f"{type(block).__name__} {block.name!r}: expected min_value <= max_value, "
            f"got {low:g}..{high:g}"
        )
