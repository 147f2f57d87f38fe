"""The process in which a network practises for rewards; :class:`Practice` starts it.

It reads a :class:`PracticeRequest` as JSON from its input. What it reaches lies in the folder of a
training (:class:`~ai4u_edu.learn.training.run.Run`), and is read there; only the sentence about why
it can't go on comes as JSON.
"""

import os
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from types import FrameType

import msgspec

from ai4u_edu.agent.block_frames import calls_of_error, calls_of_thread, find_place
from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import AI4UError, shorten, text_of
from ai4u_edu.base.options import SMALL_TRAINER, load_option
from ai4u_edu.blocks import LocalBrain, NeuralNetController
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.learn.training.run import Run
from ai4u_edu.learn.training.settings import settings_for
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import packed
from ai4u_edu.recording import Recorder
from ai4u_edu.recording.episode import encode
from ai4u_edu.runtime.tick_monitor import Stall
from ai4u_edu.runtime.training_progress import TrainingProgress
from ai4u_edu.scenes import Scene
from ai4u_edu.teach.background import MAX_MEMORY_BYTES, leave_the_processor_to_others
from ai4u_edu.teach.network_score import score_network
from ai4u_edu.teach.practice import SCORE, PracticeEnd, PracticeRequest

SCORE_DECISIONS = 100_000
"""Decisions with which the network is scored at most."""
MAX_CALL_S = 20.0
"""Longest time that a call of a person's own block may take."""
CALL_POLL_S = 1.0
"""Interval at which such calls are looked for."""
MAX_ERROR_CHARS = 500

REPLAYS = 10
"""Parts of a practice, after each of which an episode is kept."""
REPLAY_SEED = 1
"""Seed of these episodes, so that all have the same start."""
MAX_REPLAY_DECISIONS = 1000


def main() -> None:
    """Practise as the input asks for."""
    leave_the_processor_to_others()
    request = msgspec.json.decode(sys.stdin.buffer.read(), type=PracticeRequest)
    watch = threading.Thread(
        target=_end_if_stalled,
        args=(threading.get_ident(), frozenset(request.blocks)),
        name="stall watch",
        daemon=True,
    )
    watch.start()
    problem = ""
    try:
        for file in request.blocks:
            load_blocks(Path(file))
        _practise(request)
    except AI4UError as error:
        problem = text_of(error)
    except MemoryError:
        problem = _("this needs more than {size} MB", size=MAX_MEMORY_BYTES // 2**20)
    except (Exception, SystemExit) as error:  # a block of a person's own may raise anything
        place = find_place(calls_of_error(error.__traceback__))
        text = f"{type(error).__name__}: {shorten(str(error), MAX_ERROR_CHARS)}"
        what = _("{place} failed: {problem}", place=str(place), problem=text)
        problem = _("{problem} ({where})", problem=what, where=place.where) if place.where else what
    _say(PracticeEnd(problem))


def _practise(request: PracticeRequest) -> None:
    scene = Scene.loads(request.scene, folder=Path(request.place) if request.place else None)
    trainer = load_option(SMALL_TRAINER, "teaching")
    folder = Path(request.folder)
    replays = _Replays(folder.parent / "replays", scene, request)
    run = Run(folder)
    if run.state.is_file():
        # a process that was killed at its very end leaves nothing to learn
        if not _progress_of(run).is_over:
            trainer.resume(folder, scene=scene, on_round=replays.after_round, quiet=True)
    else:
        trainer.train(
            scene,
            settings_for(scene.description.name, changes={"agent": request.agent}),
            folder,
            steps=request.steps,
            seed=request.seed,
            begin_with=Path(request.begin_with) if request.begin_with else None,
            reward_weights=request.weights,
            against=request.against,
            overwrite=True,
            on_round=replays.after_round,
            quiet=True,
        )
    # the last one is of the network that is kept
    replays.keep(run.best_network, _progress_of(run).decisions)
    if not request.against:  # else the checks were games
        score = score_network(scene, request.agent, run.best_network, SCORE_DECISIONS)
        write_atomically(
            folder.parent / SCORE, msgspec.json.encode(score, enc_hook=packed), mode=0o600
        )


def _progress_of(run: Run) -> TrainingProgress:
    return TrainingProgress.model_validate_json(run.progress.read_bytes())


class _Replays:
    """Keeps episodes of one start: how the network drives after each tenth of a practice.

    Args:
        folder: for the episodes.
        scene: the scene.
        request: of the practice.
    """

    def __init__(self, folder: Path, scene: Scene, request: PracticeRequest) -> None:
        self._folder, self._scene, self._request = folder, scene, request
        folder.mkdir(exist_ok=True)
        self._kept = len(list(folder.glob("*.episode")))

    def after_round(self, decisions: int, write: Callable[[Path], object]) -> None:
        """Keep an episode of the network that ``write`` writes, if one is due."""
        if decisions * REPLAYS < self._request.steps * self._kept:
            return
        network = self._folder / "network.onnx"
        write(network)
        self.keep(network, decisions)

    def keep(self, network: Path, decisions: int) -> None:
        """Keep an episode that a network drives.

        Args:
            network: its file.
            decisions: those that it has learned from.
        """
        controller = NeuralNetController(model_path=str(network.absolute()))
        brain = LocalBrain(controller=controller, **controller.network.rhythm)
        name = self._request.agent
        sim = self._scene.build(brains=lambda agent: brain if agent.id == name else None)
        if against := self._request.against:
            trainer = load_option(SMALL_TRAINER, "teaching")
            trainer.seat_opponents(sim, self._scene, name, against, network.absolute())
        recorder = Recorder(sim, scene=self._scene.description)
        agent = sim.agent(name)
        sim.reset(REPLAY_SEED)
        for _number in range(MAX_REPLAY_DECISIONS):
            sim.step()
            if agent.done:
                break
        recorder.finish()
        path = self._folder / f"{decisions:09}.episode"
        write_atomically(path, encode(recorder.episodes[-1]), mode=0o600)
        self._kept += 1


def _end_if_stalled(thread: int, own_files: frozenset[str]) -> None:
    """End the process when a call of a person's own code in a thread does not return."""
    call: FrameType | None = None
    since = 0.0
    while True:
        time.sleep(CALL_POLL_S)
        calls = calls_of_thread(thread)
        own = (frame for frame, _ in calls if frame.f_code.co_filename in own_files)
        before, call = call, next(own, None)
        if call is None or call is not before:
            since = time.monotonic()
        elif time.monotonic() - since > MAX_CALL_S:
            stall = Stall(since, time.monotonic() - since, find_place(calls))
            _say(PracticeEnd(_("{stall}; it may be in an endless loop", stall=str(stall))))
            os._exit(1)


def _say(end: PracticeEnd) -> None:
    sys.stdout.buffer.write(msgspec.json.encode(end, enc_hook=packed) + b"\n")
    sys.stdout.buffer.flush()


if __name__ == "__main__":
    main()
