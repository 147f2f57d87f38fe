"""A network that practises for rewards, in a process of its own, and drives while it learns."""

import shutil
import subprocess
import threading
from collections.abc import Callable
from contextlib import suppress
from enum import Enum
from pathlib import Path

import msgspec
from msgspec import Struct
from pydantic import ValidationError

from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.file_lock import FileLock, LockedError
from ai4u_edu.blocks import NeuralNetController
from ai4u_edu.blocks.loading import own_files
from ai4u_edu.learn.training.run import Run
from ai4u_edu.runtime.training_progress import TrainingProgress
from ai4u_edu.teach.background import send_request, start_process
from ai4u_edu.teach.learning import DIED, STOPPED
from ai4u_edu.teach.scene_folder import SceneFolder

POLL_S = 0.5
"""Interval at which the folder is read."""

NO_PROGRESS = (
    "It gets no better. Stop it and change something: another factor for a reward, an easier "
    "start, or a network that has learned from your drives to begin with."
)


class PracticeRequest(Struct, frozen=True):
    """Practice for rewards, and the folder for what it reaches."""

    scene: str
    """Text of the scene."""
    scene_name: str
    place: str
    """Folder for relative paths in the scene; empty for none."""
    agent: str
    """Id of the agent."""
    steps: int
    """Decisions to learn from."""
    seed: int
    weights: dict[str, float]
    """Factors of reward terms by name; 1 for one that is left out."""
    folder: str = ""
    """Folder of the training."""
    begin_with: str = ""
    """File of a network to begin with; empty for a new one."""
    against: str = ""
    """Player of the other side: ``player``, ``self`` or a network's file; empty for nobody else
    than in the scene."""
    opponent: str = ""
    """The same in words, which follow "decisions"."""
    blocks: list[str] = []
    """Python files with blocks that the scene has."""


class PracticeEnd(Struct, frozen=True):
    """End of a practice."""

    problem: str
    """Sentence about why it ended early; empty if it did not."""


class Phase(Enum):
    """Phase of a practice."""

    RUNNING = "running"
    PAUSED = "paused"
    """It can go on, in this process or in a later one."""
    OVER = "over"


