"""A network in somebody's file: a process of its own opens it, with limits, before it is kept."""

from collections.abc import Callable
from pathlib import Path

import msgspec
from msgspec import Struct

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.loading import own_files
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import packed, unpacked
from ai4u_edu.scenes import Scene
from ai4u_edu.teach.network_score import NetworkScore
from ai4u_edu.teach.tasks import REQUEST, TaskWork
from ai4u_edu.wire.class_link import MAX_NETWORK_BYTES

ENDING = ".onnx"
MAX_CPU_S = 30
"""Processor time in which a network is loaded, and drives from some starts."""
MAX_WALL_S = 600.0
FILE = f"network{ENDING}"
"""Name of the network in the folder of its task."""
NO_ANSWER = _("it took more than {limit} s of processor time, or too much memory", limit=MAX_CPU_S)


class OpenRequest(Struct, frozen=True):
    """A network to open, and the agent that it has to fit."""

    file: str
    name: str
    """Name of the file where it comes from, for sentences."""
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


def open_network(
    name: str,
    data: bytes,
    scene: Scene,
    agent: str,
    *,
    folder: Path,
    start: Callable[[OpenRequest], TaskWork],
) -> NetworkScore | None:
    """Check that a network can drive an agent, and return its score; slow.

    Args:
        name: of its file.
        data: the file.
        scene: the scene.
        agent: id of the agent.
        folder: folder of the task; it is there, and empty.
        start: begins the task.

    Raises:
        SetupError: it can't; a sentence about why.
        OSError: the folder can't be written to.
    """
    if not name.lower().endswith(ENDING):
        raise SetupError(
            _("{name}: expected the file of a network ({ending})", name=name, ending=ENDING)
        )
    if len(data) > MAX_NETWORK_BYTES:
        raise SetupError(
            _(
                "{name}: expected at most {size} MB",
                name=name,
                size=MAX_NETWORK_BYTES // 2**20,
            )
        )
    file = folder / FILE
    file.write_bytes(data)
    place = "" if scene.folder is None else str(scene.folder)
    blocks = [str(path) for path in own_files()]
    request = OpenRequest(str(file), name, scene.dumps(), place, agent, blocks)
    (folder / REQUEST).write_bytes(msgspec.json.encode(request, enc_hook=packed))
    work, last = start(request), b""
    for lines in work.notes():
        last = lines[-1] if lines else b""
    try:
        note = msgspec.json.decode(last, type=OpenNote)
    except msgspec.DecodeError:
        note = OpenNote(work.problem or NO_ANSWER)
    if note.problem:
        raise SetupError(
            _("{name} can't drive this robot: {problem}", name=name, problem=unpacked(note.problem))
        )
    return note.score
