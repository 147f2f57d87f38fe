"""A network that practises for rewards in another process, and drives while it learns."""

import secrets
import shutil
import subprocess
import threading
from collections.abc import Callable
from contextlib import suppress
from enum import Enum
from pathlib import Path
from typing import Protocol

import msgspec
from msgspec import Struct
from pydantic import ValidationError

from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.file_lock import FileLock, LockedError
from ai4u_edu.blocks import NeuralNetController
from ai4u_edu.blocks.loading import own_files
from ai4u_edu.learn.training.run import Run
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, packed, unpacked
from ai4u_edu.page.editing.editor import ClassTrainings
from ai4u_edu.runtime.training_progress import TrainingProgress
from ai4u_edu.teach.background import cpu_s, send_request, start_process
from ai4u_edu.teach.learning import DIED, STOPPED, UNREACHABLE
from ai4u_edu.teach.network_score import NetworkScore
from ai4u_edu.teach.scene_folder import SceneFolder

POLL_S = 0.5
"""Interval at which the folder is read."""
FOLDER = "practices"
"""Folder of practices in a folder of work."""
SCORE = "score.json"
"""File in a practice's folder with the score of its network."""
CLASS_KEY = "class_key"
"""File in a practice's folder with the key under which a class's process works on it."""

NO_PROGRESS = _(
    "It gets no better. Stop it and change something: another factor for a "
    "reward, an easier start, or a network that has learned from your drives to "
    "begin with."
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
    """The same in words, such as "against itself"."""
    blocks: list[str] = []
    """Python files with blocks that the scene has."""


class PracticeEnd(Struct, frozen=True):
    """End of a practice."""

    problem: str
    """Sentence about why it ended early; empty if it did not."""


class Practising(Protocol):
    """Work on a practice, in this world's machine or in a class's."""

    def wait(self, seconds: float) -> bool:
        """Wait until it has ended; return False if it has not by then."""

    @property
    def waiting(self) -> str:
        """Sentence about what it waits for; empty if it works or has ended."""

    @property
    def problem(self) -> str | None:
        """Sentence about why it ended early: empty if it is done, None if it was killed."""

    def kill(self) -> None:
        """End it; the practice can go on later."""

    def leave(self) -> None:
        """Leave it to a later process of this world; end it if it can't go on without this one."""


class PracticeProcess:
    """Process that works on a practice; it begins at once.

    Args:
        request: the practice.
    """

    waiting = ""

    def __init__(self, request: PracticeRequest) -> None:
        self._process = start_process("ai4u_edu.teach.practice_process")
        with suppress(OSError):  # it has ended already
            send_request(self._process, request)
        self._lock = threading.Lock()
        self._last: bytes | None = None

    def wait(self, seconds: float) -> bool:
        """Wait until it has ended; return False if it has not by then."""
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(seconds)
            return True
        return False

    @property
    def problem(self) -> str | None:
        """Sentence about why it ended early: empty if it is done, None if it was killed."""
        with self._lock:  # two may ask for it at its end
            if self._last is None:
                with self._process as process:
                    assert process.stdout is not None  # noqa: S101 - start_process asks for it
                    self._last = process.stdout.read()
        try:
            return unpacked(msgspec.json.decode(self._last, type=PracticeEnd).problem)
        except msgspec.DecodeError:
            return None

    def cpu_s(self) -> float:
        """Return the processor time (s) that it has used; 0 after its end."""
        return cpu_s(self._process)

    def kill(self) -> None:
        """End it; it loses the last second or two."""
        self._process.kill()

    leave = kill


class ClassPractice:
    """Work on a practice in the class's process: a room on its machine may start none.

    Its key lies in the practice's folder, so that the room's next process finds it again.

    Args:
        trainings: of the class.
        folder: of the practice, which the class's process has, too.
    """

    def __init__(self, trainings: ClassTrainings, folder: Path) -> None:
        self._trainings, self._file = trainings, folder / CLASS_KEY
        self._is_left = threading.Event()
        if not self._file.is_file():
            write_atomically(self._file, secrets.token_urlsafe(12), mode=0o600)
        self._key = self._file.read_text()
        trainings.practise(self._key, folder.name)

    def wait(self, seconds: float) -> bool:
        """Wait until it has ended; return False if it has not by then."""
        if not self._is_over:
            self._is_left.wait(seconds)
        return self._is_left.is_set() or self._is_over

    @property
    def waiting(self) -> str:
        """Sentence about what it waits for; empty if it works or has ended."""
        state = self._trainings.practice(self._key)
        if self._is_over:
            return ""
        if not self._trainings.is_connected:
            return UNREACHABLE
        return (
            _("Your place in the line: {place}.", place=state.place)
            if state and state.place
            else ""
        )

    @property
    def problem(self) -> str | None:
        """Sentence about why it ended early: empty if it is done, None if it was killed."""
        state = self._trainings.practice(self._key)
        if self._is_left.is_set() or state is None or state.problem == STOPPED:
            return None
        return state.problem

    def kill(self) -> None:
        """End it; the practice can go on later, with a new request."""
        self._file.unlink(missing_ok=True)
        self._trainings.stop_practice(self._key)

    def leave(self) -> None:
        """Leave it to the room's next process."""
        self._is_left.set()

    @property
    def _is_over(self) -> bool:
        state = self._trainings.practice(self._key)
        return state is None or state.is_over


class Phase(Enum):
    """Phase of a practice."""

    RUNNING = "running"
    PAUSED = "paused"
    """It can go on, in this process or in a later one."""
    OVER = "over"


class Practice:
    """A network that practises for rewards, and never takes time from the world.

    All that it needs to go on lies in its folder, so it outlives this process. A thread of its own
    follows the work while it runs. One other thread calls the methods that change
    it, except :meth:`pause`, which any may call.

    Args:
        folder: of this practice; :class:`PracticeFolder` made it.
        request: the practice.
        start: begins the work on a practice, given its folder and the practice.
        on_progress: called in the thread of its own with each new state.
        on_end: called at the end, also after :meth:`stop`: in the thread of its own, or by
            :meth:`stop` if it was paused.
    """

    def __init__(
        self,
        folder: Path,
        request: PracticeRequest,
        *,
        start: Callable[[Path, PracticeRequest], Practising],
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
        self._start, self._on_progress, self._on_end = start, on_progress, on_end
        self._lock = FileLock(folder / "lock")
        self._wish = Phase.RUNNING
        self._read_at = 0
        self._work: Practising | None = None
        self._thread: threading.Thread | None = None
        self._read()

    @property
    def is_under_way(self) -> bool:
        """True if a class's process works on it since an earlier process of this room."""
        return (self.folder / CLASS_KEY).is_file()

    @property
    def decisions_per_s(self) -> float | None:
        """Decisions that it learns from in a second, checks included; None before its first."""
        with suppress(OSError, ValueError):
            check = self.run.checks()[-1:]
            return check[0].steps / max(check[0].seconds, 1e-9) if check else None
        return None

    @property
    def waiting(self) -> str:
        """Sentence about what it waits for; empty if it learns, is paused or over."""
        is_running = self.phase is Phase.RUNNING and self._work is not None
        return self._work.waiting if is_running and self._work is not None else ""

    @property
    def hint(self) -> str:
        """Sentence about what to change if it gets no better; empty if it does, or is young."""
        progress = self.progress
        if self.phase is Phase.OVER:
            return ""
        first, *later = progress.curve or (None,)
        if first is None or not later or progress.decisions < progress.total / 3:
            return ""
        is_better = any(point.success or point.reward > first.reward for point in progress.curve)
        return "" if is_better else NO_PROGRESS

    @property
    def facts(self) -> tuple[str, ...]:
        """Sentences about its rewards and settings."""
        request = self.request
        weights = request.weights.items()
        each = [_("{name} times {factor:g}", name=name, factor=f) for name, f in weights]
        factors = join([*each], ", ") if each else ""
        rewards: str = _("Rewards: as in the scene.")
        if factors:
            rewards = _("Rewards: {factors}, all others as in the scene.", factors=factors)
        began: str = _(
            "It began with a new network, and could learn from {steps:,} decisions.",
            steps=request.steps,
        )
        if request.begin_with:
            began = _(
                "It began with a network of yours, and could learn from {steps:,} decisions.",
                steps=request.steps,
            )
        return rewards, began, _("Seed: {seed}.", seed=request.seed)

    def score(self) -> NetworkScore | None:
        """Return the score of the network; None if it ended early, or in games."""
        with suppress(OSError, msgspec.MsgspecError):
            text = (self.folder / SCORE).read_bytes()
            return msgspec.json.decode(text, type=NetworkScore | None)
        return None

    def replays(self) -> dict[int, bytes]:
        """Return episodes of one start, by the decisions that it had learned from then."""
        files = self.folder.glob("replays/*.episode")
        return {int(file.stem): file.read_bytes() for file in files if file.stem.isdecimal()}

    def go_on(self) -> None:
        """Begin, or go on with what the folder has.

        Raises:
            OSError: the work can't begin.
        """
        if self._thread is not None:
            self._thread.join()  # the work before has ended already
        self._wish = Phase.RUNNING
        self._work = self._start(self.folder, self.request)
        self.phase = Phase.RUNNING
        self._thread = threading.Thread(target=self._follow, name="teach practice", daemon=True)
        self._thread.start()

    def pause(self) -> None:
        """Let it wait; it loses the last second or two."""
        self._end_work(Phase.PAUSED)

    def stop(self) -> None:
        """End it; its best network until then is in the folder."""
        was_paused = self.phase is Phase.PAUSED
        self._end_work(Phase.OVER)
        if was_paused:
            self._end(STOPPED)

    def leave(self) -> None:
        """Leave it to another process, which may go on with it."""
        self._wish = Phase.PAUSED
        if self._work is not None:
            self._work.leave()
        if self._thread is not None:
            self._thread.join()
        self._lock.release()

    def remove(self) -> None:
        """Delete its folder."""
        self._lock.release(remove=True)
        shutil.rmtree(self.folder, ignore_errors=True)

    def _end_work(self, wish: Phase) -> None:
        self._wish = wish
        if self._work is not None:
            self._work.kill()

    def _end(self, problem: str) -> None:
        self.problem, self.phase = problem, Phase.OVER
        self._on_end(self)

    def _follow(self) -> None:
        try:
            problem = self._wait()
        except Exception as error:  # the network can't drive, or a block of a person's own raised
            self._end_work(Phase.OVER)
            problem = message_of(error)
        if problem == STOPPED and self._wish is Phase.PAUSED:
            self.phase = Phase.PAUSED
        else:
            self._end(problem)

    def _wait(self) -> str:
        """Read the folder until the work ends; return the sentence about why it ended early."""
        work = self._work
        assert work is not None  # noqa: S101 - go_on starts it before
        while not work.wait(POLL_S):
            self._read()
        problem = work.problem
        self._read()
        if problem is None:
            return DIED if self._wish is Phase.RUNNING else STOPPED
        return problem

    def _read(self) -> None:
        """Read the folder if there is something new in it."""
        with suppress(OSError, ValidationError):
            written_at = self.run.progress.stat().st_mtime_ns
            if written_at != self._read_at:
                self._read_at = written_at
                text = self.run.progress.read_bytes()
                self.progress = TrainingProgress.model_validate_json(text)
                if self._work is not None:
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
        write_atomically(
            folder / "request.json", msgspec.json.encode(request, enc_hook=packed), mode=0o600
        )
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
