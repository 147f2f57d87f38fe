"""The process in which values of a number are tried, for :class:`Tries`.

It reads a :class:`TryRequest` as JSON from its input, and writes a line of JSON for each
:class:`TryNote`: while it drives, and after each value.
"""

import sys
from pathlib import Path

import msgspec

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.games.jobs import engine
from ai4u_edu.learn.training.varying import parameter_named, try_values
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import packed
from ai4u_edu.scenes import Scene
from ai4u_edu.teach.background import MAX_MEMORY_BYTES, leave_the_processor_to_others
from ai4u_edu.teach.tries import TryNote, TryRequest


def main() -> None:
    """Try what the input asks for."""
    leave_the_processor_to_others()
    request = msgspec.json.decode(sys.stdin.buffer.read(), type=TryRequest)
    try:
        for file in request.blocks:
            load_blocks(Path(file))
        _try(request)
    except AI4UError as error:
        _say(TryNote(problem=text_of(error)))
    except MemoryError:
        _say(
            TryNote(
                problem=_(
                    "this needs more than {size} MB",
                    size=MAX_MEMORY_BYTES // 2**20,
                )
            )
        )


def _try(request: TryRequest) -> None:
    scene = Scene.loads(request.scene, folder=Path(request.place) if request.place else None)
    parameter = parameter_named(scene, request.parameter)
    with engine("inline") as running:
        for value in request.values:
            (row,) = try_values(
                scene,
                parameter,
                [value],
                range(request.starts),
                running,
                agent=request.agent,
                tell=lambda episodes: _say(TryNote(done=episodes)),
            )
            _say(TryNote(row=row))


def _say(note: TryNote) -> None:
    sys.stdout.buffer.write(msgspec.json.encode(note, enc_hook=packed) + b"\n")
    sys.stdout.buffer.flush()


if __name__ == "__main__":
    main()
