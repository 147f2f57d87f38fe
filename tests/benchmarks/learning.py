"""Speed and success of learning: ``python -m tests.benchmarks.learning``.

It learns each scene with each algorithm from five seeds, one training after another, as
``ai4u-edu train`` does; evaluates each on 100 seeds that no training uses, in the scene's own
limits; prints a table for the README, and draws the curves into
``tests/pictures/learning.png``. Arguments: ``--seeds N``, ``--algo ...``, scenes.

Seconds are those of the whole training, checks included, without the second or two in which torch
is loaded. CPU seconds show the time on a machine without other load.
"""

import argparse
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from ai4u_edu import Scene
from ai4u_edu.learn.training.evaluating import evaluate
from ai4u_edu.learn.training.learning import train
from ai4u_edu.learn.training.plots import plot_curves
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.learn.training.run import Check
from ai4u_edu.learn.training.settings import Algorithm, settings_for

SCENES = ("box_chase", "sample_scene")
ALGORITHMS: tuple[Algorithm, ...] = ("sac", "ppo")
EPISODES = 100
PICTURE = Path(__file__).parents[1] / "pictures" / "learning.png"


class Result(NamedTuple):
    """Result of one training."""

    success: float
    steps: int
    seconds: float
    processor: float
    checks: list[Check]


def learn(scene: str, algorithm: Algorithm, seed: int, folder: Path) -> Result:
    """Train once and evaluate the policy."""
    loaded = Scene.load(scene)
    began, worked = time.perf_counter(), time.process_time()
    done = train(loaded, algorithm, settings_for(scene), folder, seed=seed, quiet=True)
    seconds, processor = time.perf_counter() - began, time.process_time() - worked
    told = evaluate(entrant(str(folder)), loaded, range(EPISODES))
    return Result(told.success or 0.0, done.steps, seconds, processor, done.checks)


def between(numbers: list[float], form: str = ".0f") -> str:
    """Return the smallest and the largest number as text."""
    low, high = (format(each, form) for each in (min(numbers), max(numbers)))
    return low if low == high else f"{low} to {high}"


def main() -> None:
    """Run all trainings and print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("scenes", nargs="*", default=list(SCENES))
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--algo", nargs="+", default=list(ALGORITHMS))
    chosen = parser.parse_args()
    lines = [
        "| scene | algorithm | success on 100 unseen seeds | steps | seconds | CPU s |",
        "|---|---|---|---|---|---|",
    ]
    curves: dict[str, dict[str, list[Check]]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for scene in chosen.scenes:
            for algorithm in chosen.algo:
                results = []
                for seed in range(chosen.seeds):
                    place = Path(folder) / f"{scene}-{algorithm}-{seed}"
                    result = learn(scene, algorithm, seed, place)
                    print(scene, algorithm, seed, *result[:4], flush=True)
                    results.append(result)
                curves[f"{scene}, {algorithm}"] = {
                    f"seed {seed}": result.checks for seed, result in enumerate(results)
                }
                shares = ", ".join(f"{result.success:.0%}" for result in results)
                lines.append(
                    f"| {scene} | {algorithm} | {shares} "
                    f"| {between([result.steps for result in results])} "
                    f"| {between([result.seconds for result in results])} "
                    f"| {between([result.processor for result in results])} |"
                )
    plot_curves(curves, PICTURE)
    print("\n".join(lines))


if __name__ == "__main__":
    main()
