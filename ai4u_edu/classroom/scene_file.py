"""Files with the present scene and seed of a room, which goes on with them in its next process."""

import json
import threading
from contextlib import suppress
from pathlib import Path
from typing import Self

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.seeding import checked_seed
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.runtime.runner import Runner

NAME = "scene.yaml"
SEED_NAME = "seed.json"
POLL_S = 0.5
"""Interval at which changes are looked for; what is newer is lost if the process is killed."""


class SceneFile:
    """Writes a room's scene shortly after it was changed or another one was opened.

    The thread writes; :meth:`stop` writes once more, with the seed, and waits for it.

    Args:
        folder: of the room, which exists.
        editor: of the room.
        runner: of the room.
    """

    def __init__(self, folder: Path, editor: SceneEditor, runner: Runner) -> None:
        self._path, self._editor = folder / NAME, editor
        self._seed_path, self._runner = folder / SEED_NAME, runner
        self._written = editor.version
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name="scene file", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def stop(self) -> None:
        """Write the last change, and end the thread."""
        self._stopping.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._stopping.wait(POLL_S):
            self._write()
        self._write()
        with suppress(OSError):  # the room begins with another start, then
            write_atomically(self._seed_path, json.dumps(self._runner.latest.seed))

    def _write(self) -> None:
        version = self._editor.version
        if version == self._written:
            return
        try:
            write_atomically(self._path, self._editor.text())
        except OSError:
            return  # a full disk, say: tried again at the next poll
        self._written = version


def last_scene(folder: Path, other: str) -> str:
    """Return the path of a room's last scene, or another scene if there is none."""
    path = folder / NAME
    return str(path) if path.is_file() else other


def last_seed(folder: Path) -> int | None:
    """Return the seed of a room's last episode; None if there is none."""
    try:
        return checked_seed(json.loads((folder / SEED_NAME).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError, AI4UError):
        return None
