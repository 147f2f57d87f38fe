"""The state of a running world and its agents: all that a copy at one moment needs."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from ai4u_edu.agent.episode_options import Options
from ai4u_edu.world.state import WorldState


class Phase(NamedTuple):
    """Progress of an agent's decision."""

    tick: int = 0
    """Ticks of the decision that have passed; 0 before the first decision."""
    ticks: int = 1
    """Ticks that the decision takes."""
    repeats: bool = True
    """True if the actuators act at every tick, False if only at the first."""


class DecisionState(NamedTuple):
    """An agent's present decision."""

    under_way: bool
    phase: Phase
    action: tuple[tuple[str, tuple[float, ...]], ...]
    """Numbers by action name, in the order in which the actuators act."""


class AgentMoment(NamedTuple):
    """Everything that changes in an agent while its world runs."""

    values: Mapping[str, Any]
    """The agent's own attributes."""
    ledger: Mapping[str, Any]
    decision: DecisionState
    blocks: Mapping[str, Mapping[str, Any]]
    """Results of :meth:`Block.get_state`, by the block's place in the agent."""


class SimState(NamedTuple):
    """Everything that changes in a world and its agents while it runs, but for held keys."""

    episode: int
    world: WorldState
    agents: Mapping[str, AgentMoment]
    """States of the agents, by id."""
    options: Options
    """Options of the episode's reset."""
