"""Page that shows the policy driving while it learns, in a process of its own.

The training writes its model into a file once, and its weights into another one at intervals, which
takes a millisecond. The page's process has a world of its own, drives in it with the latest
weights, and runs at low priority.
"""

import os
import subprocess
import sys
import threading
import time
from copy import deepcopy
from pathlib import Path

import torch
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.callbacks import BaseCallback

from ai4u_edu.blocks.loading import load_blocks, own_files
from ai4u_edu.training.run import Run

MIN_INTERVAL_S = 3.0
"""Shortest time between two files of weights."""
MAX_TIME_SHARE = 0.01
"""Largest share of the training's time that writing weights may take."""
RELOAD_POLL_S = 0.5
"""Interval at which the page looks for new weights."""
MODEL = "watched.zip"
"""File of the untrained model in the training's folder."""
WEIGHTS = "watched.pt"
"""File of the policy's latest weights."""


class Watch(BaseCallback):  # type: ignore[misc]  # seen without its types
    """Callback that hands the policy to a page.

    Args:
        run: the training's folder.
        port: the page's port; 0 for any free one.
        open_page: True opens it in the browser.
    """

    def __init__(self, run: Run, *, port: int = 8080, open_page: bool = True) -> None:
        super().__init__()
        self._run = run
        self._arguments = [str(run.folder), str(port), "open" if open_page else ""]
        self._page: subprocess.Popen[bytes] | None = None

    def _on_training_start(self) -> None:
        self._run.put(self._run.folder / MODEL, self.model.save)
        self.write_weights()
        # Ctrl-C is for the training; the page ends with it
        self._page = subprocess.Popen(  # noqa: S603 - our own module
            self.command(), start_new_session=True
        )

    def _on_step(self) -> bool:
        if time.perf_counter() > self._next:
            self.write_weights()
        return True

    def write_weights(self) -> None:
        """Write the current policy's weights for the page."""
        began = time.perf_counter()
        weights = self.model.policy.state_dict()
        self._run.put(self._run.folder / WEIGHTS, lambda path: torch.save(weights, path))
        ended = time.perf_counter()
        self._next = ended + max(MIN_INTERVAL_S, (ended - began) / MAX_TIME_SHARE)

    def command(self) -> list[str]:
        """Return the command that runs the page."""
        blocks = [str(file.absolute()) for file in own_files()]
        return [sys.executable, "-m", "ai4u_edu.training.watch", *self._arguments, *blocks]

    def close(self) -> None:
        """End the page's process."""
        if self._page is not None:
            self._page.terminate()
            self._page.wait()
            self._page = None


def show(folder: Path, port: int, *, open_page: bool) -> None:
    """Serve the page until somebody ends it; use another port if that one is taken."""
    from ai4u_edu.blocks import LocalBrain
    from ai4u_edu.panel import PanelSockets
    from ai4u_edu.runtime.runner import Runner
    from ai4u_edu.server import (
        PortTakenError,
        lock_viser_port,
        open_on_desktop,
        room_app,
        serve,
    )
    from ai4u_edu.training.algorithms import load_model
    from ai4u_edu.training.policies import driver_of
    from ai4u_edu.training.prepare import prepare
    from ai4u_edu.viewer import Viewer

    run = Run(folder)
    config = run.config()
    settings = config.settings
    scene = prepare(run.scene(), settings)
    sim = scene.build()
    agent = sim.agent(settings.agent) if settings.agent else sim.agents[0]
    model = load_model(config.algorithm, folder / MODEL)
    drive = driver_of(config, agent, lambda: model)
    agent.use_brain(LocalBrain(controller=drive, skip_frame=agent.brain.skip_frame))
    title = f"{scene.description.title or scene.description.name}, learning"
    runner = Runner(sim)
    viewer = Viewer(runner, title=title)
    lock_viser_port(viewer.server)
    panel = PanelSockets(runner, viewer)
    room = room_app(runner, viser_port=viewer.port, title=title, panel=panel)

    def ready(url: str) -> None:
        sys.stderr.write(f"watch it learn at {url}\n")
        sys.stderr.flush()
        if open_page:
            open_on_desktop(url)

    ended = threading.Event()
    runner.start()
    viewer.start()
    reloader = threading.Thread(
        target=_reload_weights, args=(model, folder / WEIGHTS, ended), name="weights", daemon=True
    )
    reloader.start()
    try:
        try:
            serve(room, "127.0.0.1", port, on_ready=ready)
        except PortTakenError:
            serve(room, "127.0.0.1", 0, on_ready=ready)
    finally:
        ended.set()
        runner.stop()
        viewer.stop()


def _reload_weights(model: BaseAlgorithm, weights: Path, ended: threading.Event) -> None:
    """Replace the model's policy whenever the training has written new weights."""
    loaded_at = 0
    while not ended.wait(RELOAD_POLL_S):
        written_at = weights.stat().st_mtime_ns
        if written_at != loaded_at:
            loaded_at = written_at
            policy = deepcopy(model.policy)  # the old one decides until this one is complete
            policy.load_state_dict(torch.load(weights, weights_only=True))
            model.policy = policy


if __name__ == "__main__":
    if hasattr(os, "nice"):
        os.nice(19)
    for file in sys.argv[4:]:
        load_blocks(Path(file))
    show(Path(sys.argv[1]), int(sys.argv[2]), open_page=sys.argv[3] == "open")
    from ai4u_edu.server.process_exit import HAS_SERVED, end_process

    HAS_SERVED.set()
    end_process(0)
