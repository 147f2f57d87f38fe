"""Training of an agent in a scene with Stable-Baselines3."""

import time
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.callbacks import BaseCallback, CallbackList
from stable_baselines3.common.logger import configure
from stable_baselines3.common.off_policy_algorithm import OffPolicyAlgorithm
from stable_baselines3.common.vec_env import VecEnv

from ai4u_edu.base.errors import ParameterError, SetupError
from ai4u_edu.base.seeding import MAX_TRAINING_SEED, checked_seed
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.learn.training.algorithms import check_actions, load_model, new_model
from ai4u_edu.learn.training.episode import EpisodeStats
from ai4u_edu.learn.training.interrupt import Interrupt
from ai4u_edu.learn.training.prepare import prepare, with_learner
from ai4u_edu.learn.training.progress_bar import REFRESH_S, ProgressBar
from ai4u_edu.learn.training.run import Check, Config, Run, Trained
from ai4u_edu.learn.training.settings import Algorithm, Settings
from ai4u_edu.learn.training.worlds import ABOVE, Choices, make_worlds
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

if TYPE_CHECKING:
    from ai4u_edu.learn.training.watch import Watch

FIRST_SEED = 2 * ABOVE
"""First seed of the checks' episodes; neither trainings nor evaluations use them."""
PACKAGES = ("ai4u-edu", "stable-baselines3", "torch", "numpy", "pymunk", "gymnasium")
AVERAGED_EPISODES = 100
"""Episodes over which the progress bar averages rewards and successes."""


def train(
    scene: Scene,
    algorithm: Algorithm,
    settings: Settings,
    folder: Path,
    *,
    steps: int | None = None,
    seed: int = 0,
    overwrite: bool = False,
    keep_checkpoints: bool = False,
    quiet: bool = False,
    watch: "Watch | None" = None,
    stop: Callable[[Sequence[Check]], bool] | None = None,
) -> Trained:
    """Start a training.

    The same seed on the same machine gives the same model.

    Args:
        scene: the scene.
        algorithm: the algorithm's name.
        settings: settings of all algorithms for this scene.
        folder: the folder for all results; see :class:`~ai4u_edu.learn.training.run.Run`.
        steps: decisions to learn from; left out, as the settings say.
        seed: seed of the network, the worlds and all random choices.
        overwrite: True replaces a training that is in the folder.
        keep_checkpoints: True keeps the model of each check.
        quiet: True shows nothing.
        watch: page that shows the policy driving as it learns.
        stop: called with all checks after each one; True ends the training.

    Raises:
        SetupError: the settings don't fit the scene, or the folder holds a training already.
        ParameterError: the seed is larger than :data:`MAX_TRAINING_SEED`.
    """
    if checked_seed(seed) > MAX_TRAINING_SEED:
        raise ParameterError(
            _(
                "seed: expected a whole number from 0 to {most} for a training, got {seed}",
                most=MAX_TRAINING_SEED,
                seed=seed,
            )
        )
    own = settings.of(algorithm)
    settings = with_learner(scene, settings, quiet=quiet)
    prepared = prepare(scene, settings)
    check_actions(algorithm, _env(prepared, settings).action_space)
    worlds = make_worlds(prepared, settings, algorithm)
    model = new_model(algorithm, own, worlds, seed)
    worlds.seed(ABOVE + 1000 * seed)  # a new model has given them its own, which is small
    run = Run(folder)
    config = Config(
        scene=scene.description.name,
        algorithm=algorithm,
        seed=seed,
        steps=steps or own.steps,
        settings=settings,
        versions={name: version(name) for name in PACKAGES},
    )
    if overwrite:
        run.clear()
    run.begin(config, scene)
    return _learn(run, config, prepared, model, worlds, quiet, watch, keep_checkpoints, stop)


def resume(
    folder: Path,
    *,
    steps: int | None = None,
    keep_checkpoints: bool = False,
    quiet: bool = False,
    watch: "Watch | None" = None,
) -> Trained:
    """Resume a training that was interrupted, or extend one.

    The worlds begin new episodes, so it is not bit for bit what it would have been without a break.

    Args:
        folder: the training's folder.
        steps: decisions to learn from, the ones before counted too; left out, as it was begun.
        keep_checkpoints: True keeps the model of each check.
        quiet: True shows nothing.
        watch: page that shows the policy driving as it learns.

    Raises:
        SetupError: there is no training in the folder.
    """
    run = Run(folder)
    config = run.config()
    settings = with_learner(run.scene(), config.settings)
    prepared = prepare(run.scene(), settings)
    worlds = make_worlds(prepared, settings, config.algorithm)
    model = load_model(config.algorithm, run.last, worlds)
    # other episodes than those that it began with
    worlds.seed(ABOVE + 1000 * config.seed + 7919 * (1 + model.num_timesteps))
    if isinstance(model, OffPolicyAlgorithm) and run.replay.is_file():
        model.load_replay_buffer(run.replay)
    config = config.model_copy(update={"steps": steps or config.steps, "settings": settings})
    if model.num_timesteps >= config.steps:
        raise SetupError(
            _(
                "{folder} has learned from {num_timesteps} steps already; expected --steps "
                "larger than that, got {steps}",
                folder=str(folder),
                num_timesteps=model.num_timesteps,
                steps=config.steps,
            )
        )
    return _learn(run, config, prepared, model, worlds, quiet, watch, keep_checkpoints)


