"""A block and what its check needs."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ai4u_edu import Actuator, Block


@dataclass(frozen=True)
class Sample:
    """A block and what its check needs."""

    block: Block
    scene: str | None = None
    """Name of the library's scene to check it in; None for the checks' own small world."""
    actuators: Sequence[Actuator] = ()
    """Actuators that the agent needs besides."""
    script: Any = None
    """Called before each decision with the agent and the decision's number."""
    always_same: str = ""
    """Reason for a reading, reward or answer that never changes in the check; empty if it does."""
