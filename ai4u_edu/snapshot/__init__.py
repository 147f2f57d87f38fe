"""Immutable snapshots of a world, for the page, the API and the recorder."""

from ai4u_edu.snapshot.capture import agent_state, body_states, picture_of, set_stage
from ai4u_edu.snapshot.types import AgentState, BodyState, Need, SlowTick, Snapshot, Stage

__all__ = [
    "AgentState",
    "BodyState",
    "Need",
    "SlowTick",
    "Snapshot",
    "Stage",
    "agent_state",
    "body_states",
    "picture_of",
    "set_stage",
]
