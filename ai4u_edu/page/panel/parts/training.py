"""The part "training": decisions so far and the learning curve, in the world of a training."""

from typing import Any

from ai4u_edu.runtime.training_progress import TrainingProgress


def training_part(progress: TrainingProgress) -> dict[str, Any]:
    """Return the progress of a training in words, and its learning curve.

    Each point of the curve is [decisions, mean reward, share of successes or null].
    """
    return {
        "type": "part",
        "name": "training",
        "text": _text(progress),
        "is_over": progress.is_over,
        "share": min(progress.decisions / progress.total, 1.0) if progress.total else 1.0,
        "points": [[each.decisions, each.reward, each.success] for each in progress.curve],
    }


def _text(progress: TrainingProgress) -> str:
    decisions = f"{progress.decisions:,}"
    if progress.is_over:
        return f"Training is over after {decisions} decisions. The best policy drives now."
    return f"Learned from {decisions} of {progress.total:,} decisions so far."
