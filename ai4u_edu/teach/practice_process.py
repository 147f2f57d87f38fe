"""The process in which a network practises for rewards; :class:`Practice` starts it.

It reads a :class:`PracticeRequest` as JSON from its input. What it reaches lies in the folder of a
training (:class:`~ai4u_edu.learn.training.run.Run`), and is read there; only the sentence about why
it can't go on comes as JSON.
"""

import sys
from pathlib import Path

import msgspec

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.options import SMALL_TRAINER, load_option
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.learn.training.settings import settings_for
from ai4u_edu.scenes import Scene
from ai4u_edu.teach.background import MAX_MEMORY_BYTES, leave_the_processor_to_others
from ai4u_edu.teach.practice import PracticeEnd, PracticeRequest


def main() -> None:
    """Practise as the input asks for."""
    leave_the_processor_to_others()
    request = msgspec.json.decode(sys.stdin.buffer.read(), type=PracticeRequest)
    problem = ""
    try:
        for file in request.blocks:
            load_blocks(Path(file))
        _practise(request)
    except AI4UError as error:
        problem = str(error)
    except MemoryError:
        problem = f"this needs more than {MAX_MEMORY_BYTES // 2**20} MB"
    sys.stdout.buffer.write(msgspec.json.encode(PracticeEnd(problem)) + b"\n")
    sys.stdout.buffer.flush()


def _practise(request: PracticeRequest) -> None:
    scene = Scene.loads(request.scene, folder=Path(request.place) if request.place else None)
    settings = settings_for(scene.description.name, changes={"agent": request.agent})
    load_option(SMALL_TRAINER, "teaching").train(
        scene,
        settings,
        Path(request.folder),
        steps=request.steps,
        seed=request.seed,
        begin_with=Path(request.begin_with) if request.begin_with else None,
        reward_weights=request.weights,
        against=request.against,
        overwrite=True,
        quiet=True,
    )


if __name__ == "__main__":
    main()
