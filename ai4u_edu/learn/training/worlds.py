"""Vectorized copies of a scene for a training with Stable-Baselines3."""

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces
from stable_baselines3.common.vec_env import VecEnv, VecEnvWrapper

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.learn.envs.sb3 import SceneVecEnv
from ai4u_edu.learn.training.settings import NO_REWARD, Algorithm, Settings
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

ABOVE = 2**40
"""Lower bound of the seeds of a training's first episodes; later seeds are random 32-bit numbers.
Small numbers are left for evaluations, on worlds that the agent never saw."""


def make_worlds(scene: Scene, settings: Settings, algorithm: Algorithm) -> VecEnv:
    """Return the worlds to learn in.

    Args:
        scene: as :func:`~ai4u_edu.learn.training.prepare.prepare` made it.
        settings: the training's settings.
        algorithm: DQN gets a table of actions to choose from.

    Raises:
        SetupError: the settings leave out a reward term that there is not.
    """
    scenes = SceneVecEnv(
        scene,
        settings.of(algorithm).worlds,
        observation=settings.observation,
        agent=settings.agent or None,
    )
    worlds: VecEnv = scenes
    if settings.without_reward != NO_REWARD:
        names = [each.name for each in scenes.envs[0].agent.rewards]
        if settings.without_reward not in names:
            raise SetupError(
                _(
                    "without_reward: no reward term is called {without_reward!r}; {hint}",
                    without_reward=settings.without_reward,
                    hint=suggest(settings.without_reward, names),
                )
            )
        worlds = WithoutReward(worlds, settings.without_reward)
    if algorithm == "dqn" and isinstance(worlds.action_space, spaces.Box):
        return Choices(worlds, table_for(worlds.action_space, settings.actions))
    return worlds


class Choices(VecEnvWrapper):  # type: ignore[misc]  # seen without its types
    """VecEnv wrapper: actions are chosen by number from a table.

    Args:
        worlds: with actions of real numbers.
        table: (choices, numbers) an action a row.
    """

    def __init__(self, worlds: VecEnv, table: npt.NDArray[np.float32]) -> None:
        super().__init__(worlds, action_space=spaces.Discrete(len(table)))
        self.table = table

    def reset(self) -> Any:
        """Reset every world."""
        return self.venv.reset()

    def step_async(self, actions: npt.NDArray[Any]) -> None:
        """Look the actions up in the table."""
        self.venv.step_async(self.table[actions])

    def step_wait(self) -> Any:
        """Return the results of the step."""
        return self.venv.step_wait()


class WithoutReward(VecEnvWrapper):  # type: ignore[misc]  # seen without its types
    """VecEnv wrapper: rewards lack one term. What ends an episode ends it as ever.

    Args:
        worlds: whose infos have ``reward_terms``.
        term: the term's name.
    """

    def __init__(self, worlds: VecEnv, term: str) -> None:
        super().__init__(worlds)
        self._term = term

    def reset(self) -> Any:
        """Reset every world."""
        return self.venv.reset()

    def step_wait(self) -> Any:
        """Return the results of the step."""
        seen, rewards, dones, infos = self.venv.step_wait()
        paid = [info["reward_terms"].get(self._term, 0.0) for info in infos]
        return seen, rewards - np.array(paid, rewards.dtype), dones, infos


def table_for(space: spaces.Box, given: Sequence[Sequence[float]] = ()) -> npt.NDArray[np.float32]:
    """Return the actions that DQN chooses from, an array of shape (actions, numbers).

    By default the first is rest; in each other, one number is at its minimum or maximum and all
    others are 0. For numbers from [-1, 0] to [1, 1] they are [0, 0], [-1, 0], [1, 0] and [0, 1].
    """
    count = int(np.prod(space.shape))
    if given:
        wrong = [row for row in given if len(row) != count]
        if wrong:
            raise SetupError(
                _(
                    "actions: expected rows of {count} numbers, got {list}",
                    count=count,
                    list=str(list(wrong[0])),
                )
            )
        return np.clip(np.array(given, np.float32), space.low.ravel(), space.high.ravel())
    rows = [np.zeros(count, np.float32)]
    for index, end in product(range(count), (space.low.ravel(), space.high.ravel())):
        if end[index]:
            row = np.zeros(count, np.float32)
            row[index] = end[index]
            rows.append(row)
    return np.stack(rows)
