"""Shows the policy driving in the browser while it learns: in a process of its own.

The training writes its network into a file now and then; the other process drives with it in a
world of its own, and takes the next one when it is there. It waits where the training wants the
processor.
"""

import os
import subprocess
import sys
import threading
import time
from pathlib import Path

from stable_baselines3.common.callbacks import BaseCallback

from ai4u_edu.training.export import Exported
from ai4u_edu.training.run import Config, Run

OFTEN = 3.0
"""Seconds between two networks."""
NETWORK = "watched.onnx"
"""The network's file in the training's folder."""


class Watch(BaseCallback):  # type: ignore[misc]  # seen without its types
    """Hands the policy to a page.

    Args:
        run: of the training.
        config: how it was set up.
        port: of the page; 0 for any free one.
        open_page: whether to open it in the browser.
    """

    def __init__(
        self, run: Run, config: Config, *, port: int = 8080, open_page: bool = True
    ) -> None:
        super().__init__()
        self._run = run
        self._config = config
        self._arguments = [str(run.folder), str(port), "open" if open_page else ""]
        self._exported: Exported | None = None
        self._page: subprocess.Popen[bytes] | None = None

    def _on_training_start(self) -> None:
        self.hand_on()
        # Ctrl-C is for the training; the page ends with it
        self._page = subprocess.Popen(  # noqa: S603 - our own module
            self.command(), start_new_session=True
        )

    def _on_step(self) -> bool:
        if time.perf_counter() - self._written > OFTEN:
            self.hand_on()
        return True

    def hand_on(self) -> None:
        """Writes the policy as it is now to where the page looks for it."""
        if self._exported is None:
            self._exported = Exported(self.model, self._run.scene(), self._config)
        else:
            self._exported.refresh()
        self._exported.write(self._run.folder / NETWORK)
        self._written = time.perf_counter()

    def command(self) -> list[str]:
        """What runs the page."""
        return [sys.executable, "-m", "ai4u_edu.training.watch", *self._arguments]

    def close(self) -> None:
        """Ends the page."""
        if self._page is not None:
            self._page.terminate()
            self._page.wait()
            self._page = None


def show(folder: Path, port: int, *, open_page: bool) -> None:
    """Serves the page until somebody ends it."""
    from ai4u_edu.blocks import LocalBrain, NeuralNetController
    from ai4u_edu.runner import Runner
    from ai4u_edu.server import open_on_desktop, room_app, serve, shut_side_door
    from ai4u_edu.training.prepare import prepare
    from ai4u_edu.viewer import Viewer

    run = Run(folder)
    settings = run.config().settings
    scene = prepare(run.scene(), settings)
    sim = scene.build()
    agent = sim.agent(settings.agent) if settings.agent else sim.agents[0]
    network = folder / NETWORK
    controller = NeuralNetController(model_path=str(network.absolute()))
    agent.use_brain(LocalBrain(controller=controller, skip_frame=agent.brain.skip_frame))
    title = f"{scene.description.title or scene.description.name}, learning"
    runner = Runner(sim)
    viewer = Viewer(runner, title=title)
    shut_side_door(viewer.server)
    room = room_app(runner, viser_port=viewer.port, title=title)

    def ready(url: str) -> None:
        sys.stderr.write(f"watch it learn at {url}\n")
        sys.stderr.flush()
        if open_page:
            open_on_desktop(url)

    ended = threading.Event()

    def renew() -> None:
        seen = network.stat().st_mtime_ns
        while not ended.wait(0.5):
            now = network.stat().st_mtime_ns
            if now != seen:
                seen = now
                runner.submit(controller.reload)

    runner.start()
    viewer.start()
    threading.Thread(target=renew, name="renew", daemon=True).start()
    try:
        serve(room, "127.0.0.1", port, on_ready=ready)
    finally:
        ended.set()
        viewer.stop()
        runner.stop()


if __name__ == "__main__":
    if hasattr(os, "nice"):
        os.nice(10)
    show(Path(sys.argv[1]), int(sys.argv[2]), open_page=sys.argv[3] == "open")
