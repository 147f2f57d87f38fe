"""Options that several commands share."""

import math
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from ai4u_edu.base.seeding import MAX_SEED, MAX_TRAINING_SEED

MAX_EPISODES = 1_000_000
"""Episodes of one evaluation."""
MAX_TRAINING_STEPS = 10**9
"""Decisions of one training."""
MAX_UPDATES = 10_000_000
"""Gradient steps of one network."""
MIN_TIME_SCALE, MAX_TIME_SCALE = 0.01, 100.0
"""Limits of the time scale, as in a scene file; 1 is real time."""

OnMissing = Literal["hold", "coast", "stop"]
"""Policies for an agent whose script's action is missing."""

OwnBlocks = Annotated[
    list[Path] | None,
    typer.Option(
        "--blocks",
        help="Python file with your own blocks; it is run. Repeat the option for several files.",
        show_default=False,
    ),
]


def finite(value: float | None) -> float | None:
    """Refuse NaN, which is neither below a minimum nor above a maximum, and infinity."""
    if value is not None and not math.isfinite(value):
        raise typer.BadParameter(f"expected a finite number, got {value}")
    return value


def seed_option(help_text: str) -> Any:
    """Return an option for the seed of an episode or a network."""
    return typer.Option(help=help_text, min=0, max=MAX_SEED)


def training_seed_option(help_text: str) -> Any:
    """Return an option for the seed of a training."""
    return typer.Option(help=help_text, min=0, max=MAX_TRAINING_SEED)


def load_own_blocks(files: Iterable[Path] | None) -> None:
    """Run the Python files that were named with ``--blocks``.

    Raises:
        SetupError: one can't be run, or defines no block.
    """
    from ai4u_edu.blocks.loading import load_blocks  # costs half a second

    for file in files or ():
        load_blocks(file)
