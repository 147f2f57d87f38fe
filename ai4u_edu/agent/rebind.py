"""Replacing the blocks of an agent during an episode: body, world and step count stay."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ai4u_edu.agent.agent import BasicAgent
from ai4u_edu.agent.bound_blocks import BoundBlocks
from ai4u_edu.blocks import Actuator, Brain, RemoteBrain, RewardFunc, Sensor
from ai4u_edu.blocks.sensors.sensor_state import SensorState, read_again
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import World

BLOCKS_CHANGED_REASON = _(
    "the agent's blocks were changed; connect again to be told what it senses now"
)
"""Reason given to a connected script whose agent was changed."""


@dataclass(frozen=True)
class Blocks:
    """All blocks of an agent."""

    sensors: Sequence[Sensor]
    actuators: Sequence[Actuator]
    rewards: Sequence[RewardFunc]
    brains: Sequence[Brain]

    @classmethod
    def of(cls, agent: BasicAgent) -> "Blocks":
        """Return the blocks that an agent has now."""
        return cls(
            tuple(agent.sensors), tuple(agent.actuators), tuple(agent.rewards), tuple(agent.brains)
        )

    def assign_to(self, agent: BasicAgent) -> None:
        """Set them as an agent's blocks; they still have to be bound."""
        agent.sensors, agent.actuators = list(self.sensors), list(self.actuators)
        agent.rewards, agent.brains = list(self.rewards), list(self.brains)


def rebind(agent: BasicAgent, world: World, blocks: Blocks, *, keep_brain: bool = False) -> None:
    """Replace the blocks of an agent during an episode; blocks that it keeps keep their state.

    New blocks are reset, new sensors read immediately, and the brain's next percept has all
    readings.

    Args:
        agent: the agent to change.
        world: the world of its body.
        blocks: all blocks that it is to have.
        keep_brain: True if the brain, when it is the same one, need not be set up again.

    Raises:
        SetupError: something does not fit; then the agent is as before.
        ReadingError: a new sensor's reading is outside its space; then the agent is as before.
    """
    had, before = Blocks.of(agent), agent.bound_blocks
    states = {id(each): SensorState.capture(each) for each in before.number_sensors}

    def bind(these: Blocks, known: Blocks, *, keep_brain: bool) -> None:
        these.assign_to(agent)
        bound = agent.bind_blocks(world, ready_brain=before.brain if keep_brain else None)
        _reset_new_blocks(agent, bound, known, states, read_new=these is blocks)

    try:
        bind(blocks, had, keep_brain=keep_brain)
    except BaseException:
        for brain in (*had.brains, *blocks.brains):
            brain.enabled = brain is before.brain
        try:
            bind(had, had, keep_brain=True)
        except BaseException:  # a block that can be set up only once
            agent.restore_blocks(before)
            for sensor in before.number_sensors:
                states[id(sensor)].restore(sensor)
        raise
    gone = before.brain
    if agent.brain is gone:
        return
    if isinstance(gone, RemoteBrain):
        gone.close(BLOCKS_CHANGED_REASON)
    else:
        gone.close()


def sense_again(agent: BasicAgent) -> None:
    """Read all sensors of an agent again, after the world was changed by hand."""
    bound = agent.bound_blocks
    for sensor in bound.number_sensors:
        _read_or_blank(lambda each: read_again(each, bound.body, bound.view), sensor)
    agent.replace_percept(bound.percept())


def _reset_new_blocks(
    agent: BasicAgent,
    bound: BoundBlocks,
    known: Blocks,
    states: dict[int, SensorState],
    *,
    read_new: bool,
) -> None:
    """Reset new blocks, and put the state of known sensors back."""
    old = {id(each) for each in (*known.actuators, *known.rewards, *known.brains)}
    for block in (*bound.rewards, *bound.actuators.values(), bound.brain):
        if id(block) not in old:
            block.on_reset(agent, bound.view)
    for sensor in bound.sensors:
        state = states.get(id(sensor))
        if state is not None and state.restore(sensor):
            continue
        if sensor.resetable:
            sensor.on_reset(agent, bound.view)
        if read_new and sensor in bound.number_sensors:
            _read_or_blank(lambda each: each.take(bound.body, bound.view), sensor)
    agent.replace_percept(bound.percept())


def _read_or_blank(read: Callable[[Sensor], None], sensor: Sensor) -> None:
    if sensor.is_active:
        read(sensor)
    else:
        sensor.blank()
