"""The status of a remote brain: counts and the last problem, for the page."""

from dataclasses import dataclass
from typing import Literal

from ai4u_edu.blocks.brains.links.link import Link, LinkState

OVERRIDDEN = "a person drives; its actions are ignored"


@dataclass(frozen=True, slots=True)
class RemoteStatus:
    """The state of a remote brain and its counts, for the page."""

    state: Literal["waiting", "connected", "late", "lost"]
    """``late``: the script is connected and its action is missing; the reason says whether the
    world still waits for it."""
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
    """Numbers of its actions that were out of range, and clipped."""


@dataclass(slots=True)
class StatusTracker:
    """The counts of a remote brain, and the last problem with its script."""

    is_late: bool = False
    reason: str = ""
    decisions: int = 0
    missing: int = 0
    dropped: int = 0
    """Answers that came too late, or while a person drove."""
    refused: int = 0
    clipped: int = 0

    def report(self, link: Link | None, *, is_overridden: bool) -> RemoteStatus:
        """Return the status for the page.

        Args:
            link: to the script; None while there is none.
            is_overridden: whether a person drives in the script's place.
        """
        state = LinkState.WAITING if link is None else link.state
        is_connected = state is LinkState.CONNECTED
        reason = OVERRIDDEN if is_overridden else self.reason
        return RemoteStatus(
            state="late" if is_connected and self.is_late else state.value,
            reason=(reason if is_connected else "") or (link.reason if link else ""),
            decisions=self.decisions,
            missing=self.missing,
            ignored=self.dropped + (link.ignored if link else 0),
            refused=self.refused,
            clipped=self.clipped,
        )
