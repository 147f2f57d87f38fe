"""Conditions on the value of a property, for AndRewardFunc and OrRewardFunc."""

import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np

from ai4u_edu.base.errors import BlockError, ReadingError, suggest
from ai4u_edu.base.parameters import Number, WholeNumber
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView

Look = Callable[[BodyView, WorldView], float]

BODY_PROPERTIES: dict[str, Callable[[BodyView], float]] = {
    "x": lambda body: body.position[0],
    "y": lambda body: body.position[1],
    "z": lambda body: body.z,
    "heading_deg": lambda body: math.degrees(body.heading),
    "speed": lambda body: math.hypot(*body.velocity),
    "vz": lambda body: body.vz,
    "turning_speed": lambda body: body.angular_velocity,
    "on_ground": lambda body: body.on_ground,
    "fallen": lambda body: body.fallen,
}
"""Properties of a body by name; in metres, seconds, radians unless the name says otherwise."""

AGENT_PROPERTIES: dict[str, Callable[[AgentView], float]] = {
    "steps": lambda agent: agent.steps,
    "episode_reward": lambda agent: agent.episode_reward,
}
"""Properties of the agent by name: its decisions before this one, and what it was paid so far."""


class EvalValue(RewardFunc):
    """A condition for AndRewardFunc and OrRewardFunc; it pays nothing on its own."""

    abstract = True

    property: str
    """Property of a body at the end of the decision: x, y, z (m), heading_deg, speed (m/s), vz
    (m/s), turning_speed (rad/s), on_ground or fallen. Or of the agent: steps, its decisions in this
    episode before this one; episode_reward (AI4U's EpisodeReward), all that it was paid in this
    episode, in this decision only by the rewards listed before; or the perception key of one of its
    sensors (key[2] for the third number of a longer reading), as it was when the decision was
    taken."""
    target: str = ""
    """Name of a body; left out: the agent's."""
    reward: Number = 1.0
    """Amount that And and Or pay for it if they have ``update_children``."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the property."""
        self._look = _find_property(self.property, self.target, agent, view)

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
            _(
                "{type} {name!r}: expected min_value <= max_value, got {low:g}..{high:g}",
                type=type(block).__name__,
                name=block.name,
                low=low,
                high=high,
            )
        )


def _find_property(name: str, target: str, agent: AgentView, view: WorldView) -> Look:
    """Return a function that reads a property.

    Args:
        name: a key of :data:`BODY_PROPERTIES` or :data:`AGENT_PROPERTIES`; or the perception key
            of one of the agent's sensors, ``key[2]`` for its third number.
        target: name of the body; empty for the agent's own.
        agent: the agent.
        view: the world.

    Raises:
        BlockError: there is no such property.
    """
    if target:
        _place = view[target]
    if name in BODY_PROPERTIES:
        look = BODY_PROPERTIES[name]
        return lambda body, view: look(view[target] if target else body)
    if target:
        raise BlockError(
            _(
                "property: a body has no {name!r}; {hint}",
                name=name,
                hint=suggest(name, BODY_PROPERTIES),
            )
        )
    if name in AGENT_PROPERTIES:
        look_at = AGENT_PROPERTIES[name]
        return lambda *_seen: look_at(agent)
    keys = [sensor.perception_key for sensor in agent.sensors if sensor.is_active]
    match = re.fullmatch(r"(.+)\[(\d+)\]", name)
    key, index = (match[1], int(match[2])) if match else (name, None)
    if key not in keys:
        raise BlockError(
            _(
                "property: no body, agent or sensor has a {key!r}; {hint}",
                key=key,
                hint=suggest(key, [*BODY_PROPERTIES, *AGENT_PROPERTIES, *keys]),
            )
        )
    return lambda *_seen: _number(agent.percept[key], key, index)


def _number(reading: Any, key: str, index: int | None) -> float:
    if isinstance(reading, str | tuple):
        raise ReadingError(
            _("property: expected a reading made of numbers, {key!r} is text", key=key)
        )
    numbers = np.ravel(reading)
    if index is None:
        if numbers.size != 1:
            raise ReadingError(
                _(
                    "property: expected one number, {key!r} has {size}; choose one, as in "
                    "'{key}[0]'",
                    key=key,
                    size=numbers.size,
                )
            )
        index = 0
    if index >= numbers.size:
        raise ReadingError(
            _(
                "property: expected an index up to {size}, got '{key}[{index}]'",
                size=numbers.size - 1,
                key=key,
                index=index,
            )
        )
    return float(numbers[index])
