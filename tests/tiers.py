"""The tests of a tier (``--fast``, default, ``--nightly``), and the order in which they run."""

import functools
import random
import re
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
ROOT = TESTS.parent
NOT_FAST = frozenset({"alone", "browser", "needs", "nightly", "slow"})
"""Markers of tests that `--fast` leaves out."""
NIGHTLY = frozenset({"nightly"})
"""Markers of tests that the default tier leaves out."""
MARKS_OF_FILE = re.compile(r"^pytestmark = (\[[^\]]*\]|.*)$", re.MULTILINE)
LONG_FOLDERS = ("browser", "attacks", "training", "remote", "lessons", "load")
"""Their files take longest and are started first, so that no core is idle at the end."""
BROWSERS_END_AT = 0.8
"""Part of the test files after which none with a browser begins, since they take long."""
LEFT_OUT = pytest.StashKey[int]()
"""Number of tests that were imported and are of another tier."""


class Tier:
    """Plugin that leaves out tests of other tiers, by their markers, and orders the rest.

    It is registered as an object: hooks of a conftest see only the files of their folder.
    """

    def __init__(self, config: pytest.Config) -> None:
        self.left_out_markers = (
            NOT_FAST if config.option.fast else frozenset() if config.option.nightly else NIGHTLY
        )
        config.stash[LEFT_OUT] = 0

    def pytest_ignore_collect(self, collection_path: Path) -> bool | None:
        """Import no file of which no test runs: its tests are of another tier, or it has none.

        A file is read for that and not imported, since it may need packages that are not there.
        Files that are named on the command line are always imported. The marks of a folder's
        conftest are those of all its files.
        """
        if collection_path.is_dir():
            return True if marks_of_folder(collection_path) & self.left_out_markers else None
        if collection_path.suffix != ".py" or collection_path.name == "conftest.py":
            return None
        text = collection_path.read_text(encoding="utf-8")
        if ">>>" not in text and not collection_path.name.startswith("test_"):
            return True
        return True if marks_of_file(text) & self.left_out_markers else None

    def pytest_itemcollected(self, item: pytest.Item) -> None:
        """Give a test the marks of its folder's conftest."""
        for name in marks_of_folder(item.path.parent):
            item.add_marker(name)

    def pytest_collection_modifyitems(
        self, config: pytest.Config, items: list[pytest.Item]
    ) -> None:
        """Leave out the tests of other tiers, unless they are named on the command line."""
        is_chosen_by_hand = any("::" in argument for argument in config.args)
        left_out = [
            item
            for item in items
            if not is_chosen_by_hand
            and self.left_out_markers.intersection(mark.name for mark in item.iter_markers())
        ]
        if left_out:
            config.stash[LEFT_OUT] = len(left_out)
            config.hook.pytest_deselected(items=left_out)
        kept = set(items).difference(left_out)
        items[:] = in_turn([item for item in items if item in kept], config.option.seed)


def marks_of_file(text: str) -> set[str]:
    """Return the names of the marks of all tests of a file.

    >>> sorted(marks_of_file("pytestmark = [pytest.mark.slow, pytest.mark.needs('train')]"))
    ['needs', 'slow']
    """
    marks = MARKS_OF_FILE.search(text)
    return set(re.findall(r"mark\.(\w+)", marks[1])) if marks else set()


@functools.cache
def marks_of_folder(folder: Path) -> frozenset[str]:
    """Return the names of the marks in a folder's conftest."""
    conftest = folder / "conftest.py"
    return frozenset(
        marks_of_file(conftest.read_text(encoding="utf-8")) if conftest.exists() else ()
    )


def in_turn(items: list[pytest.Item], seed: int | None) -> list[pytest.Item]:
    """Return the tests in the order to run them, those of a file together.

    Args:
        seed: draws the order of files and of tests within them; None for the usual order.
    """
    turns = _turns(items)
    if seed is not None:
        draw = random.Random(seed)
        files = sorted(turns)
        turns = dict(zip(files, draw.sample(range(len(files)), len(files)), strict=True))
        draw.shuffle(items)
    return sorted(items, key=lambda item: turns[item.path])


def _turns(items: list[pytest.Item]) -> dict[Path, float]:
    """Return the place of each file: long ones first, those with a browser evenly among the others.

    Drawing takes more than one core, so that two browsers at once would wait for each other, while
    other tests wait for a world's time and leave a core idle.
    """
    files = sorted({item.path for item in items}, key=_turn)
    with_browser = {item.path for item in items if item.get_closest_marker("browser")}
    others = [file for file in files if file not in with_browser]
    count = sum(file.is_relative_to(TESTS) for file in others)
    distance = BROWSERS_END_AT * count / max(len(with_browser), 1)
    browsers = [file for file in files if file in with_browser]
    places = {file: float(place) for place, file in enumerate(others)}
    return places | {file: distance * place for place, file in enumerate(browsers)}


def _turn(path: Path) -> tuple[int, Path]:
    folder = _folder(path)
    place = LONG_FOLDERS.index(folder) if folder in LONG_FOLDERS else len(LONG_FOLDERS)
    return place if path.is_relative_to(TESTS) else len(LONG_FOLDERS) + 1, path


def _folder(path: Path) -> str:
    """Return the package of ai4u_edu that a file belongs to or tests; empty if there is none."""
    parts = path.relative_to(ROOT).parts if ROOT in path.parents else ()
    return parts[1] if len(parts) > 1 else ""
