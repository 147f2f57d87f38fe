"""The state of a remote brain, for the page."""

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True, slots=True)
class RemoteStatus:
    """The state of a remote brain and its counts, for the page."""

    state: Literal["waiting", "connected", "late", "lost"]
    """``late``: a script is there, and its action is not; the reason says if it was given up."""
    reason: str
    decisions: int
    """Actions of the script that were carried out."""
    missing: int
    """Decisions for which no action of the script was there in time."""
    ignored: int
    """Messages that were no answer."""
    refused: int
    """Actions that no actuator could carry out."""
    clipped: int
    """Numbers of its actions that were out of range, and cut."""
