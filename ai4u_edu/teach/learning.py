"""A network that learns from drives, in a process of its own."""

import tempfile
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path

import msgspec
from msgspec import Struct

from ai4u_edu.blocks.loading import own_files
from ai4u_edu.teach.background import send_request, start_process

STOPPED = "stopped"
DIED = "the program that learns has ended; learn again"


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


class Learning:
    """A network that learns from drives. It begins at once, and never takes time from the world.

    Args:
        drives: files of the drives.
        agent: id of the agent.
        seed: of the network.
        on_done: called in a thread of its own with the network's file, which is gone afterwards.
    """

    def __init__(
        self,
        drives: Sequence[Path],
        agent: str,
        *,
        seed: int,
        on_done: Callable[["Learning", Path], object],
    ) -> None:
        self.agent = agent
        self.drives = len(drives)
        """Count of the drives."""
        self.errors: list[tuple[int, float]] = []
        """Gradient steps, and the error on held-out moments after them."""
        self.note = CloneNote()
        """The latest one; the last one has the result."""
        self._on_done = on_done
        self._is_stopped = False
        self._request = CloneRequest(
            [str(drive) for drive in drives], agent, seed, "", [str(file) for file in own_files()]
        )
        self._process = start_process("ai4u_edu.teach.clone_process")
        threading.Thread(target=self._run, name="teach learning", daemon=True).start()

    @property
    def is_over(self) -> bool:
        """True once it is done or has failed."""
        return self.note.is_done or bool(self.note.problem)

    def stop(self) -> None:
        """End it without a result."""
        self._is_stopped = True
        self._process.kill()

    def _run(self) -> None:
        with tempfile.TemporaryDirectory(prefix="ai4u-edu-teach-") as folder:
            out = Path(folder) / "network.onnx"
            request = msgspec.structs.replace(self._request, out=str(out))
            process = self._process
            with process, suppress(OSError):
                send_request(process, request)
                assert process.stdout is not None  # noqa: S101 - start_process asks for the pipe
                for line in process.stdout:
                    self._hear(msgspec.json.decode(line, type=CloneNote), out)
            if not self.is_over:
                self.note = CloneNote(problem=STOPPED if self._is_stopped else DIED)

    def _hear(self, note: CloneNote, out: Path) -> None:
        if note.update:
            self.errors.append((note.update, note.error))
        self.note = note
        if note.is_done:
            self._on_done(self, out)
