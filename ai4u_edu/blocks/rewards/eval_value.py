"""Conditions on the value of a property, for AndRewardFunc and OrRewardFunc."""

from ai4u_edu.base.errors import BlockError
from ai4u_edu.base.parameters import Number, WholeNumber
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.properties import find_property
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class EvalValue(RewardFunc):
    """A condition for AndRewardFunc and OrRewardFunc; it pays nothing on its own."""

    abstract = True

    property: str
    """Property of a body at the end of the decision: x, y, z (m), heading_deg, speed (m/s), vz
    (m/s), turning_speed (rad/s), on_ground or fallen. Or of the agent: steps, its decisions in this
    episode before this one; or the perception key of one of its sensors (key[2] for the third
    number of a longer reading), as it was when the decision was taken."""
    target: str = ""
    """Name of a body; left out: the agent's."""
    reward: Number = 1.0
    """Amount that And and Or pay for it if they have ``update_children``."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the property."""
        self._look = find_property(self.property, self.target, agent, view)

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return 0."""
        return 0.0

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if the property has the wanted value."""
        return self.fits(self._look(body, view))

    def fits(self, number: float) -> bool:
        """Return True if a number is a wanted value."""
        raise NotImplementedError  # each condition has its own


class EvalBoolValue(EvalValue):
    """Condition: a property is true (with ``value=False``: is false); a number is true above 0.

    A TouchSensor's key works too: +1 is true, -1 is false. Like any condition it pays nothing on
    its own: put it into an AndRewardFunc or OrRewardFunc. Example: not on the ground =
    ``EvalBoolValue(property="on_ground", value=False)``.

    Source: AI4U's EvalBoolValue, which reads any property of a Godot node.
    """

    value: bool = True
    """The wanted value of the property."""

    def fits(self, number: float) -> bool:
        """Return True if the number stands for the wanted value."""
        return (number > 0) == self.value


class EvalIntValue(EvalValue):
    """Condition: a property is a whole number from ``min_value`` to ``max_value``, ends included.

    Like any condition it pays nothing on its own: put it into an AndRewardFunc or OrRewardFunc.
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
        """Return True if the number is whole and in the range."""
        return number == int(number) and self.min_value <= number <= self.max_value


class EvalFloatValue(EvalValue):
    """Condition: a property is a number from ``min_value`` to ``max_value``, ends included.

    Like any condition it pays nothing on its own: put it into an AndRewardFunc or OrRewardFunc.
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
        """Return True if the number is in the range."""
        return self.min_value <= number <= self.max_value


def _check_order(block: EvalValue, low: float, high: float) -> None:
    if low > high:
        raise BlockError(
            f"{type(block).__name__} {block.name!r}: expected min_value <= max_value, "
            f"got {low:g}..{high:g}"
        )
