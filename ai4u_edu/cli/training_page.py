"""Process of the page of a training: ``python -m ai4u_edu.cli.training_page``.

It has a world of its own, drives in it with the latest weights, and runs at low priority. It ends
with the training's process.
"""

import os
import sys
import threading
from collections.abc import Callable
from copy import deepcopy
from pathlib import Path

import psutil
import torch
from stable_baselines3.common.base_class import BaseAlgorithm

from ai4u_edu.base.process_signals import ask_to_end, has_ended
from ai4u_edu.blocks import LocalBrain, Percept
from ai4u_edu.blocks.brains.brain import Answer, Command
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.learn.training.algorithms import load_model
from ai4u_edu.learn.training.policies import driver_of
from ai4u_edu.learn.training.prepare import prepare
from ai4u_edu.learn.training.run import Run
from ai4u_edu.page.server import PortTakenError, open_on_desktop, serve
from ai4u_edu.page.server.process_exit import HAS_SERVED, end_process
from ai4u_edu.room import serve_world
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.runtime.training_progress import TrainingProgress

RELOAD_POLL_S = 0.5
"""Interval at which the page looks for new weights."""


class LatestModel:
    """Model of a training with the weights that it wrote last; a thread of its own reads them.

    Args:
        run: the training's folder.
    """

    def __init__(self, run: Run) -> None:
        self._run = run
        self._algorithm = run.config().algorithm
        self.model: BaseAlgorithm = load_model(self._algorithm, run.watched_model)
        self.progress = self._read_progress()
        self._loaded_at = 0

    def refresh(self) -> None:
        """Read what is new; once the training is over, the model that it kept."""
        if self.progress.is_over:
            return
        progress = self._read_progress()
        if progress.is_over:
            self.model = load_model(self._algorithm, self._run.best)
        else:
            self._refresh_weights()
        self.progress = progress

    def _refresh_weights(self) -> None:
        weights = self._run.watched_weights
        written_at = weights.stat().st_mtime_ns
        if written_at != self._loaded_at:
            self._loaded_at = written_at
            policy = deepcopy(self.model.policy)  # the old one decides until this one is complete
            policy.load_state_dict(torch.load(weights, weights_only=True))
            self.model.policy = policy

    def _read_progress(self) -> TrainingProgress:
        return TrainingProgress.model_validate_json(self._run.progress.read_bytes())


def show(run: Run, port: int, *, open_page: bool) -> None:
    """Serve the page until somebody ends it; use another port if that one is taken."""
    settings = run.config().settings
    scene = prepare(run.scene(), settings)
    sim = scene.build()
    agent = sim.agent(settings.agent) if settings.agent else sim.agents[0]
    latest = LatestModel(run)
    drive = driver_of(run.config(), agent, lambda: latest.model)
    agent.use_brain(LocalBrain(controller=going_on(drive), skip_frame=agent.brain.skip_frame))
    title = f"{scene.description.title or scene.description.name}, learning"
    runner = Runner(sim)
    runner.training = latest.progress
    page = serve_world(runner, title=title, port=None)

    def ready(url: str) -> None:
        sys.stderr.write(f"watch it learn at {url}\n")
        sys.stderr.flush()
        if open_page:
            open_on_desktop(url)

    ended = threading.Event()
    runner.start()
    reloader = threading.Thread(
        target=_refresh, args=(latest, runner, ended), name="weights", daemon=True
    )
    reloader.start()
    try:
        try:
            serve(page.app, "127.0.0.1", port, on_ready=ready)
        except PortTakenError:
            serve(page.app, "127.0.0.1", 0, on_ready=ready)
    finally:
        ended.set()
        runner.stop()
        page.stop()


def going_on(drive: Callable[[Percept], Answer]) -> Callable[[Percept], Answer]:
    """Return a driver that begins the next episode when one is over."""
    return lambda percept: Command.RESTART if percept["done"] else drive(percept)


def _refresh(latest: LatestModel, runner: Runner, ended: threading.Event) -> None:
    """Show the training's latest state; end this process with the training's."""
    parent = psutil.Process().parent()
    while not ended.wait(RELOAD_POLL_S):
        latest.refresh()
        runner.training = latest.progress
        if has_ended(parent):  # it ended without a word to this process
            ask_to_end()
            return


if __name__ == "__main__":
    if hasattr(os, "nice"):
        os.nice(19)
    folder, wanted_port, opens, *own = sys.argv[1:]
    for file in own:
        load_blocks(Path(file))
    show(Run(Path(folder)), int(wanted_port), open_page=opens == "open")
    HAS_SERVED.set()
    end_process(0)
