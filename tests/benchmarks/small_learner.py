"""Speed of the small learner beside Stable-Baselines3.

``python -m tests.benchmarks.small_learner`` answers: which of them is faster?

Both learn a scene by PPO from the same seeds, one training after the other on the same core, until
two checks in a row saw nothing but success. box_chase and sample_scene have few starts, and a check
sees them all; others are checked on 100 starts. The median over the seeds is what counts: single
seeds differ by a factor of three. Stable-Baselines3 has the project's settings for the scene; the
small learner its own ones, in the same rhythm and with the same limit of steps.

Seconds are those of processor and of the clock, without set-up: imports, making worlds and models.
The checks count, as they are part of both. The learners take turns, and so do scenes: no pair of
trainings is begun after ``--minutes``, so that the table has fewer seeds then. Ten seeds of
box_chase and sample_scene take about 5 minutes on an idle core, push_block up to 40 more.
"""

import argparse
import os
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"  # NumPy looks at it only when it is loaded

from stable_baselines3.common.logger import configure  # noqa: E402

from ai4u_edu import Scene  # noqa: E402
from ai4u_edu.learn.envs import SceneEnv  # noqa: E402
from ai4u_edu.learn.small.ppo import PpoSettings  # noqa: E402
from ai4u_edu.learn.small.ppo_training import PpoTraining  # noqa: E402
from ai4u_edu.learn.training.algorithms import new_model  # noqa: E402
from ai4u_edu.learn.training.learning import EvalCallback  # noqa: E402
from ai4u_edu.learn.training.prepare import prepare  # noqa: E402
from ai4u_edu.learn.training.run import Run  # noqa: E402
from ai4u_edu.learn.training.settings import Settings, settings_for  # noqa: E402
from ai4u_edu.learn.training.worlds import ABOVE, make_worlds  # noqa: E402

SCENES = ("box_chase", "sample_scene", "push_block")
FEW_STARTS = ("box_chase", "sample_scene")
"""Scenes with so few starts that a usual check sees them all."""
UNSEEN_STARTS = 100


class Time(NamedTuple):
    """Result of one training."""

    seconds: float
    processor: float
    decisions: int
    is_enough: bool
    """True if all starts of two checks in a row succeeded."""


def settings_of(scene: str) -> Settings:
    """Return the project's settings, with as many starts in a check as the comparison asks for."""
    many = {} if scene in FEW_STARTS else {"check_episodes": UNSEEN_STARTS}
    return settings_for(scene, changes={"enough": 2, **many})


def small(scene: str, seed: int, decisions: int) -> Time:
    """Learn with the small learner."""
    settings = settings_of(scene)
    prepared = prepare(Scene.load(scene), settings)
    chosen = PpoSettings(check_episodes=settings.check_episodes)
    training = PpoTraining(prepared, chosen, seed=seed)
    began, worked = time.perf_counter(), time.process_time()
    training.learn(decisions)
    seconds, processor = time.perf_counter() - began, time.process_time() - worked
    return Time(seconds, processor, training.ppo.decisions, training.is_enough)


def stable_baselines3(scene: str, seed: int, decisions: int) -> Time:
    """Learn with Stable-Baselines3."""
    settings = settings_of(scene)
    prepared = prepare(Scene.load(scene), settings)
    worlds = make_worlds(prepared, settings, "ppo")
    model = new_model("ppo", settings.ppo, worlds, seed)
    worlds.seed(ABOVE + 1000 * seed)
    model.set_logger(configure(None, []))
    with tempfile.TemporaryDirectory() as folder:
        evaluation = EvalCallback(
            Run(Path(folder)),
            lambda: SceneEnv(prepared, observation="flat"),
            settings,
            table=None,
            every=settings.ppo.check_every,
            has_goal=True,
        )
        began, worked = time.perf_counter(), time.process_time()
        model.learn(decisions, evaluation)
        seconds, processor = time.perf_counter() - began, time.process_time() - worked
    return Time(seconds, processor, model.num_timesteps, evaluation.enough)


LEARNERS: dict[str, Callable[[str, int, int], Time]] = {
    "small": small,
    "Stable-Baselines3": stable_baselines3,
}


def main() -> None:
    """Run all trainings in turn, and print a table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scenes", nargs="*", default=list(SCENES))
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--decisions", type=int, default=300_000, help="of a training, at most")
    parser.add_argument("--minutes", type=float, default=60.0)
    chosen = parser.parse_args()
    end = time.monotonic() + 60 * chosen.minutes  # real time: a person says how long
    times: dict[str, dict[str, list[Time]]] = {
        scene: {name: [] for name in LEARNERS} for scene in chosen.scenes
    }
    for seed in range(chosen.seeds):
        for scene in chosen.scenes:
            if time.monotonic() > end:
                continue
            # the one that is first is the other one next time
            for name in list(LEARNERS)[:: 1 if seed % 2 else -1]:
                result = LEARNERS[name](scene, seed, chosen.decisions)
                print(scene, name, seed, *result, flush=True)
                times[scene][name].append(result)
    print(f"load average {os.getloadavg()[0]:.1f}, {os.cpu_count()} cores")
    print("\n".join(table(times)))


def table(times: dict[str, dict[str, list[Time]]]) -> list[str]:
    """Return the lines of a table of medians."""
    lines = [
        "| scene | learner | all starts reached | decisions, median | seconds, median | CPU s |",
        "|---|---|---|---|---|---|",
    ]
    for scene, of_scene in times.items():
        for name, results in of_scene.items():
            if not results:
                continue
            decisions, seconds, processor = (
                statistics.median(numbers)
                for numbers in (
                    [result.decisions for result in results],
                    [result.seconds for result in results],
                    [result.processor for result in results],
                )
            )
            reached = sum(result.is_enough for result in results)
            lines.append(
                f"| {scene} | {name} | {reached} of {len(results)} | {decisions:,.0f} "
                f"| {seconds:.1f} | {processor:.1f} |"
            )
    return lines


if __name__ == "__main__":
    main()
