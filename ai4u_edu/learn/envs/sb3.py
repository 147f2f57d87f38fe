"""A scene for Stable-Baselines3: many worlds as one VecEnv.

Needs ``pip install ai4u-edu[train]``; nothing else of this package loads this module.
"""

import time
from collections.abc import Sequence
from typing import Any

import numpy as np
from stable_baselines3.common.vec_env import VecEnv

from ai4u_edu.base.seeding import checked_seed
from ai4u_edu.learn.envs.scene_env import SceneEnv, SceneLike
from ai4u_edu.learn.envs.worlds import Worlds

Indices = None | int | Sequence[int]


class SceneVecEnv(VecEnv):  # type: ignore[misc]  # seen without its types
    """Vectorized environment for ``PPO("MlpPolicy", SceneVecEnv("box_chase", 8))`` and its like.

    It needs no DummyVecEnv and no Monitor. A world whose
    episode ends is reset in the same step, as Stable-Baselines3 wants it, and its info says how
    the episode was: ``terminal_observation``, ``TimeLimit.truncated``, ``is_success``, and
    ``episode`` with return ``r``, length ``l`` and seconds since the start ``t``. Every info has
    the ``reward_terms`` by name.

    Args:
        scene: a name out of the library, a YAML file, or a Scene.
        num_envs: number of worlds.
        observation: ``"flat"`` for MlpPolicy, ``"dict"`` for MultiInputPolicy, ``"image"`` for
            CnnPolicy.
        agent: the id of the agent that learns.
        render_mode: None or ``"rgb_array"``.
    """

    def __init__(
        self,
        scene: SceneLike,
        num_envs: int = 1,
        *,
        observation: str = "flat",
        agent: str | None = None,
        render_mode: str | None = None,
    ) -> None:
        self._worlds = Worlds(
            num_envs, scene, observation=observation, agent=agent, render_mode=render_mode
        )
        self.envs: list[SceneEnv] = self._worlds.envs
        one = self.envs[0]
        super().__init__(num_envs, one.observation_space, one.action_space)
        self._began = time.perf_counter()
        self._actions: Any = None

    def reset(self) -> Any:
        """Reset every world, with the seeds of ``seed`` and the options of ``set_options``."""
        # all of them before any world begins anew
        seeds = [None if each is None else checked_seed(each) for each in self._seeds]
        for index, seed in enumerate(seeds):
            self._worlds.reset(index, seed, self._options[index] or None)
        self.reset_infos: list[dict[str, Any]] = [{} for _ in self.envs]
        self._reset_seeds()
        self._reset_options()
        return self._worlds.told()

    def step_async(self, actions: Any) -> None:
        """Store the actions for :meth:`step_wait`."""
        self._actions = actions

    def step_wait(self) -> tuple[Any, Any, Any, list[dict[str, Any]]]:
        """Step every world by one decision."""
        worlds = self._worlds
        worlds.step(self._actions)
        infos: list[dict[str, Any]] = [
            {"reward_terms": env.agent.ledger.terms} for env in self.envs
        ]
        dones = worlds.terminated | worlds.truncated
        for index in np.flatnonzero(dones).tolist():
            infos[index] |= self._episode_info(index)
            worlds.reset(index)
        return worlds.told(), worlds.rewards.astype(np.float32), dones, infos

    def close(self) -> None:
        """Do nothing; nothing is held open."""

    def get_images(self) -> list[Any]:
        """Return one picture of each world."""
        return [env.render() for env in self.envs]

    def get_attr(self, attr_name: str, indices: Indices = None) -> list[Any]:
        """Return an attribute of each world's environment."""
        return [getattr(env, attr_name) for env in self._chosen(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Indices = None) -> None:
        """Set an attribute of each world's environment."""
        for env in self._chosen(indices):
            setattr(env, attr_name, value)

    def env_method(
        self, method_name: str, *args: Any, indices: Indices = None, **options: Any
    ) -> list[Any]:
        """Call a method of each world's environment."""
        return [getattr(env, method_name)(*args, **options) for env in self._chosen(indices)]

    def env_is_wrapped(self, wrapper_class: type, indices: Indices = None) -> list[bool]:
        """Return False for each world; environments are not wrapped."""
        return [False for _ in self._chosen(indices)]

    def _episode_info(self, index: int) -> dict[str, Any]:
        """Return the info entries of a finished episode."""
        env = self.envs[index]
        agent = env.agent
        return {
            "terminal_observation": env.observer.observe(agent.percept),
            "TimeLimit.truncated": agent.truncated,
            "is_success": env.success,
            "episode": {
                "r": agent.ledger.episode_total,
                "l": agent.steps,
                "t": time.perf_counter() - self._began,
            },
        }

    def _chosen(self, indices: Indices) -> list[SceneEnv]:
        return [self.envs[index] for index in self._get_indices(indices)]
