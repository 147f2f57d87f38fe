"""Cost of a step beside the same world written by hand: ``python -m tests.benchmarks``.

All contenders drive the same course through the same worlds, each in turn with ours; the result is
the median of the rounds' ratios. Those with many worlds are measured one by one, since a program
has only one of them. The table is printed as Markdown; ``--peers`` adds other environments from the
package index, which are installed first and get a time limit each.
"""

import argparse
import contextlib
import platform
import time
from collections.abc import Callable

import gymnasium
from stable_baselines3.common.vec_env import DummyVecEnv

from ai4u_edu.learn.envs import SceneEnv, SceneVectorEnv
from ai4u_edu.learn.envs.sb3 import SceneVecEnv
from ai4u_edu.world.native import segments
from tests.benchmarks.contenders import (
    SEED,
    Contender,
    many_floors,
    many_worlds,
    one_world,
    resets,
)
from tests.benchmarks.floors import BareFloor, CffiFloor, CompiledFloor, PublicFloor, compiled
from tests.benchmarks.interleaved import Timing, race
from tests.benchmarks.peers import PEERS, PeerError, running

OURS = "`SceneEnv.step`"
BY_SENSOR = '`SceneEnv.step`, an array for each sensor (`observation="dict"`)'
PUBLIC = "by hand, pymunk's public interface"


def make(observation: str = "flat") -> SceneEnv:
    """Return an environment of the yardstick: 35 readings, 32 of them rays; 4 ticks a decision."""
    return SceneEnv("yardstick", observation=observation)


def main() -> None:
    """Run the benchmark and print its table."""
    options = parse_options()
    clock = time.process_time if options.busy else time.perf_counter
    env, by_sensor = make(), make("dict")

    def ours(env: SceneEnv = env) -> SceneEnv:
        env.reset(seed=SEED)
        return env

    def by_hand(kind: type[PublicFloor]) -> Contender:
        return one_world(lambda: kind(ours().sim))

    def against_ours(others: dict[str, Contender]) -> dict[str, Timing]:
        return race({OURS: one_world(ours), **others}, OURS, options.rounds, clock)

    floors: dict[str, type[PublicFloor]] = {
        PUBLIC: PublicFloor,
        "by hand, rays through cffi": CffiFloor,
        "by hand, everything through cffi": BareFloor,
    }
    if compiled():
        floors["by hand, everything through cffi, the loop over the rays in C"] = CompiledFloor
    timings = against_ours(
        {BY_SENSOR: one_world(lambda: ours(by_sensor))}
        | {name: by_hand(kind) for name, kind in floors.items()}
    )

    def alone(name: str, contender: Contender) -> None:
        timings[name] = against_ours({name: contender})[name]

    count, workers = options.worlds, options.workers
    name, kind = list(floors.items())[-1]
    alone(f"{name}, {count} worlds", many_floors(kind, env, count))
    for name, several in vectors(count).items():
        alone(f"{name}, {count} worlds", many_worlds(several(), count))
    if workers:
        parallel = gymnasium.vector.AsyncVectorEnv([make] * workers)
        with contextlib.closing(parallel):
            name = f"Gymnasium's `AsyncVectorEnv`, {workers} worlds and processes"
            alone(name, many_worlds(parallel, workers))
    missing = {}
    for key, peer in PEERS.items() if options.peers else ():
        try:
            with running(key) as contender:
                alone(peer.title, contender)
        except PeerError as error:
            missing[peer.title] = str(error)
    show(timings)
    public = timings[PUBLIC].speed
    print(
        f"\nThe loop through pymunk's public interface takes {1 / public:.2f} times as long as a "
        f"step with a flat observation, and {timings[BY_SENSOR].speed / public:.2f} times as long "
        "as one with an array for each sensor"
    )
    for title, why in missing.items():
        print(f"| {title} | not measured: {why} | | | |")
    print(f"\nA reset of `SceneEnv`: {resets(env, clock, options.rounds):.0f} microseconds")


def parse_options() -> argparse.Namespace:
    """Parse the command line."""
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
    return options


def vectors(count: int) -> dict[str, Callable[[], object]]:
    """Return vector environments in one process by name, ours and those of the libraries."""
    return {
        "`SceneVectorEnv`": lambda: SceneVectorEnv(count, "yardstick", observation="flat"),
        "Gymnasium's `SyncVectorEnv`": lambda: gymnasium.vector.SyncVectorEnv([make] * count),
        "`SceneVecEnv` for Stable-Baselines3": lambda: SceneVecEnv("yardstick", count),
        "Stable-Baselines3's `DummyVecEnv`": lambda: DummyVecEnv([make] * count),
    }


def show(timings: dict[str, Timing]) -> None:
    """Print the table."""
    loop = "compiled" if segments.compiled_cast() else "cffi: nothing compiled here"
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
