"""What a step costs, next to the same world written by hand: ``python -m tests.benchmarks``.

All contenders drive the same course through the same worlds, in turns, in one process; what counts
is the median of the rounds' ratios. It prints the table as Markdown; with ``--peers`` it has other
environments from the package index in it, which are fetched first.
"""

import argparse
import contextlib
import platform
import time
from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
from stable_baselines3.common.vec_env import DummyVecEnv, VecEnv

from ai4u_edu.envs import SceneEnv, SceneVectorEnv
from ai4u_edu.envs.sb3 import SceneVecEnv
from ai4u_edu.world import _segments as segments
from tests.benchmarks.course import course
from tests.benchmarks.floors import BareFloor, CffiFloor, CompiledFloor, PublicFloor, compiled
from tests.benchmarks.interleaved import Timing, Work, race
from tests.benchmarks.peers import PEERS, PeerError, running

STEPS, SEED = 250, 5
OURS = "`SceneEnv.step`"

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


def many_worlds(env: Any, count: int, steps: int) -> Contender:
    """A vector environment, every world driven along the same course."""
    actions = np.repeat(course(steps, SEED)[:, None], count, axis=1)

    def prepare() -> tuple[Work, int]:
        if isinstance(env, VecEnv):
            env.seed(SEED)  # world i gets SEED + i there
            env.reset()
        else:
            env.reset(seed=[SEED + index for index in range(count)])

        def work() -> None:
            for each in actions:
                env.step(each)

        return work, steps * count

    return prepare


def main() -> None:
    """Measures and prints."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description=__doc__)
    parser.add_argument("--rounds", type=int, default=30)
    parser.add_argument("--worlds", type=int, default=64)
    parser.add_argument("--workers", type=int, default=8, help="of AsyncVectorEnv; 0: without it")
    parser.add_argument("--peers", action="store_true", help="others too; takes minutes")
    parser.add_argument(
        "--busy",
        action="store_true",
        help="for a machine that others use: count the processor's time, not the clock's; without "
        "what runs in other processes",
    )
    options = parser.parse_args()
    if options.busy:
        options.workers, options.peers = 0, False

    def make() -> SceneEnv:
        return SceneEnv("yardstick", observation="flat")

    env, count = make(), options.worlds

    def ours() -> SceneEnv:
        env.reset(seed=SEED)
        return env

    def floor(kind: type[PublicFloor]) -> Callable[[], PublicFloor]:
        return lambda: kind(ours().sim)

    contenders = {
        OURS: one_world(ours),
        "by hand, pymunk's public interface": one_world(floor(PublicFloor)),
        "by hand, rays through cffi": one_world(floor(CffiFloor)),
        "by hand, everything through cffi": one_world(floor(BareFloor)),
    }
    if compiled():
        name = "by hand, everything through cffi, the loop over the rays in C"
        contenders[name] = one_world(floor(CompiledFloor))
    contenders |= {
        f"`SceneVectorEnv`, {count} worlds": many_worlds(
            SceneVectorEnv(count, "yardstick", observation="flat"), count, 20
        ),
        f"Gymnasium's `SyncVectorEnv`, {count} worlds": many_worlds(
            gymnasium.vector.SyncVectorEnv([make] * count), count, 20
        ),
        f"`SceneVecEnv` for Stable-Baselines3, {count} worlds": many_worlds(
            SceneVecEnv("yardstick", count), count, 20
        ),
        f"Stable-Baselines3's `DummyVecEnv`, {count} worlds": many_worlds(
            DummyVecEnv([make] * count), count, 20
        ),
    }
    missing = {}
    with contextlib.ExitStack() as stack:
        if options.workers:
            several = gymnasium.vector.AsyncVectorEnv([make] * options.workers)
            stack.callback(several.close)
            name = f"Gymnasium's `AsyncVectorEnv`, {options.workers} worlds and processes"
            contenders[name] = many_worlds(several, options.workers, 40)
        for key, peer in PEERS.items() if options.peers else ():
            try:
                contenders[peer.title] = stack.enter_context(running(key))
            except PeerError as error:
                missing[peer.title] = str(error)
        clock = time.process_time if options.busy else time.perf_counter
        timings = race(contenders, OURS, options.rounds, clock)
    show(timings)
    for title, why in missing.items():
        print(f"| {title} | not measured: {why} | | | |")


def show(timings: dict[str, Timing]) -> None:
    """Prints the table."""
    loop = "compiled" if segments.compiled() else "cffi: nothing compiled here"
    print(f"{platform.machine()}, Python {platform.python_version()}; our loop over rays: {loop}\n")
    print("| one decision | microseconds | a second | fastest round | ours is |")
    print("|---|---|---|---|---|")
    for name, (micros, fastest, speed) in timings.items():
        ratio = 1 / speed
        print(
            f"| {name} | {micros:.1f} | {1e6 / micros:,.0f} | {fastest:.1f} "
            f"| {ratio:.{0 if ratio >= 20 else 2}f} x as fast |"
        )


if __name__ == "__main__":
    main()