def _learn(
    run: Run,
    config: Config,
    prepared: Scene,
    model: BaseAlgorithm,
    worlds: VecEnv,
    quiet: bool,
    watch: "Watch | None",
    keep_checkpoints: bool,
    stop: Callable[[Sequence[Check]], bool] | None = None,
) -> Trained:
    settings = config.settings
    evaluation = EvalCallback(
        run,
        lambda: _env(prepared, settings),
        settings,
        table=worlds.table if isinstance(worlds, Choices) else None,
        every=settings.of(config.algorithm).check_every,
        has_goal=prepared.description.success is not None,
        keep_checkpoints=keep_checkpoints,
        stop=stop,
    )
    interrupt = Interrupt()
    bar = _Progress(evaluation, config.steps, quiet=quiet)
    formats = ["tensorboard"] if find_spec("tensorboard") else []
    model.set_logger(configure(str(run.tensorboard), formats))
    left = config.steps - model.num_timesteps
    callbacks: list[BaseCallback] = [_EndIfAsked(interrupt), evaluation, bar]
    if watch:
        watch.set_training(run, config.steps)
        callbacks.append(watch)
    try:
        with interrupt.listening():
            model.learn(left, CallbackList(callbacks), reset_num_timesteps=False)
            if not evaluation.checks or evaluation.checks[-1].steps < model.num_timesteps:
                evaluation.check()
    finally:
        bar.close()
        model.logger.close()
    run.put(run.last, model.save)
    if isinstance(model, OffPolicyAlgorithm):
        run.put(run.replay, model.save_replay_buffer)
    if watch:
        watch.finish()
    return Trained(
        run=run,
        steps=model.num_timesteps,
        interrupted=interrupt.asked,
        enough=evaluation.enough,
        checks=evaluation.checks,
        best=max(evaluation.checks, key=lambda check: check.rank),
    )


def _env(prepared: Scene, settings: Settings) -> SceneEnv:
    return SceneEnv(prepared, observation=settings.observation, agent=settings.agent or None)


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
        """True if the last checks saw nothing but success."""
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


class _EndIfAsked(BaseCallback):  # type: ignore[misc]  # seen without its types
    """Ends a training after the step in which it was asked to end."""

    def __init__(self, interrupt: Interrupt) -> None:
        super().__init__()
        self._interrupt = interrupt

    def _on_step(self) -> bool:
        return not self._interrupt.asked


class _Progress(BaseCallback):  # type: ignore[misc]  # seen without its types
    """Shows steps a second, mean reward, success rate and remaining time.

    Args:
        evaluation: the evaluation callback whose checks are shown.
        until: the step at which the training ends at the latest.
        quiet: True shows nothing.
    """

    def __init__(self, evaluation: EvalCallback, until: int, *, quiet: bool = False) -> None:
        super().__init__()
        self._evaluation = evaluation
        self._until = until
        self._rewards: deque[float] = deque(maxlen=AVERAGED_EPISODES)
        self._won: deque[bool] = deque(maxlen=AVERAGED_EPISODES)
        self._told = len(evaluation.checks)
        self._quiet = quiet
        self._bar: ProgressBar | None = None

    def _on_training_start(self) -> None:
        self._first = self.num_timesteps
        self._began = self._shown = time.perf_counter()
        self._bar = ProgressBar(self._until, _("steps"), quiet=self._quiet)

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
            self._bar.note(check.line)
        self._told = len(self._evaluation.checks)
        speed = (self.num_timesteps - self._first) / max(self._shown - self._began, 1e-9)
        reward = f"{np.mean(self._rewards):.2f}" if self._rewards else "-"
        success = f"{np.mean(self._won):.0%}" if self._won else "-"
        self._bar.show(
            min(self.num_timesteps, self._until),
            _(
                "{speed:.0f}/s  reward {reward}  success {success}",
                speed=speed,
                reward=reward,
                success=success,
            ),
        )
