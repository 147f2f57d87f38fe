"""Progress bar of a training."""

import time
from collections import deque
from typing import Any

import numpy as np
from stable_baselines3.common.callbacks import BaseCallback

from ai4u_edu.learn.training.eval_callback import EvalCallback
from ai4u_edu.learn.training.progress_bar import REFRESH_S, ProgressBar

WINDOW = 100
"""Episodes over which rewards and successes are averaged."""


class ProgressCallback(BaseCallback):  # type: ignore[misc]  # seen without its types
    """Callback that shows steps a second, mean reward, success rate and remaining time.

    Args:
        evaluation: the evaluation callback whose checks are shown.
        until: the step at which the training ends at the latest.
        quiet: True shows nothing.
    """

    def __init__(self, evaluation: EvalCallback, until: int, *, quiet: bool = False) -> None:
        super().__init__()
        self._evaluation = evaluation
        self._until = until
        self._rewards: deque[float] = deque(maxlen=WINDOW)
        self._won: deque[bool] = deque(maxlen=WINDOW)
        self._told = len(evaluation.checks)
        self._quiet = quiet
        self._bar: ProgressBar | None = None

    def _on_training_start(self) -> None:
        self._first = self.num_timesteps
        self._began = self._shown = time.perf_counter()
        self._bar = ProgressBar(self._until, "steps", quiet=self._quiet)

    def _on_step(self) -> bool:
        infos: list[dict[str, Any]] = self.locals["infos"]
        for info in infos:
            episode = info.get("episode")
            if episode:
                self._rewards.append(episode["r"])
                self._won.append(info["is_success"])
        if (
            time.perf_counter() - self._shown > REFRESH_S
            or len(self._evaluation.checks) > self._told
        ):
            self._show()
        return True

    def _on_rollout_end(self) -> None:
        if self._won:
            self.logger.record("rollout/success", float(np.mean(self._won)))

    def _on_training_end(self) -> None:
        self._show()
        self.close()

    def close(self) -> None:
        """Remove the bar."""
        if self._bar is not None:
            self._bar.close()

    def _show(self) -> None:
        if self._bar is None:
            return
        self._shown = time.perf_counter()
        for check in self._evaluation.checks[self._told :]:
            success = "" if check.success is None else f"success {check.success:.0%}, "
            self._bar.note(
                f"after {check.steps} steps, {check.seconds:.0f} s: {success}"
                f"reward {check.reward:.2f} in {check.length:.0f} decisions"
            )
        self._told = len(self._evaluation.checks)
        speed = (self.num_timesteps - self._first) / max(self._shown - self._began, 1e-9)
        reward = f"{np.mean(self._rewards):.2f}" if self._rewards else "-"
        success = f"{np.mean(self._won):.0%}" if self._won else "-"
        self._bar.show(
            min(self.num_timesteps, self._until),
            f"{speed:.0f}/s  reward {reward}  success {success}",
        )
