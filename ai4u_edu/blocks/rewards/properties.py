"""What a reward function may look at by name: a property of a body, or a reading."""

import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np

from ai4u_edu.base.errors import BlockError, ReadingError, suggest
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.world import BodyView, WorldView

Look = Callable[[BodyView, WorldView], float]

OF_A_BODY: dict[str, Callable[[BodyView], float]] = {
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
"""The properties of a body by name; in metres, seconds, radians unless the name says otherwise."""

STEPS = "steps"
"""The one property of an agent: the decisions that it took before this one."""


def find_property(name: str, target: str, agent: AgentView, view: WorldView) -> Look:
    """How to look at a property.

    Args:
        name: out of :data:`OF_A_BODY`; ``steps``; or the perception key of one of the agent's
            sensors, ``key[2]`` for its third number.
        target: whose property it is, a body's name; empty for the agent's own.
        agent: whose reading it is.
        view: where the target is.

    Raises:
        BlockError: there is no such property.
    """
    if target:
        _ = view[target]
    if name in OF_A_BODY:
        look = OF_A_BODY[name]
        return lambda body, view: look(view[target] if target else body)
    if target:
        raise BlockError(f"property: a body has no {name!r}; {suggest(name, OF_A_BODY)}")
    if name == STEPS:
        return lambda *_: agent.steps
    keys = [sensor.perception_key for sensor in agent.sensors if sensor.is_active]
    match = re.fullmatch(r"(.+)\[(\d+)\]", name)
    key, index = (match[1], int(match[2])) if match else (name, None)
    if key not in keys:
        raise BlockError(
            f"property: no body, agent or sensor has a {key!r}; "
            f"{suggest(key, [*OF_A_BODY, STEPS, *keys])}"
        )
    return lambda *_: _number(agent.percept[key], key, index)


def _number(reading: Any, key: str, index: int | None) -> float:
    if isinstance(reading, str | tuple):
        raise ReadingError(f"property: expected a reading made of numbers, {key!r} is text")
    numbers = np.ravel(reading)
    if index is None:
        if numbers.size != 1:
            raise ReadingError(
                f"property: expected one number, {key!r} has {numbers.size}; "
                f"choose one, as in '{key}[0]'"
            )
        index = 0
    if index >= numbers.size:
        raise ReadingError(
            f"property: expected an index up to {numbers.size - 1}, got '{key}[{index}]'"
        )
    return float(numbers[index])
