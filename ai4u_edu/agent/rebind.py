"""Other blocks on an agent in the middle of an episode: same body, same world, same steps."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ai4u_edu.agent.agent import BasicAgent
from ai4u_edu.agent.bound_blocks import BoundBlocks
from ai4u_edu.blocks import Actuator, Brain, RemoteBrain, RewardFunc, Sensor
from ai4u_edu.blocks.sensors.sensor_state import SensorState, read_again
from ai4u_edu.world import World

FAREWELL = "the agent's blocks were changed; connect again to be told what it senses now"
"""What a script hears that knew the agent as it was."""


@dataclass(frozen=True)
class Blocks:
    """All blocks of an agent."""

    sensors: Sequence[Sensor]
    actuators: Sequence[Actuator]
    rewards: Sequence[RewardFunc]
    brains: Sequence[Brain]

    @classmethod
    def of(cls, agent: BasicAgent) -> "Blocks":
        """Those that an agent has now."""
        return cls(
            tuple(agent.sensors), tuple(agent.actuators), tuple(agent.rewards), tuple(agent.brains)
        )

    def put_on(self, agent: BasicAgent) -> None:
        """Gives them to an agent; they sit on it once it is fitted."""
        agent.sensors, agent.actuators = list(self.sensors), list(self.actuators)
        agent.rewards, agent.brains = list(self.rewards), list(self.brains)


def rebind(agent: BasicAgent, world: World, blocks: Blocks, *, brain_goes_on: bool = False) -> None:
    """Puts blocks on an agent that is under way; those that it had already go on as they were.

    What is new is reset, and reads at once; the brain decides next on a percept with all of it.

    Args:
        agent: whose.
        world: where its body is.
        blocks: all that it is to have.
        brain_goes_on: whether the brain stays without being set up again, if it is the same one.

    Raises:
        SetupError: something does not fit; then the agent is as it was.
        ReadingError: a new sensor reads what it has not declared; the same then.
    """
    had, before = Blocks.of(agent), agent.bound_blocks
    memories = {id(each): SensorState.capture(each) for each in before.number_sensors}

    def fit(these: Blocks, known: Blocks, *, goes_on: bool) -> None:
        these.put_on(agent)
        bound = BoundBlocks(agent, world, goes_on=before.brain if goes_on else None)
        _begin(agent, bound, known, memories, looks=these is blocks)

    try:
        fit(blocks, had, goes_on=brain_goes_on)
    except BaseException:
        for brain in (*had.brains, *blocks.brains):
            brain.enabled = brain is before.brain
        try:
            fit(had, had, goes_on=True)
        except BaseException:  # somebody's block that fits once only
            before.restore()
            for sensor in before.number_sensors:
                memories[id(sensor)].restore(sensor)
        raise
    gone = before.brain
    if agent.brain is gone:
        return
    if isinstance(gone, RemoteBrain):
        gone.close(FAREWELL)
    else:
        gone.close()


def sense_again(agent: BasicAgent) -> None:
    """Has an agent sense the same moment once more: somebody moved the world by hand."""
    bound = agent.bound_blocks
    for sensor in bound.number_sensors:
        _blank_or(lambda each: read_again(each, bound.body, bound.view), sensor)
    agent.replace_percept(bound.percept())


def _begin(
    agent: BasicAgent,
    bound: BoundBlocks,
    known: Blocks,
    memories: dict[int, SensorState],
    *,
    looks: bool,
) -> None:
    """Resets what is new, and hands what is not its memory."""
    old = {id(each) for each in (*known.actuators, *known.rewards, *known.brains)}
    for block in (*bound.rewards, *bound.actuators.values(), bound.brain):
        if id(block) not in old:
            block.on_reset(agent, bound.view)
    for sensor in bound.sensors:
        memory = memories.get(id(sensor))
        if memory is not None and memory.restore(sensor):
            continue
        if sensor.resetable:
            sensor.on_reset(agent, bound.view)
        if looks and sensor in bound.number_sensors:
            _blank_or(lambda each: each.take(bound.body, bound.view), sensor)
    agent.replace_percept(bound.percept())


def _blank_or(read: Callable[[Sensor], None], sensor: Sensor) -> None:
    if sensor.is_active:
        read(sensor)
    else:
        sensor.blank()
