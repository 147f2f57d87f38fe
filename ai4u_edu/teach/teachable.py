"""Reasons why an agent can't be taught, and the changes that help."""

from gymnasium import spaces

from ai4u_edu.agent import BasicAgent

NO_SENSOR = "It senses nothing that a network could learn from. Add a sensor in Build."
NO_ACTUATOR = "It has no actuator that a network could use. Add one in Build."
SEVERAL = (
    "It acts by {names}, and a network learns one actuator here. Switch the others off in Build."
)
NO_RANGE = "The numbers of its actuator {name} have no range, so there is nothing to aim at."
NO_NUMBERS = (
    "Its sensor {name} reads text, and a network learns from numbers here. Switch it off in Build."
)


def reason_against_teaching(agent: BasicAgent) -> str:
    """Return why no network can learn to drive an agent, as sentences; empty if one can.

    Args:
        agent: in a world.
    """
    blocks = agent.bound_blocks
    sensors = [sensor for sensor in blocks.sensors if sensor.is_input]
    outputs = {name: each.space() for name, each in blocks.actuators.items() if each.is_output}
    if not sensors:
        return NO_SENSOR
    for sensor in sensors:
        if not isinstance(sensor.observation_space(), spaces.Box | spaces.Discrete):
            return NO_NUMBERS.format(name=sensor.perception_key)
    if not outputs:
        return NO_ACTUATOR
    if len(outputs) > 1:
        *first, last = sorted(outputs)
        return SEVERAL.format(names=f"{', '.join(first)} and {last}")
    ((name, space),) = outputs.items()
    if isinstance(space, spaces.Discrete) or (isinstance(space, spaces.Box) and space.is_bounded()):
        return ""
    return NO_RANGE.format(name=name)
