"""Autosave of changed scenes, so that a killed server can offer them when it is started again.

Each server writes its own files, one for each scene that it changes, and holds a lock while it
runs. A file whose server no longer holds its lock was left behind, and is offered.
"""

import json
import os
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from secrets import token_hex

from ai4u_edu.base.atomic_write import reason, remove_leftovers, write_atomically
from ai4u_edu.base.errors import text_of
from ai4u_edu.base.file_lock import FileLock
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.page.editing.unsaved import (
    ENDING,
    LOCK_ENDING,
    Unsaved,
    latest,
    prune,
    unsaved_scenes,
)

__all__ = ["Autosave", "Unsaved", "latest", "unsaved_folder", "unsaved_scenes"]

WRITE_DELAY_S = 0.4
"""Time without a change after which a scene is written."""
MAX_WRITE_DELAY_S = 2.0
"""Time after the first change after which a scene is written in any case."""
RETRY_S = 10.0
"""Time after which a failed write is tried again."""
MAX_NAME_BYTES = 120
"""Length of the scene's name in a file's name."""


def unsaved_folder() -> Path:
    """Return the user's folder for unsaved scenes, below the platform's state folder."""
    if sys.platform == "win32":
        place = Path(os.environ.get("LOCALAPPDATA") or _home() / "AppData/Local")
    elif sys.platform == "darwin":
        place = _home() / "Library/Application Support"
    else:
        place = Path(os.environ.get("XDG_STATE_HOME") or _home() / ".local/state")
    return place / "ai4u-edu" / "unsaved"


@dataclass
class _OpenScene:
    """A scene that was opened, and the file for its changes."""

    opened: object
    file: Path | None = None
    restored: EditState | None = None
    """The opened state, if it was restored and so is unsaved already."""


