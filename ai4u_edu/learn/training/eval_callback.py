"""Stable-Baselines3 callback: evaluates the policy, keeps the best, stops when good enough."""

import time
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.callbacks import BaseCallback

from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.learn.training.episode import EpisodeStats
from ai4u_edu.learn.training.run import Check, Run
from ai4u_edu.learn.training.settings import Settings
from ai4u_edu.learn.training.worlds import ABOVE

FIRST_SEED = 2 * ABOVE
"""First seed of the checks' episodes; neither trainings nor evaluations use them."""


class EvalCallback(BaseCallback):  # type: ignore[misc]  # seen without its types
    """Callback that checks the policy at regular intervals.

    Args:
        run: the folder that keeps the best model.
        scene_env: makes a world to check in.
        settings: number of episodes, and when to stop.
        table: the actions, where the model chooses them by number.
        every: decisions between two checks.
        has_goal: True if the scene defines a success.
        keep_checkpoints: True keeps the model of each check.
        stop: called with all checks after each one; True ends the training.
    """

    def __init__(
        self,
        run: Run,
        scene_env: Callable[[], SceneEnv],
        settings: Settings,
        *,
        table: npt.NDArray[np.float32] | None,
        every: int,
        has_goal: bool,
        keep_checkpoints: bool = False,
        stop: Callable[[Sequence[Check]], bool] | None = None,
    ) -> None:
        super().__init__()
        self.checks = run.checks()
        self.enough = False
        """Whether the last checks saw nothing but success."""
        self._run = run
        self._settings = settings
        self._table = table
        self._every = every
        self._has_goal = has_goal
        self._keep_checkpoints = keep_checkpoints
        self._stop = stop
        self._is_stopped = False
        self._envs = [scene_env() for _ in range(settings.check_episodes)]
        self._seconds_before = self.checks[-1].seconds if self.checks else 0.0

    @property
    def best(self) -> Check | None:
        """The best check so far."""
        return max(self.checks, key=lambda check: check.rank, default=None)

    def _on_training_start(self) -> None:
        self._began = time.perf_counter()
        self._next = self.num_timesteps + self._every

    def _on_step(self) -> bool:
        if self.num_timesteps >= self._next:
            self._next += self._every
            self.check()
            self._is_stopped = self._stop is not None and self._stop(self.checks)
        return not (self.enough or self._is_stopped)

    def check(self) -> Check:
        """Check the policy now."""
        best = self.best
        seeds = range(FIRST_SEED, FIRST_SEED + len(self._envs))
        episodes = _trials(self.model, self._envs, seeds, self._table)
        check = Check(
            steps=self.num_timesteps,
            seconds=self._seconds_before + time.perf_counter() - self._began,
            success=float(np.mean([each.success for each in episodes])) if self._has_goal else None,
            reward=float(np.mean([each.reward for each in episodes])),
            length=float(np.mean([each.length for each in episodes])),
        )
        self.checks.append(check)
        if best is None or check.rank >= best.rank:
            self._run.put(self._run.best, self.model.save)
        if self._keep_checkpoints:
            self._run.put(self._run.checkpoint(check.steps), self.model.save)
        self._run.note(self.checks)
        latest = [each.success for each in self.checks[-self._settings.enough :]]
        self.enough = 0 < self._settings.enough <= latest.count(1.0)
        self.logger.record("check/success", check.success or 0.0)
        self.logger.record("check/reward", check.reward)
        return check


def _trials(
    model: BaseAlgorithm,
    envs: Sequence[SceneEnv],
    seeds: Iterable[int],
    table: npt.NDArray[np.float32] | None = None,
) -> list[EpisodeStats]:
    """Run one episode in each world at the same time, with deterministic actions.

    Args:
        model: the driver.
        envs: a world for each seed.
        seeds: seeds of the episodes.
        table: the actions, where the model chooses them by number.
    """
    seeds = list(seeds)
    observations = [env.reset(seed=seed)[0] for env, seed in zip(envs, seeds, strict=True)]
    rewards, lengths = np.zeros(len(seeds)), np.zeros(len(seeds), int)
    done: dict[int, EpisodeStats] = {}
    under_way = list(range(len(seeds)))
    while under_way:
        seen = _stacked([observations[index] for index in under_way])
        actions, _ = model.predict(seen, deterministic=True)
        for index, action in zip(under_way, actions, strict=True):
            chosen = action if table is None else table[action]
            observations[index], reward, over, cut, info = envs[index].step(chosen)
            rewards[index] += reward
            lengths[index] += 1
            if over or cut:
                won = bool(info["success"])
                done[index] = EpisodeStats(
                    seeds[index], won, float(rewards[index]), int(lengths[index]), over
                )
        under_way = [index for index in under_way if index not in done]
    return [done[index] for index in sorted(done)]


def _stacked(observations: Sequence[Any]) -> Any:
    if isinstance(observations[0], dict):
        return {key: np.stack([each[key] for each in observations]) for key in observations[0]}
    return np.stack(observations)
