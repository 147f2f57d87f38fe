"""Many copies of a scene in one process that share one set of arrays."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.vector.utils import batch_space, create_empty_array, iterate

from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.envs.scene_env import SceneEnv, SceneLike, load_scene
from ai4u_edu.locale import gettext as _


class Worlds:
    """Batch of ``count`` worlds, stepped one after another.

    Args:
        count: number of worlds.
        scene: a name out of the library, a YAML file, or a Scene.
        agents: ids of the agents that learn; the worlds take turns with them. Left out, the one
            that the options name, or that acts first.
        options: those of :class:`SceneEnv`.

    Attributes:
        envs: one environment a world.
        agents: those that learn, one a row of the arrays.
        space, action_space: of all worlds together, as Gymnasium batches them.
        observations: the latest of each world; written in place.
        rewards: (count,) float64, of the last decisions.
        terminated, truncated: (count,) bool, by the last decisions.
    """

    def __init__(
        self, count: int, scene: SceneLike, *, agents: Sequence[str] = (), **options: Any
    ) -> None:
        if count < 1:
            raise SetupError(_("num_envs: expected at least 1, got {count}", count=count))
        loaded = load_scene(scene)
        if agents:
            options["agent"] = agents[0]
        one = SceneEnv(loaded, **options)
        # what one world warns of, the others need not
        names = agents or [one.agent.id]
        self.envs = [one]
        for index in range(1, count):
            self.envs.append(SceneEnv(loaded, **options | {"agent": names[index % len(names)]}))
        for env in self.envs:
            one.range_warning.watch(env.agent)
        self.space = batch_space(one.observation_space, count)
        self.action_space = batch_space(one.action_space, count)
        self.observations: Any = create_empty_array(one.observation_space, count)
        self.rewards = np.zeros(count)
        self.terminated, self.truncated = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
        self.agents = [env.agent for env in self.envs]
        self._ledgers = [agent.ledger for agent in self.agents]
        self._write = [
            env.observer.writer(self.observations, index) for index, env in enumerate(self.envs)
        ]

    def reset(
        self, index: int, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> None:
        """Begin an episode in one world, with options as for :meth:`SceneEnv.reset`."""
        env = self.envs[index]
        env.reset(seed=seed, options=options)
        self._write[index](env.agent.percept)

    def step(self, actions: Any, resting: npt.NDArray[np.bool_] | None = None) -> None:
        """Step every world by one decision.

        Args:
            actions: out of ``action_space``.
            resting: worlds whose episode is over: they are reset instead.
        """
        rows = actions if isinstance(actions, np.ndarray) else iterate(self.action_space, actions)
        over = [False] * len(self.envs) if resting is None else resting.tolist()
        for env, write, row, rests in zip(self.envs, self._write, rows, over, strict=True):
            if rests:
                env.reset()
                write(env.agent.percept)
            else:
                write(env.decide(row))
        agents = self.agents
        self.rewards = np.array([ledger.total for ledger in self._ledgers])
        self.terminated = np.array([agent.terminated for agent in agents])
        self.truncated = np.array([agent.truncated for agent in agents])

    def told(self) -> Any:
        """Return a copy of the observations."""
        if isinstance(self.observations, dict):
            return {
                key: part if isinstance(part, tuple) else part.copy()
                for key, part in self.observations.items()
            }
        return self.observations.copy()

    def infos(self, mask: npt.NDArray[np.bool_] | None = None) -> dict[str, Any]:
        """Return the infos in the form of Gymnasium's vector environments.

        Args:
            mask: the worlds to include; None for all.
        """
        terms = [ledger.terms for ledger in self._ledgers]
        success = np.array([env.success for env in self.envs])
        told = np.ones(len(terms), np.bool_)
        if mask is not None:
            told[:] = mask
            success &= told
            terms = [
                each if known else {} for each, known in zip(terms, told.tolist(), strict=True)
            ]
        names, paid = terms[0].keys(), {}
        if all(each.keys() == names for each in terms):  # always, but where an episode begins
            for name in names:
                paid[name] = np.array([each[name] for each in terms])
                paid[f"_{name}"] = told.copy()
        else:
            for name in dict.fromkeys(name for each in terms for name in each):
                paid[name] = np.array([each.get(name, 0.0) for each in terms])
                paid[f"_{name}"] = np.array([name in each for each in terms])
        return {
            "reward_terms": paid,
            "_reward_terms": told,
            "success": success,
            "_success": told.copy(),
        }
