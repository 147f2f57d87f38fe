"""The process that plays a class's tournament, as the class sees it."""

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from threading import Thread
from typing import Any

MODULE = "ai4u_edu.games.tournament.live_process"
TEMPORARY = "games.tmp"
"""Folder for files of the games that are played, with networks; nothing of it stays."""
END_TIMEOUT_S = 5.0


class PlayedTournament:
    """A tournament that is played in a process of its own, which ends with this one.

    Args:
        folder: of the tournament's results, with its plan.
        work: gets the journal, and files of the games that are played.
        on_change: called in a thread of its own when the tournament goes on or ends.
    """

    def __init__(self, folder: Path, work: Path, on_change: Callable[[], object]) -> None:
        self.view: dict[str, Any] | None = None
        """The tournament so far; see :func:`ai4u_edu.games.tournament.live_process.live_view`."""
        self.problem = ""
        """Reason for which it could not be played."""
        self.is_over = False
        """True when all games were played."""
        self.has_ended = False
        """True when the process has ended, in any way."""
        self._on_change = on_change
        self._temporary = work / TEMPORARY
        shutil.rmtree(self._temporary, ignore_errors=True)  # of a class that was killed
        self._temporary.mkdir(parents=True, exist_ok=True)
        variables = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(self._temporary.absolute()))
        self._process = subprocess.Popen(  # noqa: S603 - our own module
            [sys.executable, "-m", MODULE, str(folder), str(work)],
            env={**os.environ, **variables},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        self._reader = Thread(target=self._read, name="tournament", daemon=True)
        self._reader.start()

    def end(self) -> None:
        """End the process, and wait for that; a thread does it."""
        if self._process.stdin is not None:
            self._process.stdin.close()
        try:
            self._process.wait(END_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
        self._reader.join(END_TIMEOUT_S)
        shutil.rmtree(self._temporary, ignore_errors=True)

    def _read(self) -> None:
        assert self._process.stdout is not None  # noqa: S101 - it is a pipe
        with self._process.stdout as lines:
            for line in lines:
                told = json.loads(line)
                self.view = told.get("view", self.view)
                self.problem = told.get("problem", "")
                self.is_over = told.get("is_over", False)
                self._on_change()
        code = self._process.wait()
        if not self.is_over and not self.problem:
            self.problem = (
                f"The tournament's process has ended by itself (code {code}). Start it again: it "
                "goes on where it was."
            )
        self.has_ended = True
        self._on_change()
