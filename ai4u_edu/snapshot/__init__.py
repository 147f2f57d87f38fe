"""Immutable snapshots of a world, for the page, the API and the recorder."""

from ai4u_edu.blocks import Stages
from ai4u_edu.snapshot.capture import (
    capture_agent,
    capture_bodies,
    capture_snapshot,
    capture_static_scene,
    has_fallen,
)
from ai4u_edu.snapshot.types import (
    AgentState,
    BodyState,
    Need,
    SlowTick,
    Snapshot,
    StaticScene,
)

__all__ = [
    "AgentState",
    "BodyState",
    "Need",
    "SlowTick",
    "Snapshot",
    "Stages",
    "StaticScene",
    "capture_agent",
    "capture_bodies",
    "capture_snapshot",
    "capture_static_scene",
    "has_fallen",
]