class Autosave:
    """Writes a scene shortly after it was changed, in its own thread.

    Failed writes are reported once and retried.

    Args:
        folder: folder of the files; created if needed.
        name: of the scene; part of the file's name.
        on_problem: called with a sentence when changes can't be written, in any thread.
    """

    def __init__(
        self, folder: Path, name: str, on_problem: Callable[[str], object] | None = None
    ) -> None:
        self.problem = ""
        """Sentence about why writing fails at present; empty if it does not."""
        self._folder, self._name = folder, name
        self._on_problem = on_problem
        self._instance = token_hex(6)
        self._order = 1, 0
        self._lock: FileLock | None = None
        self._holding = threading.Lock()
        self._open_scenes: list[_OpenScene] = []
        self._due: dict[int, tuple[_OpenScene, EditState | None]] = {}
        self._since = 0.0
        self._stopping = False
        self._changed = threading.Condition()
        try:
            folder.mkdir(parents=True, exist_ok=True)
            remove_leftovers(folder)
            self._order = _last_start(folder) + 1, 0
            prune(folder)
            if not os.access(folder, os.W_OK):
                self._fail(_("it may not be written to"))
        except OSError as error:
            self._fail(reason(error))
        self._thread = threading.Thread(target=self._run, name="autosave", daemon=True)
        self._thread.start()

    def schedule(self, state: EditState | None, opened: object = None) -> None:
        """Schedule a state to be written; returns at once.

        Args:
            state: the present state; None if it is again the opened one.
            opened: the state that was opened; each has its own file.
        """
        with self._changed:
            entry = self._entry(opened)
            if not self._due:
                self._since = time.monotonic()
            self._due[id(entry)] = entry, entry.restored if state is None else state
            self._changed.notify()

    def claim(self, unsaved: Unsaved, opened: EditState) -> None:
        """Take over a file that a killed server left, and keep it until the scene is saved.

        Args:
            unsaved: the scene that was left.
            opened: the state that it was opened as.
        """
        with self._changed:
            entry = self._entry(opened)
            entry.restored = opened
        try:
            self._hold_lock()
            entry.file = self._file(unsaved.name or self._name)
            unsaved.file.replace(entry.file)
        except OSError:  # another server claimed it first, or the folder is read-only
            self.schedule(opened, opened)

    def forget(self, opened: object = None) -> None:
        """Delete the file of a scene that was saved."""
        with self._changed:
            self._entry(opened).restored = None
        self.schedule(None, opened)

    def stop(self) -> None:
        """Write scheduled states, and end the thread."""
        with self._changed:
            self._stopping = True
            self._changed.notify()
        self._thread.join()
        if self._lock is not None:
            self._lock.release(remove=True)
            self._lock = None

    def _entry(self, opened: object) -> _OpenScene:
        for entry in self._open_scenes:
            if entry.opened is opened:
                return entry
        self._open_scenes.append(_OpenScene(opened))
        return self._open_scenes[-1]

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._due or self._stopping)
                if not self._due:
                    return
                self._wait_for_pause()
                due, self._due = self._due, {}
            failed = {key: each for key, each in due.items() if not self._write(*each)}
            with self._changed:
                self._due = {**failed, **self._due}
                if failed and self._stopping:
                    return
                if failed:
                    self._changed.wait(RETRY_S)
                elif not self._due:
                    self.problem = ""

    def _wait_for_pause(self) -> None:
        """Wait until nothing has been changed for a moment."""
        while not self._stopping and time.monotonic() - self._since < MAX_WRITE_DELAY_S:
            before = dict(self._due)
            self._changed.wait(WRITE_DELAY_S)
            if all(self._due[key] is each for key, each in before.items()):
                break

    def _write(self, entry: _OpenScene, state: EditState | None) -> bool:
        """Write a state, or delete the file of one that is not unsaved; return False on failure."""
        try:
            if state is not None:
                self._hold_lock()
                entry.file = entry.file or self._file(state.description.name or self._name)
                self._order = self._order[0], self._order[1] + 1
                _write_file(entry.file, state, self._order)
            elif entry.file is not None:
                entry.file.unlink(missing_ok=True)
        except OSError as error:
            self._fail(reason(error))
            return False
        except Exception as error:  # one scene that can't be serialized must not end the thread
            self._fail(text_of(error))
        return True

    def _hold_lock(self) -> None:
        """Hold the lock that tells other servers that this one runs."""
        with self._holding:
            while self._lock is None or not self._lock.path.exists():
                if self._lock is not None:  # another server deleted it as a leftover
                    self._lock.release()
                    self._lock = None
                self._folder.mkdir(parents=True, exist_ok=True)
                self._lock = FileLock(self._folder / f"{self._instance}{LOCK_ENDING}")

    def _file(self, name: str) -> Path:
        safe = "".join(char if char.isalnum() or char in "-_" else "_" for char in name)
        short = safe.encode()[:MAX_NAME_BYTES].decode(errors="ignore")
        number = len(self._open_scenes)
        return self._folder / f"{short}-{self._instance}-{number}{ENDING}"

    def _fail(self, why: str) -> None:
        is_new = not self.problem
        self.problem = _(
            "changes can't be kept in {folder}: {reason}", folder=str(self._folder), reason=why
        )
        if is_new and self._on_problem is not None:
            self._on_problem(self.problem)


def _home() -> Path:
    try:
        return Path.home()
    except RuntimeError:  # unknown; writing there fails with a readable error
        return Path(os.devnull)


def _last_start(folder: Path) -> int:
    """Return the greatest number of a start in a folder's files."""
    return max((each.order[0] for each in unsaved_scenes(folder, of_running=True)), default=0)


def _write_file(file: Path, state: EditState, order: tuple[int, int]) -> None:
    data = {
        "scene": state.description.name,
        "text": state.scene.dumps(),
        "folder": str(state.folder or ""),
        "saved_at": time.time(),
        "order": order,
    }
    file.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(file, json.dumps(data), mode=0o600)
