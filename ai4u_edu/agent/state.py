"""The state of a world with its agents at one moment, so that a copy can go on from there."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from ai4u_edu.agent.bound_blocks import BoundBlocks
from ai4u_edu.world.state import WorldState

if TYPE_CHECKING:
    from ai4u_edu.agent.cycle import Phase

BlockStates = Mapping[str, Mapping[str, Any]]


class DecisionState(NamedTuple):
    """An agent's present decision."""

    under_way: bool
    phase: "Phase"
    action: tuple[tuple[str, tuple[float, ...]], ...]
    """Numbers by action name, in the order in which the actuators act."""


class AgentMoment(NamedTuple):
    """Everything that changes in an agent while its world runs."""

    values: Mapping[str, Any]
    """The agent's own attributes."""
    ledger: Mapping[str, Any]
    decision: DecisionState
    blocks: BlockStates
    """Results of :meth:`Block.get_state`, by the block's place in the agent."""


class SimState(NamedTuple):
    """Everything that changes in a world and its agents while it runs, but for held keys."""

    episode: int
    world: WorldState
    agents: Mapping[str, AgentMoment]
    """By id."""


def block_states(bound: BoundBlocks) -> dict[str, Mapping[str, Any]]:
    """Return the states of an agent's blocks, by their places in it."""
    return {place: block.get_state() for place, block in bound.places()}


def restore_blocks(bound: BoundBlocks, states: BlockStates) -> None:
    """Give an agent's blocks the states of those in the same places of another agent."""
    for place, block in bound.places():
        if place in states:
            block.set_state(states[place])
