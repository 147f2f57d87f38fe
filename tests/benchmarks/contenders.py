"""Contenders of the benchmark; preparing one for a round is not timed."""

from collections.abc import Callable
from typing import Any

import numpy as np
from stable_baselines3.common.vec_env import VecEnv

from ai4u_edu.learn.envs import SceneEnv
from tests.benchmarks.course import course
from tests.benchmarks.floors import PublicFloor
from tests.benchmarks.interleaved import Work

STEPS, SEED = 250, 5
WARM_UP_STEPS, TIMED_STEPS = 12, 8
"""Decisions in each of many worlds. In the first ones the physics allocates its memory, and two of
64 episodes end; during the timed ones no episode ends, since a reset is no step."""

Contender = Callable[[], tuple[Work, int]]


def one_world(make: Callable[[], Any]) -> Contender:
    """Return a contender that makes an object with a ``step`` for each round."""

    def prepare() -> tuple[Work, int]:
        step, actions = make().step, list(course(STEPS, SEED))

        def work() -> None:
            ends = [any(step(action)[2:4]) for action in actions]
            assert not any(ends), "the episode must not end while it is timed"

        return work, STEPS

    return prepare


def many_worlds(env: Any, count: int) -> Contender:
    """Return a contender with a vector environment, all of whose worlds drive the same course."""
    actions = np.repeat(course(WARM_UP_STEPS + TIMED_STEPS, SEED)[:, None], count, axis=1)

    def prepare() -> tuple[Work, int]:
        if isinstance(env, VecEnv):
            env.seed(SEED)  # world i gets SEED + i there
            env.reset()
        else:
            env.reset(seed=[SEED + index for index in range(count)])
        for each in actions[:WARM_UP_STEPS]:
            env.step(each)

        def work() -> None:
            for each in actions[WARM_UP_STEPS:]:
                env.step(each)

        return work, TIMED_STEPS * count

    return prepare


def many_floors(kind: type[PublicFloor], env: SceneEnv, count: int) -> Contender:
    """Return a contender with many hand-written worlds, stepped in turn."""
    actions = list(course(WARM_UP_STEPS + TIMED_STEPS, SEED))

    def one(seed: int) -> Callable[[Any], Any]:
        env.reset(seed=seed)
        return kind(env.sim).step

    def prepare() -> tuple[Work, int]:
        steps = [one(SEED + index) for index in range(count)]
        for action in actions[:WARM_UP_STEPS]:
            for step in steps:
                step(action)

        def work() -> None:
            for action in actions[WARM_UP_STEPS:]:
                for step in steps:
                    step(action)

        return work, TIMED_STEPS * count

    return prepare


def resets(env: SceneEnv, clock: Callable[[], float], rounds: int) -> float:
    """Return the microseconds of a reset: the fastest round of each seed, averaged."""

    def once(seed: int) -> float:
        began = clock()
        env.reset(seed=seed)
        return clock() - began

    return 1e6 * float(np.mean([min(once(seed) for _ in range(rounds)) for seed in range(30)]))
