"""Page that shows the policy driving while it learns, in a process of its own.

The training writes its model into a file once, and its weights and progress into others at
intervals, which takes a millisecond. The page's process is
:mod:`ai4u_edu.cli.training_page`.
"""

import subprocess
import sys
import time
from contextlib import suppress
from types import TracebackType
from typing import Self

import torch
from stable_baselines3.common.callbacks import BaseCallback

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.loading import own_files
from ai4u_edu.learn.training.run import Run
from ai4u_edu.locale import gettext as _
from ai4u_edu.runtime.training_progress import CurvePoint, TrainingProgress

DEFAULT_PORT = 8080
MIN_INTERVAL_S = 1.0
"""Shortest time between two files of weights."""
MAX_TIME_SHARE = 0.01
"""Largest share of the training's time that writing weights may take."""


class Watch(BaseCallback):  # type: ignore[misc]  # seen without its types
    """Callback that hands the policy to a page, which stays until :meth:`close`.

    Args:
        port: the page's port; 0 for any free one.
        open_page: True opens it in the browser.
    """

    def __init__(self, port: int = DEFAULT_PORT, *, open_page: bool = True) -> None:
        super().__init__()
        self._options = [str(port), "open" if open_page else ""]
        self._run: Run | None = None
        self._total = 0
        self._page: subprocess.Popen[bytes] | None = None

    def set_training(self, run: Run, total: int) -> None:
        """Choose the training that is shown.

        Args:
            run: its folder.
            total: decisions after which it ends at the latest.
        """
        self.close()
        self._run, self._total = run, total

    def _on_training_start(self) -> None:
        run = self._training
        run.put(run.watched_model, self.model.save)
        self.write_weights()
        # Ctrl-C is for the training; the page ends with it
        self._page = _start_apart(self.command())

    def _on_step(self) -> bool:
        if time.perf_counter() > self._next:
            self.write_weights()
        return True

    def write_weights(self) -> None:
        """Write the current policy's weights and the progress for the page."""
        began = time.perf_counter()
        run, weights = self._training, self.model.policy.state_dict()
        run.put(run.watched_weights, lambda path: torch.save(weights, path))
        self._write_progress(is_over=False)
        ended = time.perf_counter()
        self._next = ended + max(MIN_INTERVAL_S, (ended - began) / MAX_TIME_SHARE)

    def finish(self) -> None:
        """Let the page's agent be driven by the policy that was kept."""
        self._write_progress(is_over=True)

    def command(self) -> list[str]:
        """Return the command that runs the page."""
        blocks = [str(file.absolute()) for file in own_files()]
        folder = str(self._training.folder)
        module = "ai4u_edu.cli.training_page"
        return [sys.executable, "-m", module, folder, *self._options, *blocks]

    def wait(self) -> None:
        """Return when somebody presses Ctrl-C, or the page's process has ended."""
        if self._page is not None:
            with suppress(KeyboardInterrupt):
                self._page.wait()

    def close(self) -> None:
        """End the page's process."""
        if self._page is not None:
            self._page.terminate()
            self._page.wait()
            self._page = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    @property
    def _training(self) -> Run:
        if self._run is None:
            raise SetupError(_("expected a training to watch; give this to train(watch=...)"))
        return self._run

    def _write_progress(self, *, is_over: bool) -> None:
        run = self._training
        curve = tuple(
            CurvePoint(decisions=check.steps, reward=check.reward, success=check.success)
            for check in run.checks()
        )
        progress = TrainingProgress(
            decisions=self.model.num_timesteps, total=self._total, is_over=is_over, curve=curve
        )
        run.put_text(run.progress, progress.model_dump_json())


def _start_apart(command: list[str]) -> subprocess.Popen[bytes]:
    """Start a program that Ctrl-C in this terminal does not reach."""
    if sys.platform == "win32":
        group = subprocess.CREATE_NEW_PROCESS_GROUP
        return subprocess.Popen(command, creationflags=group)  # noqa: S603 - our own module
    return subprocess.Popen(command, start_new_session=True)  # noqa: S603 - our own module
