"""Evaluation of a model in many worlds at a time."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from stable_baselines3.common.base_class import BaseAlgorithm

from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.learn.training.episode import Episode


def trials(
    model: BaseAlgorithm,
    envs: Sequence[SceneEnv],
    seeds: Iterable[int],
    table: npt.NDArray[np.float32] | None = None,
) -> list[Episode]:
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
    done: dict[int, Episode] = {}
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
                done[index] = Episode(
                    seeds[index], won, float(rewards[index]), int(lengths[index]), over
                )
        under_way = [index for index in under_way if index not in done]
    return [done[index] for index in sorted(done)]


def _stacked(observations: Sequence[Any]) -> Any:
    if isinstance(observations[0], dict):
        return {key: np.stack([each[key] for each in observations]) for key in observations[0]}
    return np.stack(observations)
