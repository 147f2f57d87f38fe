"""The process in which a network learns from drives; :class:`Learning` starts it.

It reads a :class:`CloneRequest` as JSON from its input, and writes a line of JSON for each
:class:`CloneNote`: while it learns, and at its end. The network goes into a file.
"""

import sys
from pathlib import Path

import msgspec

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.learn.small.behaviour_cloning import DriveData, clone_drives
from ai4u_edu.learn.small.onnx_file import write_network
from ai4u_edu.learn.training.demonstrations import demonstrations
from ai4u_edu.recording import Episode
from ai4u_edu.recording.player import Player
from ai4u_edu.teach.background import MAX_MEMORY_BYTES, leave_the_processor_to_others
from ai4u_edu.teach.learning import CloneNote, CloneRequest

HELD_OUT_S = 2.0
"""Length (s) of the blocks that are held out if there are few drives."""


def main() -> None:
    """Learn what the input asks for."""
    leave_the_processor_to_others()
    request = msgspec.json.decode(sys.stdin.buffer.read(), type=CloneRequest)
    try:
        for file in request.blocks:
            load_blocks(Path(file))
        _say(_learn(request))
    except AI4UError as error:
        _say(CloneNote(problem=str(error)))
    except MemoryError:
        limit = MAX_MEMORY_BYTES // 2**20
        _say(CloneNote(problem=f"these drives need more than {limit} MB; choose fewer"))


def _learn(request: CloneRequest) -> CloneNote:
    episodes = [Episode.load(path) for path in request.drives]
    shown = demonstrations(episodes, agent=request.agent)
    drives = [
        DriveData(each.observations, each.actions, each.rewards, each.by_person)
        for each in shown.episodes
    ]
    player = Player(episodes[-1])
    agent = player.sim.agent(request.agent)
    decision_s = player.sim.world.dt * (shown.skip_frame + 1)
    result = clone_drives(
        drives,
        shown.observation_space,
        shown.action_space,
        seed=request.seed,
        block=max(1, round(HELD_OUT_S / decision_s)),
        on_error=lambda update, error: _say(CloneNote(update, error)),
    )
    about = {
        "scene": shown.scene.name,
        "algorithm": "clone",
        "seed": request.seed,
        "steps": sum(map(len, drives)),
    }
    write_network(result.network, agent, about, Path(request.out))
    return CloneNote(
        is_done=True,
        decisions=sum(map(len, drives)),
        alike=result.alike,
        commonest=result.commonest,
        held_out=result.held_out,
        remarks=list(result.remarks),
    )


def _say(note: CloneNote) -> None:
    sys.stdout.buffer.write(msgspec.json.encode(note) + b"\n")
    sys.stdout.buffer.flush()


if __name__ == "__main__":
    main()
