"""The process in which a network learns from drives; :class:`Learning` starts it.

It reads a :class:`CloneRequest` as JSON from its input, and writes a line of JSON for each
:class:`CloneNote`: while it learns, and at its end. The network goes into a file.
"""

import sys
from pathlib import Path

import msgspec

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.base.options import SMALL_TRAINER, load_option
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import packed
from ai4u_edu.recording import Episode
from ai4u_edu.scenes import Scene
from ai4u_edu.teach.background import MAX_MEMORY_BYTES, leave_the_processor_to_others
from ai4u_edu.teach.learning import CloneNote, CloneRequest
from ai4u_edu.teach.network_score import score_network


def main() -> None:
    """Learn what the input asks for."""
    leave_the_processor_to_others()
    request = msgspec.json.decode(sys.stdin.buffer.read(), type=CloneRequest)
    try:
        for file in request.blocks:
            load_blocks(Path(file))
        _say(_learn(request))
    except AI4UError as error:
        _say(CloneNote(problem=text_of(error)))
    except MemoryError:
        limit = MAX_MEMORY_BYTES // 2**20
        _say(
            CloneNote(
                problem=_("these drives need more than {limit} MB; choose fewer", limit=limit)
            )
        )


def _learn(request: CloneRequest) -> CloneNote:
    drives = [Episode.load(path) for path in request.drives]
    scene = Scene(drives[-1].scene)
    result = load_option(SMALL_TRAINER, "teaching").clone(
        drives,
        Path(request.out),
        agent=request.agent,
        seed=request.seed,
        persons_only=True,
        on_error=lambda update, error: _say(CloneNote(update, error)),
        quiet=True,
    )
    out = Path(request.out)
    return CloneNote(
        is_done=True,
        decisions=result.decisions,
        alike=result.alike,
        commonest=result.commonest,
        held_out=result.held_out,
        remarks=list(result.remarks),
        score=score_network(scene, request.agent, out, request.score_decisions),
    )


def _say(note: CloneNote) -> None:
    sys.stdout.buffer.write(msgspec.json.encode(note, enc_hook=packed) + b"\n")
    sys.stdout.buffer.flush()


if __name__ == "__main__":
    main()
