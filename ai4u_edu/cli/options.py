"""Options that several commands share."""

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.seeding import MAX_SEED, MAX_TRAINING_SEED
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

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


def say(text: str, *, err: bool = False) -> None:
    """Print a text in the language of the terminal, on stdout or stderr."""
    typer.echo(translate(text), err=err)


def let_it_drive(scene: str, network: Path) -> None:
    """Print the command with which a network drives in a scene."""
    command = f"ai4u-edu play {scene} --brain {network}"
    say(_("let it drive:  {command}", command=command))


def finite(value: float | None) -> float | None:
    """Refuse NaN, which is neither below a minimum nor above a maximum, and infinity."""
    if value is not None and not math.isfinite(value):
        raise typer.BadParameter(_("expected a finite number, got {value}", value=value))
    return value


SCENE_AND_MORE = {"allow_extra_args": True}
"""Settings of a command that explains further words itself; see :func:`expect_scene`."""


def expect_scene(command: str, words: Sequence[str]) -> None:
    """Refuse a driver beside a scene or in its place; all commands take it as an option.

    Raises:
        BadParameter: there are several words, or one that names a driver.
    """
    drivers = [word for word in words if is_driver(word)]
    if len(words) <= 1 and not drivers:
        return
    scene = next((word for word in words if word not in drivers), "SCENE")
    right = " ".join([scene, *(f"--brain {word}" for word in drivers or ["DRIVER"])])
    raise typer.BadParameter(
        _(
            "expected one scene, got {words}; the driver is an option: ai4u-edu {command} {right}",
            words=" ".join(words),
            command=command,
            right=right,
        )
    )


def is_driver(word: str) -> bool:
    """Return True for a word that names a driver by its form.

    >>> [is_driver(word) for word in ("zoo:maze", "mine.py:drive", "maze", "maze.yaml")]
    [True, True, False, False]
    """
    return (
        word in ("zoo", "random", "scene")
        or word.startswith(("zoo:", "ai4u://"))
        or word.endswith(".onnx")
        or ".py:" in word
    )


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


def check_blocks(scene: Mapping[str, Any], files: Iterable[Path] | None) -> None:
    """Check that the Python files that a kept scene runs were named with ``--blocks``.

    The folder that it comes from may be somebody else's.

    Args:
        scene: see :func:`ai4u_edu.scenes.scene_data.scene_data`.
        files: those that were named.

    Raises:
        SetupError: one was not.
    """
    given = {str(each.absolute()) for each in files or ()}
    unnamed = [str(each) for each in scene.get("blocks", ()) if str(each) not in given]
    if unnamed:
        raise SetupError(
            _(
                "its scene runs the Python file {file}; read it, then say --blocks {file}",
                file=unnamed[0],
            )
        )
