"""Networks that learn from drives: in a process of this one, or in the class's."""

import tempfile
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import msgspec
from msgspec import Struct

from ai4u_edu.blocks.loading import own_files
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import unpacked
from ai4u_edu.page.editing.editor import ClassTrainings
from ai4u_edu.teach.background import cpu_s, send_request, start_process
from ai4u_edu.teach.messages import LearningState
from ai4u_edu.teach.network_score import NetworkScore

SCORE_DECISIONS = 5_000
"""Decisions with which a network is scored that learned from drives: about a second."""
STOPPED = "stopped"
DIED = _("the program that learns has ended; learn again")
NOT_FINITE = _(
    "its numbers became too large; choose other drives, or give the sensors smaller ranges in Build"
)
LEARNED = "learned"
"""Folder, in that of a class's room, with networks that the room has not taken yet."""
UNREACHABLE = _("The class can't be reached now. It goes on as soon as it can.")


class CloneRequest(Struct, frozen=True):
    """Drives to learn from, and the place for the network."""

    drives: list[str]
    """Files of the episodes."""
    agent: str
    """Id of the agent."""
    seed: int
    out: str
    """File for the network."""
    blocks: list[str] = []
    """Python files with blocks that the scenes have."""
    score_decisions: int = SCORE_DECISIONS
    """Decisions from other starts at most; see :func:`score_network`."""


class CloneNote(Struct, frozen=True, omit_defaults=True):
    """State of a learning."""

    update: int = 0
    """Gradient steps so far."""
    error: float = 0.0
    """Error on held-out moments then."""
    is_done: bool = False
    """True for the last one: the network is in its file."""
    problem: str = ""
    """Sentence about why it can't learn; it is the last one then."""
    decisions: int = 0
    """Decisions that it learned from."""
    alike: float = 0.0
    """Share of held-out moments in which the network acts like the person."""
    commonest: float = 0.0
    """The same share for always doing what was done most often."""
    held_out: int = 0
    """Held-out moments."""
    remarks: list[str] = []
    """Sentences about what is wrong with the drives."""
    score: NetworkScore | None = None


class Learning:
    """A network that learns from drives. It begins at once, and never takes time from the world.

    Args:
        drives: files of the drives.
        agent: id of the agent.
        seed: of the network.
        on_done: called in a thread of its own with the network's file, which is gone afterwards.
        score_decisions: decisions with which the network is scored at most.
    """

    def __init__(
        self,
        drives: Sequence[Path],
        agent: str,
        *,
        seed: int,
        on_done: Callable[["Learning", Path], object],
        score_decisions: int = SCORE_DECISIONS,
    ) -> None:
        self.agent = agent
        self.drives = len(drives)
        """Count of the drives."""
        self.errors: list[tuple[int, float]] = []
        """Gradient steps, and the error on held-out moments after them."""
        self.note = CloneNote()
        """The latest one; the last one has the result."""
        self._on_done = on_done
        self._stopped = ""
        self._request = CloneRequest(
            [str(drive) for drive in drives],
            agent,
            seed,
            "",
            [str(file) for file in own_files()],
            score_decisions,
        )
        self._process = start_process("ai4u_edu.teach.clone_process")

        self._thread = threading.Thread(target=self._run, name="teach learning", daemon=True)
        self._thread.start()

    @property
    def is_over(self) -> bool:
        """True once it is done or has failed."""
        return self.note.is_done or bool(self.note.problem)

    @property
    def is_running(self) -> bool:
        """True until its process has ended and ``on_done`` has returned."""
        return self._thread.is_alive()

    def cpu_s(self) -> float:
        """Return the processor time (s) that it has used; 0 after its end."""
        return cpu_s(self._process)

    def stop(self, why: str = STOPPED) -> None:
        """End it without a result, with a sentence about why."""
        self._stopped = why
        self._process.kill()

    def _run(self) -> None:
        with tempfile.TemporaryDirectory(prefix="ai4u-edu-teach-") as folder:
            out = Path(folder) / "network.onnx"
            request = msgspec.structs.replace(self._request, out=str(out))
            process = self._process
            problem = DIED
            with process, suppress(OSError):
                send_request(process, request)
                assert process.stdout is not None  # noqa: S101 - start_process asks for the pipe
                for line in process.stdout:
                    try:
                        note = msgspec.json.decode(line, type=CloneNote)
                    except msgspec.DecodeError:  # JSON has no word for a number that is not finite
                        problem = NOT_FINITE
                        process.kill()
                        break
                    self._hear(note, out)
            if not self.is_over:
                self.note = CloneNote(problem=self._stopped or problem)

    def _hear(self, note: CloneNote, out: Path) -> None:
        if note.update:
            self.errors.append((note.update, note.error))
        problem, remarks = unpacked(note.problem), [*map(unpacked, note.remarks)]
        self.note = msgspec.structs.replace(note, problem=problem, remarks=remarks)
        if note.is_done:
            self._on_done(self, out)


@dataclass(frozen=True)
class Learned:
    """A network that has learned from drives."""

    scene: str
    """Name of the scene."""
    agent: str
    """Id of the agent."""
    drives: int
    """Count of the drives."""
    decisions: int
    """Decisions that it learned from."""
    alike: float
    """Share of held-out moments in which it acts like the person."""
    held_out: int
    """Held-out moments."""
    score: NetworkScore | None
    network: bytes


