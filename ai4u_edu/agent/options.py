"""Blocks that an agent's options add, as in AI4U's RLAgent."""

from typing import TYPE_CHECKING

from ai4u_edu.blocks import (
    Actuator,
    AgentArraySensor,
    ContinuousActuator,
    DiscreteActuator,
    Sensor,
    TruncatedSensor,
)

if TYPE_CHECKING:
    from ai4u_edu.agent.agent import BasicAgent

DEFAULT_ACTION = "defaultAction"
"""AI4U's name for the action that goes to ``agent.action_handler``."""
STANDING_STILL = [(0.0, 0.0, 0.0, 0.0)]


def add_optional_blocks(agent: "BasicAgent") -> None:
    """Add the sensors and the actuator that an agent's options ask for.

    An option adds nothing if the agent has a block of that name.
    """
    keys = {sensor.perception_key for sensor in agent.sensors}
    agent.sensors += [each for each in _sensors(agent) if each.perception_key not in keys]
    names = {actuator.action_name for actuator in agent.actuators}
    agent.actuators += [each for each in _actuators(agent) if each.action_name not in names]


def set_action_handler(agent: "BasicAgent") -> None:
    """Pass the agent's action handler to the actuator that calls it, if that exists already."""
    for actuator in agent.actuators:
        if actuator.action_name == DEFAULT_ACTION and hasattr(actuator, "handler"):
            actuator.handler = agent.action_handler


def _sensors(agent: "BasicAgent") -> list[Sensor]:
    found: list[Sensor] = []
    if agent.array_input_size:
        found.append(
            AgentArraySensor(
                size=agent.array_input_size, range_min=agent.range_min, range_max=agent.range_max
            )
        )
    if agent.check_episode_truncated:
        found.append(TruncatedSensor())
    return found


def _actuators(agent: "BasicAgent") -> list[Actuator]:
    size = agent.action_size or int(agent.action_handler is not None)
    if not size:
        return []
    made: ContinuousActuator | DiscreteActuator
    if agent.action_is_continuous:
        made = ContinuousActuator(action_name=DEFAULT_ACTION, size=size)
        made.handler = agent.action_handler
    else:
        # the default table of a DiscreteActuator would drive the body while there is no handler
        made = DiscreteActuator(action_name=DEFAULT_ACTION, size=size, table=STANDING_STILL)
        made.handler = agent.action_handler
    return [made]
