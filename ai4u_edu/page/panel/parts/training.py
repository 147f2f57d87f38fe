"""The part "training": decisions so far and the learning curve, in the world of a training."""

from typing import Literal

from ai4u_edu.locale import gettext as _
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.runtime.training_progress import TrainingProgress


class TrainingPart(PanelPart, frozen=True, kw_only=True):
    """The progress of a training, and its learning curve."""

    name: Literal["training"] = "training"
    text: str
    """The progress as a sentence."""
    is_over: bool
    """True once the finished policy drives."""
    share: float
    """Decisions learned from so far, as a share of all; 0 to 1."""
    points: list[tuple[int, float, float | None]]
    """The learning curve: decisions, mean reward, and share of successes (0 to 1) or null."""


def training_part(progress: TrainingProgress) -> TrainingPart:
    """Return the progress of a training."""
    return TrainingPart(
        text=_text(progress),
        is_over=progress.is_over,
        share=min(progress.decisions / progress.total, 1.0) if progress.total else 1.0,
        points=[(each.decisions, each.reward, each.success) for each in progress.curve],
    )


def _text(progress: TrainingProgress) -> str:
    decisions = progress.decisions
    if progress.is_over:
        return _(
            "Training is over after {decisions:,} decisions. The best policy drives now.",
            decisions=decisions,
        )
    return _(
        "Learned from {decisions:,} of {total:,} decisions so far.",
        decisions=decisions,
        total=progress.total,
    )
