"""What takes part in the benchmark: each gets itself ready for a round, which is not timed."""

from collections.abc import Callable
from typing import Any

import numpy as np
from stable_baselines3.common.vec_env import VecEnv

from ai4u_edu.envs import SceneEnv
from tests.benchmarks.course import course
from tests.benchmarks.floors import PublicFloor
from tests.benchmarks.interleaved import Work

STEPS, SEED = 250, 5
BEFORE, FEW = 12, 8
"""Decisions a world where there are many worlds, not timed and timed: in the first ones the physics
gets its memory, and two of 64 episodes end; during the others none does, for a reset is no step."""

Contender = Callable[[], tuple[Work, int]]


def one_world(make: Callable[[], Any]) -> Contender:
    """Something with a ``step``, ready at the beginning of the episode."""

    def prepare() -> tuple[Work, int]:
        step, actions = make().step, list(course(STEPS, SEED))

        def work() -> None:
            ends = [any(step(action)[2:4]) for action in actions]
            assert not any(ends), "a step after the end is no step"

        return work, STEPS

    return prepare


def many_worlds(env: Any, count: int) -> Contender:
    """A vector environment, every world driven along the same course."""
    actions = np.repeat(course(BEFORE + FEW, SEED)[:, None], count, axis=1)

    def prepare() -> tuple[Work, int]:
        if isinstance(env, VecEnv):
            env.seed(SEED)  # world i gets SEED + i there
            env.reset()
        else:
            env.reset(seed=[SEED + index for index in range(count)])
        for each in actions[:BEFORE]:
            env.step(each)

        def work() -> None:
            for each in actions[BEFORE:]:
                env.step(each)

        return work, FEW * count

    return prepare


def many_floors(kind: type[PublicFloor], env: SceneEnv, count: int) -> Contender:
    """The same worlds by hand, one after another: what many worlds cost where nothing else does."""
    actions = list(course(BEFORE + FEW, SEED))

    def one(seed: int) -> Callable[[Any], Any]:
        env.reset(seed=seed)
        return kind(env.sim).step

    def prepare() -> tuple[Work, int]:
        steps = [one(SEED + index) for index in range(count)]
        for action in actions[:BEFORE]:
            for step in steps:
                step(action)

        def work() -> None:
            for action in actions[BEFORE:]:
                for step in steps:
                    step(action)

        return work, FEW * count

    return prepare


def resets(env: SceneEnv, clock: Callable[[], float], rounds: int) -> float:
    """Microseconds that a reset takes: for each of some seeds the fastest round, on average."""

    def once(seed: int) -> float:
        began = clock()
        env.reset(seed=seed)
        return clock() - began

    return 1e6 * float(np.mean([min(once(seed) for _ in range(rounds)) for seed in range(30)]))
