"""Choosing drives to learn from without code: conditions to tick, and drives to tick."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import NeuralNetController, trained_brain
from ai4u_edu.lessons.exercises.lesson_11 import scripted_drives, straight_on
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

if TYPE_CHECKING:
    from ai4u_edu.learn.training.demonstrations import Cloned
    from ai4u_edu.recording import Episode

LIMIT = 300
"""Decisions of an episode at the most."""
CHOICE = 6
"""Number of drives to choose from."""
FALL_INDEX = 1
"""Place of the drive that falls among those of the scripted player."""


@cache
def _scripted() -> "tuple[Episode, ...]":
    """Return drives of the scripted player, and one that falls."""
    from ai4u_edu.learn.training import demonstrate

    found = scripted_drives(CHOICE - 1)
    found[FALL_INDEX:FALL_INDEX] = demonstrate(
        straight_on, "box_chase", episodes=1, seed=1, quiet=True
    )
    return tuple(found)


def last_drives(folder: str | Path = "drives") -> "list[Episode]":
    """Return your last drives in the box chase, whether or not they reached the box.

    Args:
        folder: the folder of ``show(..., record=folder)``.
    """
    from ai4u_edu.recording import Episode

    files = sorted(Path(folder).glob("*.episode"), key=lambda file: file.stat().st_mtime)
    yours = [each for each in map(Episode.load, files) if each.scene.name == "box_chase"]
    yours = yours[-CHOICE:]
    return [*yours, *_scripted()[: CHOICE - len(yours)]]


def conditions(
    reached: float | None = None,
    min_seconds: float | None = None,
    max_seconds: float | None = None,
) -> Callable[[list[Any]], list[Any]]:
    """Return a function that chooses the drives that meet all conditions.

    Args:
        reached: 1 for drives that reached the box, 0 for the others.
        min_seconds: shortest drive, seconds.
        max_seconds: longest drive, seconds.
    """

    def is_chosen(episode: Any) -> bool:
        return (
            (reached is None or bool(episode.success) is (reached >= 0.5))
            and (min_seconds is None or episode.seconds >= min_seconds)
            and (max_seconds is None or episode.seconds <= max_seconds)
        )

    return lambda episodes: [each for each in episodes if is_chosen(each)]


def show_choice(good: Callable[[list[Any]], list[Any]]) -> None:
    """Print which of the last drives are chosen."""
    drives = last_drives()
    chosen = {id(each) for each in good(drives)}
    for number, each in enumerate(drives, 1):
        mark = translate(_("chosen") if id(each) in chosen else _("left out"))
        text = _(
            "drive {number}: {seconds:.1f} s, did not reach it", number=number, seconds=each.seconds
        )
        if each.success:
            text = _(
                "drive {number}: {seconds:.1f} s, reached the box",
                number=number,
                seconds=each.seconds,
            )
        print(f"{mark:8}  {translate(text)}")  # noqa: T201 - a notebook's


def clone_of(**times: float) -> "Cloned":
    """Train a clone, in ``clone.onnx``, on some of the last drives.

    Args:
        times: how often a drive is shown, by its name: ``drive_1`` to ``drive_6``.

    Raises:
        SetupError: no drive is chosen.
    """
    from ai4u_edu.learn.training import clone

    if not times:
        raise SetupError(_("no drive is chosen; tick at least one"))
    chosen = tuple((int(name.rpartition("_")[2]), round(count)) for name, count in times.items())
    drives = last_drives()
    if _trained.get("choice") != (chosen, drives):
        shown = [drives[number - 1] for number, count in chosen for _ in range(count)]
        _trained.update(choice=(chosen, drives), clone=clone(shown, "clone.onnx", quiet=True))
    cloned: Cloned = _trained["clone"]
    return cloned


_trained: dict[str, Any] = {}
"""Last choice, and its clone: Try and Check don't train it twice."""


def show_clone(cloned: Any) -> None:
    """Show how a clone drives."""
    from ai4u_edu.lessons.filming import film

    film("box_chase", trained_brain(str(cloned.path)), seed=5, limit=100)


def worlds_reached(path: str | Path, worlds: int = 100) -> int:
    """Return in how many worlds a network reaches the box."""
    from ai4u_edu.blocks import LocalBrain
    from ai4u_edu.lessons.rollouts import drives

    controller = NeuralNetController(model_path=str(path), repeat=False)
    brain = LocalBrain(controller=controller, **controller.network.rhythm)
    return sum(each.won for each in drives("box_chase", brain, list(range(worlds)), limit=LIMIT))