class Practice:
    """A network that practises for rewards, and never takes time from the world.

    All that it needs to go on lies in its folder, so it outlives this process. A thread of its own
    follows the process that learns while it runs. One other thread calls the methods that change
    it, except :meth:`pause`, which any may call.

    Args:
        folder: of this practice; :class:`PracticeFolder` made it.
        request: the practice.
        on_progress: called in the thread of its own with each new state.
        on_end: called at the end, also after :meth:`stop`: in the thread of its own, or by
            :meth:`stop` if it was paused.
    """

    def __init__(
        self,
        folder: Path,
        request: PracticeRequest,
        *,
        on_progress: Callable[["Practice"], object],
        on_end: Callable[["Practice"], object],
    ) -> None:
        self.folder, self.request = folder, request
        self.run = Run(Path(request.folder))
        """Folder of the training; there is a network in it once there was any progress."""
        self.progress = TrainingProgress(decisions=0, total=request.steps, is_over=False, curve=())
        self.problem = ""
        """Sentence about why it ended early; empty if it did not."""
        self.phase = Phase.PAUSED
        self.controller: NeuralNetController | None = None
        """Drives with the network as it is now; None until there is one."""
        self._on_progress, self._on_end = on_progress, on_end
        self._lock = FileLock(folder / "lock")
        self._wish = Phase.RUNNING
        self._read_at = 0
        self._process: subprocess.Popen[bytes] | None = None
        self._thread: threading.Thread | None = None
        self._read()

    @property
    def decisions_per_s(self) -> float | None:
        """Decisions that it learns from in a second, checks included; None before its first."""
        with suppress(OSError, ValueError):
            check = self.run.checks()[-1:]
            return check[0].steps / max(check[0].seconds, 1e-9) if check else None
        return None

    @property
    def hint(self) -> str:
        """Sentence about what to change if it gets no better; empty if it does, or is young."""
        progress = self.progress
        first, *later = progress.curve or (None,)
        if first is None or not later or progress.decisions < progress.total / 3:
            return ""
        is_better = any(point.success or point.reward > first.reward for point in progress.curve)
        return "" if is_better else NO_PROGRESS

    @property
    def facts(self) -> tuple[str, ...]:
        """Sentences about its rewards and settings."""
        request = self.request
        factors = ", ".join(f"{name} times {factor:g}" for name, factor in request.weights.items())
        others = "all others as in the scene" if factors else "as in the scene"
        begin = "with a network of yours" if request.begin_with else "with a new network"
        return (
            f"Rewards: {', '.join(filter(None, (factors, others)))}.",
            f"It began {begin}, and could learn from {request.steps:,} decisions.",
            f"Seed: {request.seed}.",
        )

    def replays(self) -> dict[int, bytes]:
        """Return episodes of one start, by the decisions that it had learned from then."""
        files = self.folder.glob("replays/*.episode")
        return {int(file.stem): file.read_bytes() for file in files if file.stem.isdecimal()}

    def go_on(self) -> None:
        """Begin, or go on with what the folder has."""
        if self._thread is not None:
            self._thread.join()  # the process before was killed already
        self._wish = self.phase = Phase.RUNNING
        self._process = start_process("ai4u_edu.teach.practice_process")
        self._thread = threading.Thread(target=self._follow, name="teach practice", daemon=True)
        self._thread.start()

    def pause(self) -> None:
        """Let it wait; it loses the last second or two."""
        self._end_process(Phase.PAUSED)

    def stop(self) -> None:
        """End it; its best network until then is in the folder."""
        was_paused = self.phase is Phase.PAUSED
        self._end_process(Phase.OVER)
        if was_paused:
            self._end(STOPPED)

    def leave(self) -> None:
        """Let it wait for another process, which may go on with it."""
        self.pause()
        if self._thread is not None:
            self._thread.join()
        self._lock.release()

    def remove(self) -> None:
        """Delete its folder."""
        self._lock.release(remove=True)
        shutil.rmtree(self.folder, ignore_errors=True)

    def _end_process(self, wish: Phase) -> None:
        self._wish = wish
        if self._process is not None:
            self._process.kill()

    def _end(self, problem: str) -> None:
        self.problem, self.phase = problem, Phase.OVER
        self._on_end(self)

    def _follow(self) -> None:
        try:
            problem = self._wait()
        except Exception as error:  # the network can't drive, or a block of a person's own raised
            self._end_process(Phase.OVER)
            problem = message_of(error)
        if problem == STOPPED and self._wish is Phase.PAUSED:
            self.phase = Phase.PAUSED
        else:
            self._end(problem)

    def _wait(self) -> str:
        """Read the folder until the process ends; return the sentence about why it ended early."""
        process = self._process
        assert process is not None  # noqa: S101 - go_on starts it before
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
        try:
            return msgspec.json.decode(last, type=PracticeEnd).problem
        except msgspec.DecodeError:
            return DIED if self._wish is Phase.RUNNING else STOPPED

    def _read(self) -> None:
        """Read the folder if there is something new in it."""
        with suppress(OSError, ValidationError):
            written_at = self.run.progress.stat().st_mtime_ns
            if written_at != self._read_at:
                self._read_at = written_at
                text = self.run.progress.read_bytes()
                self.progress = TrainingProgress.model_validate_json(text)
                if self._process is not None:
                    self._on_progress(self)


class PracticeFolder:
    """The practices of all scenes that are not over; one thread calls it.

    Args:
        folder: it is created with the first practice.
    """

    def __init__(self, folder: Path) -> None:
        self._folders = SceneFolder(folder, ".practice")

    def add(self, scene: str, request: PracticeRequest) -> tuple[Path, PracticeRequest]:
        """Make a practice's folder, and return it with the request as it is kept there.

        Raises:
            OSError: it can't be made.
        """
        folder = self._folders.next_file(scene).absolute()
        folder.mkdir(mode=0o700)
        own = [str(file) for file in own_files()]
        request = msgspec.structs.replace(request, folder=str(folder / "run"), blocks=own)
        if request.begin_with:  # a copy, which stays if the network is deleted
            begin_with = folder / "begin_with.onnx"
            shutil.copyfile(request.begin_with, begin_with)
            request = msgspec.structs.replace(request, begin_with=str(begin_with))
        if request.against.endswith(".onnx"):
            opponent = folder / "opponent.onnx"
            shutil.copyfile(request.against, opponent)
            request = msgspec.structs.replace(request, against=str(opponent))
        write_atomically(folder / "request.json", msgspec.json.encode(request), mode=0o600)
        return folder, request

    def find(
        self, scene: str, make: Callable[[Path, PracticeRequest], Practice]
    ) -> Practice | None:
        """Return the latest practice of a scene that nobody has; None if there is none."""
        for folder in reversed(self._folders.files(scene)):
            with suppress(LockedError, OSError, msgspec.DecodeError):
                text = (folder / "request.json").read_bytes()
                return make(folder, msgspec.json.decode(text, type=PracticeRequest))
        return None
