"""A network that practises for rewards, in a process of its own, and drives while it learns."""

import subprocess
import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import msgspec
from msgspec import Struct
from pydantic import ValidationError

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import NeuralNetController
from ai4u_edu.blocks.loading import own_files
from ai4u_edu.learn.training.run import Run
from ai4u_edu.runtime.training_progress import TrainingProgress
from ai4u_edu.teach.background import send_request, start_process
from ai4u_edu.teach.learning import DIED, STOPPED

POLL_S = 0.5
"""Interval at which the folder is read."""


class PracticeRequest(Struct, frozen=True):
    """Practice for rewards, and the folder for what it reaches."""

    scene: str
    """Text of the scene."""
    place: str
    """Folder for relative paths in the scene; empty for none."""
    agent: str
    """Id of the agent."""
    folder: str
    steps: int
    """Decisions to learn from."""
    seed: int
    weights: dict[str, float]
    """Factors of reward terms by name; 1 for one that is left out."""
    begin_with: str = ""
    """File of a network to begin with; empty for a new one."""
    against: str = ""
    """Who plays the other side: ``player``, ``self`` or a network's file; empty for nobody else
    than in the scene."""
    blocks: list[str] = []
    """Python files with blocks that the scene has."""


class PracticeEnd(Struct, frozen=True):
    """End of a practice."""

    problem: str
    """Sentence about why it ended early; empty if it did not."""


class Practice:
    """A network that practises for rewards. It begins at once, and never takes time from the world.

    Args:
        request: the practice; its own blocks are added.
        on_progress: called in a thread of its own with each new state.
        on_end: called in the same thread at the end, also after :meth:`stop`.
    """

    def __init__(
        self,
        request: PracticeRequest,
        *,
        on_progress: Callable[["Practice"], object],
        on_end: Callable[["Practice"], object],
    ) -> None:
        self.request = msgspec.structs.replace(request, blocks=[str(file) for file in own_files()])
        self.run = Run(Path(request.folder))
        """Folder of the training; there is a network in it once there was any progress."""
        self.progress = TrainingProgress(decisions=0, total=request.steps, is_over=False, curve=())
        self.problem = ""
        """Sentence about why it ended early; empty if it did not."""
        self.is_over = False
        self.controller: NeuralNetController | None = None
        """Drives with the network as it is now; None until there is one."""
        self._on_progress, self._on_end = on_progress, on_end
        self._is_stopped = False
        self._read_at = 0
        self._process = start_process("ai4u_edu.teach.practice_process")
        threading.Thread(target=self._follow, name="teach practice", daemon=True).start()

    def stop(self) -> None:
        """End it; the best network until then is kept in the folder."""
        self._is_stopped = True
        self._process.kill()

    def _follow(self) -> None:
        try:
            self.problem = self._wait()
        except AI4UError as error:  # the network can't drive
            self._process.kill()
            self.problem = str(error)
        finally:
            self.is_over = True
            self._on_end(self)

    def _wait(self) -> str:
        """Read the folder until the process ends; return the sentence about why it ended early."""
        process = self._process
        assert process.stdout is not None  # noqa: S101 - start_process asks for the pipe
        with process:
            with suppress(OSError):
                send_request(process, self.request)
            while process.poll() is None:
                self._read()
                with suppress(subprocess.TimeoutExpired):
                    process.wait(POLL_S)
            last = process.stdout.read()
        self._read()
        if self._is_stopped:
            return STOPPED
        try:
            return msgspec.json.decode(last, type=PracticeEnd).problem
        except msgspec.DecodeError:
            return DIED

    def _read(self) -> None:
        """Read the folder if there is something new in it."""
        with suppress(OSError, ValidationError):
            written_at = self.run.progress.stat().st_mtime_ns
            if written_at != self._read_at:
                self._read_at = written_at
                text = self.run.progress.read_bytes()
                self.progress = TrainingProgress.model_validate_json(text)
                self._on_progress(self)
