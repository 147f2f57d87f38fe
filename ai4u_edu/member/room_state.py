"""State of a room as its class shows it: who drives, how it goes, who is stuck."""

import json
import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import shorten
from ai4u_edu.member.episode_watch import driver_of
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.wire.class_link import State, Status
from ai4u_edu.wire.validation import MAX_TEXT_CHARS

IDLE_S = 60.0
"""Time without driving and editing after which a room is idle, even if its world waits."""
DRIVING_S = 10.0
"""Time after the last key or edit for which a room whose world runs is still driven."""
WRITE_INTERVAL_S = 1.0
"""Shortest time between two writes of the counts, except when the goal is reached."""
_COUNTS_FILE = "counts.json"
"""File of the counts, in the room's folder."""
WINS = ("goal", "won")
TEACHER = "teacher"
"""Value of :attr:`Snapshot.waiting` while a world is held."""


@dataclass(frozen=True)
class RoomCounts:
    """Drives and falls in a scene, and whether its goal was reached; a file keeps them."""

    scene: str = ""
    """Title of the scene."""
    episodes: int = 0
    falls: int = 0
    is_solved: bool = False


def read_counts(folder: Path) -> RoomCounts:
    """Return the counts of a room's folder; none if there is no file, or another one."""
    try:
        stored = json.loads((folder / _COUNTS_FILE).read_text(encoding="utf-8"))
        return RoomCounts(
            str(stored["scene"]),
            max(0, int(stored["episodes"])),
            max(0, int(stored["falls"])),
            bool(stored["is_solved"]),
        )
    except (OSError, ValueError, TypeError, KeyError, OverflowError, RecursionError):
        return RoomCounts()


class RoomState:
    """State of a room. One thread calls it.

    What it has counted in the present scene outlasts the process, if there is a folder.

    Args:
        clock: seconds.
        folder: of the room.
        scene: identifies the scene with which the process begins.
        title: of it.
    """

    def __init__(
        self,
        clock: Callable[[], float],
        folder: Path | None = None,
        scene: object = None,
        title: str = "",
    ) -> None:
        self._clock, self._folder, self._scene = clock, folder, scene
        self._active_at = clock() - DRIVING_S
        self._written_at = -math.inf
        self._seen: object = None
        stored = RoomCounts() if folder is None else read_counts(folder)
        self._stored = stored
        counts = stored if stored.scene == title else RoomCounts()
        self._begun_before = counts.episodes
        """Episodes of this scene in earlier processes."""
        self.falls, self.is_solved = counts.falls, counts.is_solved

    def note_scene(self, scene: object) -> None:
        """Begin to count again if another scene was opened.

        Args:
            scene: identifies the scene that was opened last.
        """
        if scene is not self._scene:
            self._scene = scene
            self._begun_before, self.falls, self.is_solved = 0, 0, False

    def note_end(self, word: str) -> None:
        """Count an episode that has ended."""
        self.falls += word == "fell"
        self.is_solved = self.is_solved or word in WINS

    def save(self, state: State, *, at_once: bool = False) -> None:
        """Write the counts now and then, and as soon as the goal is reached."""
        counts = RoomCounts(state.scene, state.episodes, state.falls, state.is_solved)
        if self._folder is None or counts == self._stored:
            return
        now, is_news = self._clock(), counts.is_solved != self._stored.is_solved
        if at_once or is_news or now - self._written_at >= WRITE_INTERVAL_S:
            self._written_at = now
            with suppress(OSError):  # a full disk, say: tried again later
                _write_counts(self._folder, counts)
                self._stored = counts

    def read(
        self, snapshot: Snapshot, sim: ControlRequestor, *, title: str, version: int, begun: int
    ) -> State:
        """Return the present state.

        Args:
            snapshot: the latest one.
            sim: the world that runs.
            title: of the scene.
            version: grows with every edit.
            begun: episodes of this scene that have begun.
        """
        driver = ""
        if sim.agents and snapshot.agents:
            driver = driver_of(sim.agents[0], snapshot.agents[0])
        self._note_activity(snapshot, (version, begun, driver))
        return State(
            status=self._status(snapshot),
            scene=shorten(title, MAX_TEXT_CHARS),
            driver=shorten(driver, MAX_TEXT_CHARS),
            seconds=round(snapshot.episode_time, 1),
            episodes=max(1, self._begun_before + begun),
            falls=self.falls,
            is_solved=self.is_solved,
            error=shorten(snapshot.error, MAX_TEXT_CHARS),
        )

    def _status(self, snapshot: Snapshot) -> Status:
        if snapshot.error:
            return "error"
        if snapshot.waiting == TEACHER:
            return "paused"
        inactive_s = self._clock() - self._active_at
        if inactive_s >= IDLE_S:
            return "idle"
        if snapshot.paused:
            return "paused"
        agent = snapshot.agents[0] if snapshot.agents else None
        success = snapshot.static_scene.success
        match agent.outcome(snapshot.agents, success) if agent else "":
            case "goal" | "won":
                return "solved"
            case "fell":
                return "fell"
            case "":
                is_driven = inactive_s < DRIVING_S
                return "waiting" if snapshot.waiting else "driving" if is_driven else "idle"
        return "over"

    def _note_activity(self, snapshot: Snapshot, changed: tuple[int, int, str]) -> None:
        seen = (*changed, tuple(sorted(key for each in snapshot.agents for key in each.held_keys)))
        # nobody did anything yet when the process starts
        is_active = seen != self._seen is not None or snapshot.waiting == TEACHER
        self._seen = seen
        if is_active or _is_driven(snapshot):
            self._active_at = self._clock()


def _is_driven(snapshot: Snapshot) -> bool:
    """Return True if somebody drives now: a person who holds a key or a stick, or a program."""
    if snapshot.paused or snapshot.waiting or snapshot.error:
        return False
    for agent in snapshot.agents:
        if agent.terminated or agent.truncated:
            continue
        is_moving = any(number for numbers in agent.action.values() for number in numbers)
        if agent.held_keys or is_moving:
            return True
    return False


def _write_counts(folder: Path, counts: RoomCounts) -> None:
    """Write counts into a room's folder.

    Raises:
        OSError: they can't be written.
    """
    write_atomically(folder / _COUNTS_FILE, json.dumps(asdict(counts)))
