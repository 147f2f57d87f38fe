"""Gain of easy starts: ``python -m tests.benchmarks.easy_starts`` (``--seeds``, ``--decisions``).

How many decisions does the small learner need in push_block until it reaches the goal from 100
unseen starts, with the scene's ``curriculum:`` and without? The trainings of a seed take turns on
one core. A check is 100 starts every 8,192 decisions, always all of the scene's, and both see the
same ones. The seconds are those of the processor, checks included.
"""

import argparse
import os
import statistics
import time
from collections.abc import Callable, Sequence
from typing import NamedTuple

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"  # NumPy looks at it only when it is loaded

from ai4u_edu import Scene  # noqa: E402
from ai4u_edu.learn.small.ppo import PpoSettings  # noqa: E402
from ai4u_edu.learn.small.ppo_training import PpoTraining  # noqa: E402
from ai4u_edu.learn.training.prepare import prepare  # noqa: E402
from ai4u_edu.learn.training.settings import settings_for  # noqa: E402

SCENE = "push_block"
STARTS = 100
SHARES = (0.5, 0.9, 1.0)
"""Shares of the starts for which the first check that reached them is looked for."""


class Result(NamedTuple):
    """Result of one training."""

    decisions: Sequence[int | None]
    """Decisions until each of SHARES; None for never."""
    best: float
    processor_s: float


def without_easy_starts(scene: Scene) -> Scene:
    """Return a scene whose trainings begin with all starts."""
    bodies = tuple(
        body.model_copy(update={"curriculum": None}) for body in scene.description.bodies
    )
    return Scene(scene.description.model_copy(update={"bodies": bodies}), scene.folder)


def train(scene: Scene, seed: int, decisions: int) -> Result:
    """Train until one check has reached the goal from all its starts."""
    prepared = prepare(scene, settings_for(SCENE))
    chosen = PpoSettings(check_every=8192, check_episodes=STARTS, enough=1)
    training = PpoTraining(prepared, chosen, seed=seed)
    began = time.process_time()
    training.learn(decisions)
    reached = [(check.decisions, check.success or 0.0) for check in training.checks]
    firsts = [next((at for at, share in reached if share >= least), None) for least in SHARES]
    return Result(firsts, max(share for _, share in reached), time.process_time() - began)


def main() -> None:
    """Run all trainings, and print a table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--decisions", type=int, default=300_000)
    chosen = parser.parse_args()
    kinds: dict[str, Callable[[Scene], Scene]] = {
        "with": lambda scene: scene,
        "without": without_easy_starts,
    }
    results: dict[str, list[Result]] = {kind: [] for kind in kinds}
    for seed in range(chosen.seeds):
        for kind, change in kinds.items():
            result = train(change(Scene.load(SCENE)), seed, chosen.decisions)
            results[kind].append(result)
            print(kind, seed, *result, flush=True)
    columns = [f"{share:.0%} reached after" for share in SHARES]
    print("| easy starts | " + " | ".join([*columns, "best check", "CPU s"]) + " |")
    print("|---" * (len(columns) + 3) + "|")
    for kind, trained in results.items():
        cells = [
            ", ".join("never" if at is None else f"{at:,}" for at in sorted_by_never(firsts))
            for firsts in zip(*(result.decisions for result in trained), strict=True)
        ]
        best = ", ".join(f"{result.best:.0%}" for result in trained)
        processor_s = statistics.median(result.processor_s for result in trained)
        print(f"| {kind} | " + " | ".join([*cells, best, f"{processor_s:.0f}"]) + " |")


def sorted_by_never(firsts: Sequence[int | None]) -> list[int | None]:
    """Return counts in ascending order, those that were never reached last."""
    return sorted(firsts, key=lambda at: (at is None, at))


if __name__ == "__main__":
    main()
