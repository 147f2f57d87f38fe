"""Keeps what nobody saved: a killed server offers it when it is started again."""

import json
import os
import sys
import tempfile
import threading
import time
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from ai4u_edu.scenes import Scene
from ai4u_edu.workshop.state import State

DELAY = 0.4
"""Seconds that changes have to be over before they are written; a hand may be moving a wall."""
LONGEST = 2.0
"""Seconds after which they are written in any case."""
ENDING = ".unsaved"


@dataclass(frozen=True)
class Unsaved:
    """A scene that somebody changed and did not save."""

    file: Path
    text: str
    folder: Path | None
    saved_at: float
    """Seconds since 1970."""

    @property
    def when(self) -> str:
        """The time of day, and the day if it was another one."""
        then = datetime.fromtimestamp(self.saved_at)
        today = then.date() == datetime.now().date()
        return then.strftime("%H:%M" if today else "%Y-%m-%d %H:%M")

    def scene(self) -> Scene:
        """As a scene.

        Raises:
            SceneError: it can't be read.
        """
        return Scene.loads(self.text, name="the unsaved scene", folder=self.folder)


def unsaved_folder() -> Path:
    """Where this user's unsaved scenes are: with the other state of programs, not among files."""
    if sys.platform == "win32":
        place = Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData/Local")
    elif sys.platform == "darwin":
        place = Path.home() / "Library/Application Support"
    else:
        place = Path(os.environ.get("XDG_STATE_HOME") or Path.home() / ".local/state")
    return place / "ai4u-edu" / "unsaved"


def latest(folder: Path) -> Unsaved | None:
    """What was left there last; None if there is nothing that can be read."""
    found = []
    for file in folder.glob(f"*{ENDING}"):
        with suppress(OSError, ValueError, TypeError, KeyError):
            data = json.loads(file.read_text(encoding="utf-8"))
            place = Path(data["folder"]) if data["folder"] else None
            found.append(Unsaved(file, str(data["text"]), place, float(data["saved_at"])))
    return max(found, key=lambda each: each.saved_at, default=None)


class Autosave:
    """Writes a scene a moment after it was changed: beside, to the disk, and in place of the last.

    Args:
        folder: where; it is made.
        name: of the file.
    """

    def __init__(self, folder: Path, name: str) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        safe = "".join(char if char.isalnum() or char in "-_" else "_" for char in name)
        self._file = folder / f"{safe[:80]}{ENDING}"
        self._wanted: State | None = None
        self._is_due = False
        self._since = 0.0
        self._stopping = False
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._run, name="autosave", daemon=True)
        self._thread.start()

    def note(self, state: State | None) -> None:
        """Has a state written soon, which costs its caller nothing; none: nothing is unsaved."""
        with self._changed:
            if not self._is_due:
                self._since = time.monotonic()
            self._wanted, self._is_due = state, True
            self._changed.notify()

    def stop(self) -> None:
        """Writes what still waits, and ends."""
        with self._changed:
            self._stopping = True
            self._changed.notify()
        self._thread.join()

    def _run(self) -> None:
        while not self._stopping or self._is_due:
            with self._changed:
                self._changed.wait_for(lambda: self._is_due or self._stopping)
                if not self._is_due:
                    return
                state = self._settled()
                self._is_due = False
            with suppress(OSError):  # a full disk is no reason to stop a lesson
                if state is None:
                    self._file.unlink(missing_ok=True)
                else:
                    _write(self._file, state)

    def _settled(self) -> State | None:
        """What is to be written, once nobody changes it any more for a moment."""
        state = self._wanted
        while not self._stopping and time.monotonic() - self._since < LONGEST:
            before = state
            self._changed.wait(DELAY)
            state = self._wanted
            if state is before:
                break
        return state


def _write(file: Path, state: State) -> None:
    data = {
        "text": state.scene.dumps(),
        "folder": str(state.folder or ""),
        "saved_at": time.time(),
    }
    handle, beside = tempfile.mkstemp(dir=file.parent, prefix=f".{file.name}-")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as out:
            json.dump(data, out)
            out.flush()
            os.fsync(out.fileno())
        Path(beside).replace(file)
    except BaseException:
        Path(beside).unlink(missing_ok=True)
        raise
