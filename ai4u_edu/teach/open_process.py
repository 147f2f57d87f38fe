"""The process in which a network of somebody is opened, for :func:`open_network`.

It reads an :class:`OpenRequest` as JSON from its input, and writes an :class:`OpenNote`.
"""

import sys
from pathlib import Path

import msgspec

from ai4u_edu.base.errors import AI4UError, BlockError, text_of
from ai4u_edu.blocks import LocalBrain, NeuralNetController
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.locale import Text, packed
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene
from ai4u_edu.teach.background import MAX_MEMORY_BYTES, leave_the_processor_to_others
from ai4u_edu.teach.network_score import score_network
from ai4u_edu.teach.opened_network import FILE, MAX_CPU_S, OpenNote, OpenRequest

DECISIONS = 20
"""Decisions that it takes before it is scored, since not each scene has a goal."""
SCORE_DECISIONS = 10_000
"""Decisions with which it is scored at most."""


def main() -> None:
    """Open what the input names."""
    leave_the_processor_to_others()
    _limit_processor_time()
    request = msgspec.json.decode(sys.stdin.buffer.read(), type=OpenRequest)
    try:
        for file in request.blocks:
            load_blocks(Path(file))
        note = _open(request)
    except AI4UError as error:
        problem = error.problem if isinstance(error, BlockError) else ""
        note = OpenNote(_named(problem or text_of(error), request))
    except MemoryError:
        note = OpenNote(
            _(
                "it needs more than {size} MB",
                size=MAX_MEMORY_BYTES // 2**20,
            )
        )
    sys.stdout.buffer.write(msgspec.json.encode(note, enc_hook=packed) + b"\n")


def _named(text: str, request: OpenRequest) -> str:
    """Return a message with the network's name in place of the server's file."""
    if not isinstance(text, Text):
        return text.replace(request.file, request.name).replace(FILE, request.name)
    values = {
        name: _named(value, request) if isinstance(value, str) else value
        for name, value in text.values.items()
    }
    return Text(text.msgid, values, text.plural, text.number, text.is_sentence, text.domain)


def _limit_processor_time() -> None:
    """Have the system kill this process once it has used its time."""
    if sys.platform != "win32":
        import resource

        _, hard = resource.getrlimit(resource.RLIMIT_CPU)
        resource.setrlimit(resource.RLIMIT_CPU, (MAX_CPU_S, hard))


def _open(request: OpenRequest) -> OpenNote:
    scene = Scene.loads(request.scene, folder=Path(request.place) if request.place else None)
    controller = NeuralNetController(model_path=request.file)
    brain = LocalBrain(controller=controller, **controller.network.rhythm)
    sim = scene.build(brains=lambda agent: brain if agent.id == request.agent else None)
    sim.reset(0)
    agent = sim.agent(request.agent)
    for _number in range(DECISIONS):
        sim.step(agent)
        if agent.done:
            break
    path = Path(request.file)
    return OpenNote("", score_network(scene, request.agent, path, SCORE_DECISIONS))


if __name__ == "__main__":
    main()
