"""A network in somebody's file: a process of its own opens it, with limits, before it is kept."""

import subprocess
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec
from msgspec import Struct

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.loading import own_files
from ai4u_edu.scenes import Scene
from ai4u_edu.teach.background import send_request, start_process
from ai4u_edu.teach.network_score import NetworkScore
from ai4u_edu.wire.class_link import MAX_NETWORK_BYTES

ENDING = ".onnx"
MAX_CPU_S = 30
"""Processor time in which a network is loaded, and drives from some starts."""
MAX_WALL_S = 600.0
NO_ANSWER = f"it took more than {MAX_CPU_S} s of processor time, or too much memory"


class OpenRequest(Struct, frozen=True):
    """A network to open, and the agent that it has to fit."""

    file: str
    scene: str
    """Text of the scene."""
    place: str
    """Folder for relative paths in the scene; empty for none."""
    agent: str
    """Id of the agent."""
    blocks: list[str]
    """Python files with blocks that the scene has."""


class OpenNote(Struct, frozen=True):
    """Result of a process that has opened a network."""

    problem: str
    """Sentence about why it can't drive; empty if it can."""
    score: NetworkScore | None = None


def open_network(name: str, data: bytes, scene: Scene, agent: str) -> NetworkScore | None:
    """Check that a network can drive an agent, and return its score; slow.

    Args:
        name: of its file.
        data: the file.
        scene: the scene.
        agent: id of the agent.

    Raises:
        SetupError: it can't; a sentence about why.
    """
    if not name.lower().endswith(ENDING):
        raise SetupError(f"{name}: expected the file of a network ({ENDING})")
    if len(data) > MAX_NETWORK_BYTES:
        raise SetupError(f"{name}: expected at most {MAX_NETWORK_BYTES // 2**20} MB")
    with TemporaryDirectory(prefix="ai4u-edu-") as folder:
        file = Path(folder) / f"network{ENDING}"
        file.write_bytes(data)
        place = "" if scene.folder is None else str(scene.folder)
        blocks = [str(path) for path in own_files()]
        note = _note_of(OpenRequest(str(file), scene.dumps(), place, agent, blocks))
        if note.problem:
            # the path is the server's
            problem = note.problem.replace(str(file), name).replace(file.name, name)
            raise SetupError(f"{name} can't drive this robot: {problem.removeprefix(f'{name}: ')}")
        return note.score


def _note_of(request: OpenRequest) -> OpenNote:
    process = start_process("ai4u_edu.teach.open_process")
    with process:
        with suppress(OSError):  # it has ended already
            send_request(process, request)
        try:
            process.wait(MAX_WALL_S)
        except subprocess.TimeoutExpired:
            process.kill()
        assert process.stdout is not None  # noqa: S101 - start_process asks for the pipe
        last = process.stdout.read()
    try:
        return msgspec.json.decode(last, type=OpenNote)
    except msgspec.DecodeError:
        return OpenNote(NO_ANSWER)
