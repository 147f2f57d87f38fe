"""Unsaved scenes that an earlier server left."""

import json
import math
import re
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.base.file_lock import FileLock, is_locked
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, ngettext
from ai4u_edu.scenes import Scene

ENDING = ".unsaved"
LOCK_ENDING = ".lock"
OWNED = re.compile(r"(?P<name>.*)-(?P<instance>[0-9a-f]{12})-[0-9]+")
"""A file's name, without its ending: the scene, the server that wrote it, and a number."""
LOCK_NAME = re.compile(r"[0-9a-f]{12}" + re.escape(LOCK_ENDING))
MAX_LEFT = 20
"""Files that are kept; the latest of each scene is always kept."""
MAX_AGE_S = 30 * 24 * 3600.0
MAX_UNSAVED_BYTES = 32 * 2**20
MAX_TOLD = 5
"""Unsaved scenes that a message lists."""


@dataclass(frozen=True)
class Unsaved:
    """A scene that somebody changed and did not save."""

    file: Path
    text: str
    folder: Path | None
    saved_at: float
    """Seconds since 1970, to be shown to people."""
    name: str = ""
    """Name of the scene."""
    order: tuple[int, int] = (0, 0)
    """Number of the server's start, and of its write; clocks may be set between two of them."""

    @property
    def when(self) -> str:
        """The local time of day, with the date if it was not today."""
        then = datetime.fromtimestamp(self.saved_at)
        today = then.date() == datetime.now().date()
        return then.strftime("%H:%M" if today else "%Y-%m-%d %H:%M")

    def scene(self) -> Scene:
        """Return the scene.

        Raises:
            SceneError: it can't be read.
        """
        return Scene.loads(self.text, name="the unsaved scene", folder=self.folder)

    def discard(self) -> None:
        """Delete its file, unless a running server has claimed it."""
        with suppress(OSError):
            self.file.unlink(missing_ok=True)


def unsaved_scenes(folder: Path, *, of_running: bool = False) -> list[Unsaved]:
    """Return the unsaved scenes of servers that no longer run, the latest first.

    Args:
        folder: of the files.
        of_running: True for those of servers that run, too.
    """
    found = []
    with suppress(OSError):
        for file in folder.glob(f"*{ENDING}"):
            with suppress(OSError, ValueError, TypeError, KeyError, OverflowError, RecursionError):
                if of_running or not _is_owner_running(file):
                    found.append(_load(file))
    return sorted(found, key=lambda each: (each.order, each.saved_at), reverse=True)


def latest(folder: Path) -> Unsaved | None:
    """Return the latest unsaved scene; None if there is none that can be read."""
    return next(iter(unsaved_scenes(folder)), None)


def choose_unsaved(left: Sequence[Unsaved], wanted: str = "") -> Unsaved:
    """Return one of several unsaved scenes.

    Args:
        left: all of them, the latest first.
        wanted: a scene's name, for its latest one; or a number from 1, the latest; by default 1.

    Raises:
        SetupError: there is none, or none of that scene.
    """
    if not left:
        raise SetupError(_("there is no unsaved scene; expected: ai4u-edu play SCENE"))
    if wanted.isascii() and wanted.isdecimal() and 1 <= int(wanted[:6]) <= len(left):
        return left[int(wanted) - 1]
    for each in left:
        if not wanted or each.name in _names(wanted):
            return each
    raise SetupError(
        _(
            "there is no unsaved scene {name!r}; there are {scenes}; "
            "expected: ai4u-edu play SCENE --restore, or its number",
            name=wanted,
            scenes=format_unsaved(left),
        )
    )


def format_unsaved(left: Sequence[Unsaved]) -> str:
    """Return a numbered text of unsaved scenes' names and times."""
    told = [f"{n} {each.name} ({each.when})" for n, each in enumerate(left[:MAX_TOLD], start=1)]
    more = len(left) - MAX_TOLD
    return join([*told, ngettext("{n} more", "{n} more", more)] if more > 0 else told, ", ")


def prune(folder: Path) -> None:
    """Delete old and surplus files, and the locks of servers that no longer run."""
    seen: set[str] = set()
    for number, each in enumerate(unsaved_scenes(folder)):
        is_old = number >= MAX_LEFT or time.time() - each.saved_at > MAX_AGE_S
        if is_old and each.name in seen:
            with suppress(OSError):
                each.file.unlink(missing_ok=True)
        seen.add(each.name)
    for file in folder.glob(f"*{LOCK_ENDING}"):
        if LOCK_NAME.fullmatch(file.name):
            with suppress(OSError):
                FileLock(file).release(remove=True)


def _names(wanted: str) -> set[str]:
    """Return the names that a scene can have which is given as a name or a file."""
    names = {wanted, Path(wanted).stem}
    with suppress(AI4UError, OSError):
        names.add(Scene.load(wanted).description.name)
    return names


def _is_owner_running(file: Path) -> bool:
    owned = OWNED.fullmatch(file.name.removesuffix(ENDING))
    return owned is not None and is_locked(file.with_name(owned["instance"] + LOCK_ENDING))


def _load(file: Path) -> Unsaved:
    if file.stat().st_size > MAX_UNSAVED_BYTES:
        raise ValueError(file.name)
    data = json.loads(file.read_text(encoding="utf-8"))
    place = Path(data["folder"]) if data["folder"] else None
    saved_at = float(data["saved_at"])
    if not math.isfinite(saved_at):
        raise ValueError(saved_at)
    datetime.fromtimestamp(saved_at)
    # an earlier version named its files by the scene alone, and wrote no name into them
    owned = OWNED.fullmatch(file.name.removesuffix(ENDING))
    stem = owned["name"] if owned else file.name.removesuffix(ENDING)
    start, write = data.get("order", (0, 0))
    name = str(data.get("scene") or stem)
    return Unsaved(file, str(data["text"]), place, saved_at, name, (int(start), int(write)))
