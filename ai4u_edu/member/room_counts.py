"""Counts of a room in its present scene, which outlast its process."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from ai4u_edu.base.atomic_write import write_atomically

NAME = "counts.json"
"""File of the counts, in the room's folder."""


@dataclass(frozen=True)
class RoomCounts:
    """Drives and falls in a scene, and whether its goal was reached."""

    scene: str = ""
    """Title of the scene."""
    episodes: int = 0
    falls: int = 0
    is_solved: bool = False


def read_counts(folder: Path) -> RoomCounts:
    """Return the counts of a room's folder; none if there is no file, or another one."""
    try:
        stored = json.loads((folder / NAME).read_text(encoding="utf-8"))
        return RoomCounts(
            str(stored["scene"]),
            max(0, int(stored["episodes"])),
            max(0, int(stored["falls"])),
            bool(stored["is_solved"]),
        )
    except (OSError, ValueError, TypeError, KeyError, OverflowError, RecursionError):
        return RoomCounts()


def write_counts(folder: Path, counts: RoomCounts) -> None:
    """Write counts into a room's folder.

    Raises:
        OSError: they can't be written.
    """
    write_atomically(folder / NAME, json.dumps(asdict(counts)))
