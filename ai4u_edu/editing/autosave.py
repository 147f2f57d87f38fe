"""Keeps what nobody saved: a killed server offers it when it is started again.

Each server writes files of its own, one for each scene that it changes, and holds a lock for as
long as it lives. A file whose server holds no lock any more was left behind, and is offered.
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

from ai4u_edu.base.atomic_write import partial_file, reason, remove_leftovers
from ai4u_edu.base.file_lock import FileLock
from ai4u_edu.editing.state import EditState
from ai4u_edu.editing.unsaved import ENDING, LOCK_ENDING, Unsaved, latest, prune, unsaved_scenes

__all__ = ["Autosave", "Unsaved", "latest", "unsaved_folder", "unsaved_scenes"]

DELAY = 0.4
"""Seconds that changes have to be over before they are written; a hand may be moving a wall."""
LONGEST = 2.0
"""Seconds after which they are written in any case."""
RETRY_S = 10.0
"""Time after which what could not be written is tried again."""
MAX_NAME_BYTES = 120
"""Length of the part of a file's name that says which scene it is."""


def unsaved_folder() -> Path:
    """Where this user's unsaved scenes are: with the other state of programs, not among files."""
    if sys.platform == "win32":
        place = Path(os.environ.get("LOCALAPPDATA") or _home() / "AppData/Local")
    elif sys.platform == "darwin":
        place = _home() / "Library/Application Support"
    else:
        place = Path(os.environ.get("XDG_STATE_HOME") or _home() / ".local/state")
    return place / "ai4u-edu" / "unsaved"


@dataclass
class _Work:
    """A scene that was opened, and the file for what is changed in it."""

    opened: object
    file: Path | None = None
    restored: EditState | None = None
    """The scene as it was opened, if that was unsaved already."""


class Autosave:
    """Writes a scene a moment after it was changed, in a thread of its own.

    Nothing that goes wrong there ends a lesson: it is told once, and tried again later.

    Args:
        folder: where; it is made.
        name: of the scene; part of the file's name.
        on_problem: called with a sentence when changes can't be written, in any thread.
    """

    def __init__(
        self, folder: Path, name: str, on_problem: Callable[[str], object] | None = None
    ) -> None:
        self.problem = ""
        """Why nothing can be written just now, in a sentence; empty if all is well."""
        self._folder, self._name = folder, name
        self._on_problem = on_problem
        self._instance = token_hex(6)
        self._lock: FileLock | None = None
        self._holding = threading.Lock()
        self._works: list[_Work] = []
        self._due: dict[int, tuple[_Work, EditState | None]] = {}
        self._since = 0.0
        self._stopping = False
        self._changed = threading.Condition()
        try:
            folder.mkdir(parents=True, exist_ok=True)
            remove_leftovers(folder)
            prune(folder)
            if not os.access(folder, os.W_OK):
                self._fail("it may not be written to")
        except OSError as error:
            self._fail(reason(error))
        self._thread = threading.Thread(target=self._run, name="autosave", daemon=True)
        self._thread.start()

    def note(self, state: EditState | None, opened: object = None) -> None:
        """Have a state written soon, which costs the caller nothing.

        Args:
            state: as the scene is now; None: it is again as it was opened.
            opened: which scene was opened; each has a file of its own.
        """
        with self._changed:
            work = self._work(opened)
            if not self._due:
                self._since = time.monotonic()
            self._due[id(work)] = work, work.restored if state is None else state
            self._changed.notify()

    def claim(self, unsaved: Unsaved, opened: EditState) -> None:
        """Take over a file that a killed server left; it is kept until somebody saves the scene.

        Args:
            unsaved: what was left.
            opened: the same, as it was opened here.
        """
        with self._changed:
            work = self._work(opened)
            work.restored = opened
        try:
            self._hold()
            work.file = self._file(unsaved.name or self._name)
            unsaved.file.replace(work.file)
        except OSError:  # another server was faster, or the folder may not be written to
            self.note(opened, opened)

    def forget(self, opened: object = None) -> None:
        """Somebody saved the scene: what is kept of it can go."""
        with self._changed:
            self._work(opened).restored = None
        self.note(None, opened)

    def stop(self) -> None:
        """Write what still waits, and end."""
        with self._changed:
            self._stopping = True
            self._changed.notify()
        self._thread.join()
        if self._lock is not None:
            self._lock.release(remove=True)
            self._lock = None

    def _work(self, opened: object) -> _Work:
        for work in self._works:
            if work.opened is opened:
                return work
        self._works.append(_Work(opened))
        return self._works[-1]

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._due or self._stopping)
                if not self._due:
                    return
                self._settle()
                due, self._due = self._due, {}
            failed = {key: each for key, each in due.items() if not self._keep(*each)}
            with self._changed:
                self._due = {**failed, **self._due}
                if failed and self._stopping:
                    return
                if failed:
                    self._changed.wait(RETRY_S)
                elif not self._due:
                    self.problem = ""

    def _settle(self) -> None:
        """Wait until nobody has changed anything for a moment."""
        while not self._stopping and time.monotonic() - self._since < LONGEST:
            before = dict(self._due)
            self._changed.wait(DELAY)
            if all(self._due[key] is each for key, each in before.items()):
                break

    def _keep(self, work: _Work, state: EditState | None) -> bool:
        """Write a state, or delete the file of one that is no longer unsaved."""
        try:
            if state is not None:
                self._hold()
                work.file = work.file or self._file(state.description.name or self._name)
                _write(work.file, state)
            elif work.file is not None:
                work.file.unlink(missing_ok=True)
        except OSError as error:
            self._fail(reason(error))
            return False
        except Exception as error:  # a scene that can't be written down is no reason to stop
            self._fail(str(error))
        return True

    def _hold(self) -> None:
        """Hold the lock by which other servers see that this one lives."""
        with self._holding:
            while self._lock is None or not self._lock.path.exists():
                if self._lock is not None:  # another server took it for one that was left
                    self._lock.release()
                    self._lock = None
                self._folder.mkdir(parents=True, exist_ok=True)
                self._lock = FileLock(self._folder / f"{self._instance}{LOCK_ENDING}")

    def _file(self, name: str) -> Path:
        safe = "".join(char if char.isalnum() or char in "-_" else "_" for char in name)
        short = safe.encode()[:MAX_NAME_BYTES].decode(errors="ignore")
        number = len(self._works)
        return self._folder / f"{short}-{self._instance}-{number}{ENDING}"

    def _fail(self, why: str) -> None:
        is_new, self.problem = not self.problem, f"changes can't be kept in {self._folder}: {why}"
        if is_new and self._on_problem is not None:
            self._on_problem(self.problem)


def _home() -> Path:
    try:
        return Path.home()
    except RuntimeError:  # nobody knows it; what is written there fails with a sentence
        return Path(os.devnull)


def _write(file: Path, state: EditState) -> None:
    data = {
        "scene": state.description.name,
        "text": state.scene.dumps(),
        "folder": str(state.folder or ""),
        "saved_at": time.time(),
    }
    file.parent.mkdir(parents=True, exist_ok=True)
    with partial_file(file, mode=0o600) as beside, beside.open("w", encoding="utf-8") as out:
        json.dump(data, out)
