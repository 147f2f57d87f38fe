"""The status of a remote brain: counts and the last problem, for the page."""

from dataclasses import dataclass
from typing import Literal

from ai4u_edu.blocks.brains.links.link import Link, LinkState
from ai4u_edu.locale import gettext as _

OVERRIDDEN = _("a person drives; its actions are ignored")
WARNING_INTERVAL_S = 5.0
"""Shortest time for which a warning stands before another sentence replaces it: a script repeats
its mistakes with each decision, with other numbers in the sentence."""
WARNING_LIFETIME_S = 10.0
"""Time without a mistake after which the next action that is carried out clears the warning."""


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
    warnings: int = 0
    """Replies that had no effect, or of which a part had none; it only grows."""
    warning: str = ""
    """A sentence that names what was wrong in one of them, and how to mend it. It changes every 5 s
    at most. It is empty for a new session, and some time after the last mistake."""


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
    warnings: int = 0
    warning: str = ""
    _is_connected: bool = False
    _warned_at: float = 0.0
    """Time at which the sentence was set."""
    _mistaken_at: float = 0.0
    """Time of the last mistake."""

    def follow(self, state: LinkState) -> None:
        """Note the state of the connection; a new session begins without a warning."""
        is_connected = state is LinkState.CONNECTED
        if is_connected and not self._is_connected:
            self.warning = ""
        self._is_connected = is_connected

    def warn(self, sentence: str, now: float) -> None:
        """Count a reply of which something had no effect.

        Args:
            sentence: names what was wrong.
            now: seconds of the brain's clock.
        """
        self.warnings += 1
        self._mistaken_at = now
        if not self.warning or now - self._warned_at >= WARNING_INTERVAL_S:
            self.warning, self._warned_at = sentence, now

    def accept(self, clipped: int, now: float) -> None:
        """Count an action that was carried out.

        Args:
            clipped: numbers of it that were clipped.
            now: seconds of the brain's clock.
        """
        self.decisions += 1
        self.clipped += clipped
        self.reason = ""
        if self.warning and now - self._mistaken_at >= WARNING_LIFETIME_S:
            self.warning = ""

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
            warnings=self.warnings,
            warning=self.warning,
        )