class Learner(Protocol):
    """Lets one network at a time learn from drives.

    :attr:`key` and :meth:`state` may be asked for by any thread; the rest belongs to one.
    """

    @property
    def is_busy(self) -> bool:
        """True while a network learns, or waits for that."""

    @property
    def key(self) -> object:
        """Changes, and can be hashed, whenever the answer of :meth:`state` may change."""

    def state(self, scene: str, agent: str) -> LearningState | None:
        """Return the state of the latest learning if it is an agent's; else None.

        Args:
            scene: name of the present scene; a learning that is over is shown in its own only.
            agent: id of the agent.
        """

    def begin(self, scene: str, drives: Sequence[Path], agent: str) -> None:
        """Have a network learn.

        Args:
            scene: name of the scene.
            drives: files of the drives.
            agent: id of the agent.
        """

    def stop(self) -> bool:
        """End the learning without a result; return False if there is none."""

    def collect(self) -> None:
        """Take the networks that have learned, if they are not here already."""

    def close(self) -> None:
        """Let go of what learns, because the world's page ends."""


class LocalLearner:
    """Starts a process for each learning.

    Args:
        on_learned: called with each network, in a thread of its own.
    """

    def __init__(self, on_learned: Callable[[Learned], object]) -> None:
        self._on_learned = on_learned
        self._scene = ""
        """Name of the scene of the latest learning."""
        self._learning: Learning | None = None

    @property
    def is_busy(self) -> bool:
        """True while a network learns."""
        return self._learning is not None and not self._learning.is_over

    @property
    def key(self) -> object:
        """Changes with each note of the process."""
        learning = self._learning
        return None if learning is None else (learning, len(learning.errors), learning.is_over)

    def state(self, scene: str, agent: str) -> LearningState | None:
        """Return the state of the latest learning if it is an agent's; else None."""
        learning = self._learning
        if learning is None or learning.agent != agent:
            return None
        if learning.is_over and self._scene != scene:
            return None
        note = learning.note
        return LearningState(
            is_over=learning.is_over,
            problem=note.problem,
            waiting="",
            errors=[round(error, 4) for _, error in learning.errors],
            drives=learning.drives,
            decisions=note.decisions,
            alike=round(note.alike, 3),
            commonest=round(note.commonest, 3),
            remarks=list(note.remarks),
        )

    def begin(self, scene: str, drives: Sequence[Path], agent: str) -> None:
        """Start a process that learns."""

        def on_done(learning: Learning, out: Path) -> None:
            note = learning.note
            network = out.read_bytes()
            about = learning.drives, note.decisions, note.alike, note.held_out, note.score
            self._on_learned(Learned(scene, agent, *about, network))

        self._scene = scene
        self._learning = Learning(drives, agent, seed=0, on_done=on_done)

    def stop(self) -> bool:
        """End the process; return False if there is none."""
        learning = self._learning
        if learning is None or learning.is_over:
            return False
        learning.stop()
        return True

    def collect(self) -> None:
        """Do nothing: a network comes at once."""

    def close(self) -> None:
        """End the process."""
        self.stop()


class ClassLearner:
    """Asks the class for each learning: a room on its machine may start no process.

    Args:
        trainings: of the class.
        folder: of the room's drives and networks, which the class's process has, too.
        on_learned: called with each network in the thread of :meth:`collect`; returns False if it
            could not be kept. Then it is offered again with the next call.
    """

    def __init__(
        self, trainings: ClassTrainings, folder: Path, on_learned: Callable[[Learned], bool]
    ) -> None:
        self._trainings, self._folder, self._on_learned = trainings, folder, on_learned

    @property
    def is_busy(self) -> bool:
        """True while a network learns, or waits for its turn."""
        latest = self._trainings.latest
        return latest is not None and not latest.is_over

    @property
    def key(self) -> object:
        """Changes with each message of the class."""
        return self._trainings.latest, self._trainings.is_connected

    def state(self, scene: str, agent: str) -> LearningState | None:
        """Return the state of the latest learning if it is an agent's; else None."""
        latest = self._trainings.latest
        if latest is None or latest.agent != agent:
            return None
        if latest.is_over and latest.scene != scene:
            return None
        waiting = _("Your place in the line: {place}.", place=latest.place) if latest.place else ""
        if not latest.is_over and not self._trainings.is_connected:
            waiting = UNREACHABLE
        return LearningState(
            is_over=latest.is_over,
            problem=latest.problem,
            waiting=waiting,
            errors=[round(error, 4) for error in latest.errors],
            drives=latest.drives,
            decisions=latest.decisions,
            alike=round(latest.alike, 3),
            commonest=round(latest.commonest, 3),
            remarks=[*latest.remarks],
        )

    def begin(self, scene: str, drives: Sequence[Path], agent: str) -> None:
        """Ask the class to let a network learn.

        Raises:
            SetupError: a name is too long to be sent.
        """
        self._trainings.learn(scene, agent, [drive.name for drive in drives])

    def stop(self) -> bool:
        """Ask the class to end the learning; return False if there is none."""
        is_busy = self.is_busy
        if is_busy:
            self._trainings.stop(STOPPED)
        return is_busy

    def collect(self) -> None:
        """Take the network that the class has put into the room's folder, if there is one."""
        latest = self._trainings.latest
        if latest is None or not latest.is_done:
            return
        path = self._folder / LEARNED / f"{latest.key}.onnx"
        with suppress(FileNotFoundError):  # it was taken before
            network = path.read_bytes()
            about = latest.drives, latest.decisions, latest.alike, latest.held_out
            score = None
            if latest.starts:
                has_all = latest.has_all_starts
                score = NetworkScore.of(latest.successes, latest.starts, has_all=has_all)
            learned = Learned(latest.scene, latest.agent, *about, score, network)
            if self._on_learned(learned):
                path.unlink()

    def close(self) -> None:
        """Do nothing: the class goes on, and the next process of the room takes the network."""
