"""Many copies of a scene in one process, stepped one after another into one set of arrays."""

from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space, create_empty_array

from ai4u_edu.envs.scene_env import SceneEnv, SceneLike, load_scene
from ai4u_edu.errors import SetupError


class SceneVectorEnv(VectorEnv[Any, Any, Any]):
    """``num_envs`` worlds; observations are written in place, and copied once a step.

    Autoreset is Gymnasium's ``NEXT_STEP``: the step after an episode's last one ignores its action,
    resets that world, and gives the first observation of the next episode with reward 0.

    Args:
        num_envs: how many worlds.
        scene: a name out of the library, a YAML file, or a Scene.
        observation: ``"dict"`` or ``"flat"``.
        agent: the id of the agent that learns.
        render_mode: None or ``"rgb_array"``: one picture a world.
        copy: whether each step's observations are a copy; without, the next step overwrites them.
    """

    metadata: dict[str, Any] = {
        "render_modes": ["rgb_array"],
        "autoreset_mode": AutoresetMode.NEXT_STEP,
    }

    def __init__(
        self,
        num_envs: int = 1,
        scene: SceneLike = "box_chase",
        *,
        observation: str = "dict",
        agent: str | None = None,
        render_mode: str | None = None,
        copy: bool = True,
    ) -> None:
        if num_envs < 1:
            raise SetupError(f"num_envs: expected at least 1, got {num_envs}")
        loaded = load_scene(scene)
        self.num_envs = num_envs
        self.render_mode = render_mode
        self.envs = [
            SceneEnv(loaded, observation=observation, agent=agent, render_mode=render_mode)
            for _ in range(num_envs)
        ]
        self.single_observation_space = self.envs[0].observation_space
        self.single_action_space = self.envs[0].action_space
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._flat = observation == "flat"
        self._copy = copy
        self._observations: Any = create_empty_array(self.single_observation_space, num_envs)
        self._rewards = np.zeros(num_envs, np.float64)
        self._terminated = np.zeros(num_envs, np.bool_)
        self._truncated = np.zeros(num_envs, np.bool_)
        self._over = np.zeros(num_envs, np.bool_)

    def reset(
        self,
        *,
        seed: int | list[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Begins an episode in every world.

        Args:
            seed: one number: world i gets seed + i; or one for each world.
            options: ``{"reset_mask": ...}`` resets only some worlds.
        """
        seeds = self._seeds(seed)
        mask = (options or {}).get("reset_mask", np.ones(self.num_envs, np.bool_))
        infos: dict[str, Any] = {}
        for index, env in enumerate(self.envs):
            if mask[index]:
                observation, info = env.reset(seed=seeds[index])
                self._put(index, observation)
                infos = self._add_info(infos, info, index)
                self._over[index] = False
        return self._told(), infos

    def step(
        self, actions: Any
    ) -> tuple[Any, npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any], dict[str, Any]]:
        """One decision in every world."""
        infos: dict[str, Any] = {}
        rewards, terminated, truncated = self._rewards, self._terminated, self._truncated
        for index, (env, action) in enumerate(
            zip(self.envs, gymnasium.vector.utils.iterate(self.action_space, actions), strict=True)
        ):
            if self._over[index]:
                observation, info = env.reset()
                rewards[index], terminated[index], truncated[index] = 0.0, False, False
            else:
                observation, rewards[index], terminated[index], truncated[index], info = env.step(
                    action
                )
            self._put(index, observation)
            infos = self._add_info(infos, info, index)
        np.logical_or(terminated, truncated, out=self._over)
        return self._told(), rewards.copy(), terminated.copy(), truncated.copy(), infos

    def render(self) -> tuple[Any, ...] | None:
        """One picture a world."""
        if self.render_mode is None:
            return None
        return tuple(env.render() for env in self.envs)

    def close_extras(self, **kwargs: Any) -> None:
        """Nothing is held open."""

    def _put(self, index: int, observation: Any) -> None:
        if self._flat:
            self._observations[index] = observation
        else:
            for key, value in observation.items():
                part = self._observations[key]
                if isinstance(part, tuple):  # text has no array
                    self._observations[key] = (*part[:index], value, *part[index + 1 :])
                else:
                    part[index] = value

    def _told(self) -> Any:
        if not self._copy:
            return self._observations
        if self._flat:
            return self._observations.copy()
        return {
            key: part if isinstance(part, tuple) else part.copy()
            for key, part in self._observations.items()
        }

    def _seeds(self, seed: int | list[int | None] | None) -> list[int | None]:
        if seed is None:
            return [None] * self.num_envs
        if isinstance(seed, int):
            return [seed + index for index in range(self.num_envs)]
        if len(seed) != self.num_envs:
            raise SetupError(f"seed: expected {self.num_envs} numbers, got {len(seed)}")
        return list(seed)
