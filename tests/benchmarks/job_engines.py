"""Cost of jobs on each engine: ``python -m tests.benchmarks.job_engines --games 200 --trials 8``.

For each engine: the time until it is ready (the first job, which loads everything), the time of
all others, and the overhead of a job, which is the time of a core in which no job ran.
"""

import argparse
import time
from collections.abc import Sequence

from ai4u_edu import Scene
from ai4u_edu.games.jobs import Job, engine, run_jobs
from ai4u_edu.games.tournament.contest import game_job
from ai4u_edu.games.tournament.entry import parse_entry
from ai4u_edu.games.tournament.sides import sides_of

CORES = 2
ENGINES = ("inline", "processes", "ray")


def games(count: int) -> list[Job]:
    """Return games of sumo, 85 to 1,000 ticks each."""
    sides = sides_of(Scene.load("sumo"))
    entries = [parse_entry(each, sides) for each in ("PushOutController", "scene")]
    return [game_job({"name": "sumo"}, seed, entries) for seed in range(count)]


def trials(count: int) -> list[Job]:
    """Return small trainings with their export."""
    # each process of a job imports this module, and games need no torch
    from ai4u_edu.learn.training.sweep.plan import Choice, SweepPlan
    from tests.learn.training.small import small_settings

    plan = SweepPlan(
        scene={"name": "yardstick"},
        algorithms=("ppo",),
        seeds=tuple(range(count)),
        parameters=(),
        trials=0,
        batch=1,
        steps=256,
        settings=small_settings().model_dump(mode="json"),
    )
    return [plan.job(Choice(algorithm="ppo", seed=seed, settings={})) for seed in range(count)]


def measure(name: str, jobs: Sequence[Job]) -> tuple[float, float, float]:
    """Return seconds until all cores are ready, seconds of the jobs' run, and of the jobs alone."""
    began = time.perf_counter()
    width = 1 if name == "inline" else CORES
    with engine(name, width=None if name == "inline" else CORES) as running:
        first = [*run_jobs(jobs[:width], running)]
        ready = time.perf_counter()
        rest = [*run_jobs(jobs[width:], running)]
        ended = time.perf_counter()
    failed = [each.error for each in (*first, *rest) if each.error]
    if failed:
        raise SystemExit(f"{name}: {failed[0]}")
    return ready - began, ended - ready, sum(each.seconds for each in rest)


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--games", type=int, default=200)
    parser.add_argument("--trials", type=int, default=8)
    parser.add_argument("--engines", default=",".join(ENGINES))
    options = parser.parse_args()
    for title, jobs in (("games", games(options.games)), ("trials", trials(options.trials))):
        if not jobs:
            continue
        base = 0.0
        for name in options.engines.split(","):
            width = 1 if name == "inline" else CORES
            ready, took, alone = measure(name, jobs)
            base = base or took
            count = len(jobs) - width
            per_job = took / count
            base_per_job = base / (len(jobs) - 1)
            overhead = (took * width - alone) / count
            print(
                f"{len(jobs)} {title}, {name}: ready after {ready:.1f} s, then {took:.1f} s for "
                f"{count} ({per_job * 1e3:.0f} ms each, {base_per_job / per_job:.2f} times as fast "
                f"as inline), a job alone {alone / count * 1e3:.0f} ms, overhead "
                f"{overhead * 1e3:.1f} ms a job",
                flush=True,
            )


if __name__ == "__main__":
    main()
