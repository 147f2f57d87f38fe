"""Gymnasium vector environment: many copies of a scene in one process."""

from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.seeding import checked_seed, seeds_from
from ai4u_edu.learn.envs.scene_env import SceneLike
from ai4u_edu.learn.envs.worlds import Worlds
from ai4u_edu.locale import gettext as _


class SceneVectorEnv(VectorEnv[Any, Any, Any]):
    """Vector environment whose observations are written in place and copied once a step.

    Autoreset is Gymnasium's ``NEXT_STEP``: the step after an episode's last one ignores its action,
    resets that world, and gives the first observation of the next episode with reward 0.

    Args:
        num_envs: number of worlds.
        scene: a name out of the library, a YAML file, or a Scene.
        observation: ``"dict"`` or ``"flat"``.
        agent: the id of the agent that learns.
        render_mode: None or ``"rgb_array"``: one picture a world.
        copy: True returns a copy of the observations; else the next step overwrites them.
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
        self._worlds = Worlds(
            num_envs, scene, observation=observation, agent=agent, render_mode=render_mode
        )
        self.num_envs = num_envs
        self.render_mode = render_mode
        self.envs = self._worlds.envs
        """One environment a world."""
        self.single_observation_space = self.envs[0].observation_space
        self.single_action_space = self.envs[0].action_space
        self.observation_space = self._worlds.space
        self.action_space = self._worlds.action_space
        self._copy = copy
        self._over = np.zeros(num_envs, np.bool_)

    def reset(
        self,
        *,
        seed: int | list[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode in every world.

        Args:
            seed: one number: world i gets seed + i; or one for each world.
            options: ``{"reset_mask": ...}`` resets only some worlds. All others are numbers of
                the scene for this episode, as for :meth:`SceneEnv.reset`: one for all worlds, or
                an array with a row for each. A reset in ``step`` begins with the scene's own.
        """
        seeds = self._seeds(seed)
        numbers = dict(options or {})
        mask = numbers.pop("reset_mask", np.ones(self.num_envs, np.bool_))
        each = [self._options_of(index, numbers) for index in range(self.num_envs)]
        for index in np.flatnonzero(mask).tolist():
            self._worlds.reset(index, seeds[index], each[index])
            self._over[index] = False
        return self._told(), self._worlds.infos(mask)

    def step(
        self, actions: Any
    ) -> tuple[Any, npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any], dict[str, Any]]:
        """Step every world by one decision."""
        worlds = self._worlds
        worlds.step(actions, self._over)
        self._over = worlds.terminated | worlds.truncated
        return self._told(), worlds.rewards, worlds.terminated, worlds.truncated, worlds.infos()

    def render(self) -> tuple[Any, ...] | None:
        """Return one picture of each world."""
        if self.render_mode is None:
            return None
        return tuple(env.render() for env in self.envs)

    def close_extras(self, **kwargs: Any) -> None:
        """Do nothing; nothing is held open."""

    def _told(self) -> Any:
        return self._worlds.told() if self._copy else self._worlds.observations

    @property
    def options_space(self) -> spaces.Dict:
        """The numbers that options of a reset may change, with their ranges, by name."""
        return self.envs[0].options_space

    def _options_of(self, index: int, numbers: dict[str, Any]) -> dict[str, Any]:
        """Return the options of one world: its rows of those that have one for each world."""
        found = {}
        for name, value in numbers.items():
            is_for_each = isinstance(value, np.ndarray) and value.ndim > 0
            if is_for_each and len(value) != self.num_envs:
                raise SetupError(
                    _(
                        "options: {name}: expected an array with a row for each of {num_envs} "
                        "worlds, got {n}; a list is one value for all of them",
                        name=name,
                        num_envs=self.num_envs,
                        n=len(value),
                    )
                )
            found[name] = value[index] if is_for_each else value
        return found

    def _seeds(self, seed: int | list[int | None] | None) -> list[int | None]:
        if seed is None:
            return [None] * self.num_envs
        if not isinstance(seed, list | tuple | np.ndarray):
            return list(seeds_from(seed, self.num_envs))
        if len(seed) != self.num_envs:
            raise SetupError(
                _("seed: expected {num_envs} numbers, got {n}", num_envs=self.num_envs, n=len(seed))
            )
        # all of them before any world begins anew
        return [None if each is None else checked_seed(each) for each in seed]
