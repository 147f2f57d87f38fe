"""Properties that a reward function reads by name: of a body, of the agent, or a reading."""

import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np

from ai4u_edu.base.errors import BlockError, ReadingError, suggest
from ai4u_edu.blocks.agent_view import AgentView
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

STEPS_PROPERTY = "steps"
"""The only property of an agent: the number of decisions before this one."""


def find_property(name: str, target: str, agent: AgentView, view: WorldView) -> Look:
    """Return a function that reads a property.

    Args:
        name: a key of :data:`BODY_PROPERTIES`; ``steps``; or the perception key of one of the
            agent's sensors, ``key[2]`` for its third number.
        target: name of the body; empty for the agent's own.
        agent: the agent.
        view: the world.

    Raises:
        BlockError: there is no such property.
    """
    if target:
        _ = view[target]
    if name in BODY_PROPERTIES:
        look = BODY_PROPERTIES[name]
        return lambda body, view: look(view[target] if target else body)
    if target:
        raise BlockError(f"property: a body has no {name!r}; {suggest(name, BODY_PROPERTIES)}")
    if name == STEPS_PROPERTY:
        return lambda *_: agent.steps
    keys = [sensor.perception_key for sensor in agent.sensors if sensor.is_active]
    match = re.fullmatch(r"(.+)\[(\d+)\]", name)
    key, index = (match[1], int(match[2])) if match else (name, None)
    if key not in keys:
        raise BlockError(
            f"property: no body, agent or sensor has a {key!r}; "
            f"{suggest(key, [*BODY_PROPERTIES, STEPS_PROPERTY, *keys])}"
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
