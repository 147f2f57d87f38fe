"""Clones of drives by keys: from how many starts do they reach the goal?

``python -m tests.benchmarks.clones`` has a simulated person drive box_chase five times by keys, in
three ways: at once, with keys that lag by three decisions (a quarter of a second), and with a lag
of two decisions, a late start and pauses. From each five drives a network learns as in the tab
Teach, and drives from all starts of the scene. One line for each way: the mean share of starts from
which the box was reached, how many networks reached it from all of them, and the least share.

Arguments: ``--seeds N`` (drives and networks of each way; six by default).
"""

import argparse
import math
import statistics
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ai4u_edu import Scene
from ai4u_edu.base.numeric_threads import restart_with_one_thread
from ai4u_edu.learn.small_trainer import clone
from ai4u_edu.recording import Episode, Recorder
from ai4u_edu.teach.network_score import score_network

SCENE = "box_chase"
DRIVES = 5
MAX_DECISIONS = 400
SCORE_DECISIONS = 100_000


@dataclass(frozen=True)
class Person:
    """A simulated person who drives by keys."""

    lag: int = 0
    """Decisions between what is seen and the keys that answer it."""
    late: int = 0
    """Decisions at most before the first key."""
    pause: float = 0.0
    """Probability at each decision to let go of all keys, for three to nine decisions."""


PERSONS = {
    "at once": Person(),
    "lag of 3": Person(lag=3),
    "with pauses": Person(lag=2, late=4, pause=0.02),
}


def drive(person: Person, seed: int, rng: np.random.Generator) -> Episode:
    """Return the recording of a drive to the box."""
    loaded = Scene.load(SCENE)
    sim = loaded.build()
    recorder = Recorder(sim, scene=loaded.description)
    sim.reset(seed)
    agent = sim.agents[0]
    agent.keyboard.clock = lambda: 0.0  # no key is let go since time passed
    keys: list[set[str]] = [set() for _ in range(person.lag)]
    late = int(rng.integers(0, person.late + 1))
    rest = 0
    for decision in range(MAX_DECISIONS):
        x, y, _, heading = sim.world["robot"].pose
        box_x, box_y, *_ = sim.world["box"].pose
        angle = math.remainder(math.atan2(box_y - y, box_x - x) - heading, math.tau)
        wanted = set[str]()
        if abs(angle) > rng.uniform(0.12, 0.3):
            wanted.add("KeyA" if angle > 0 else "KeyD")
        if abs(angle) < 0.6:
            wanted.add("KeyW")
        keys.append(wanted)
        held = keys.pop(0)
        if rest > 0 or decision < late:
            rest -= 1
            held = set()
        elif rng.random() < person.pause:
            rest = int(rng.integers(3, 10))
        agent.keyboard.hold(sorted(held))
        sim.step()
        if agent.done:
            break
    recorder.finish()
    return recorder.episodes[-1]


def share_of_starts(person: Person, seed: int) -> float:
    """Return the share of starts from which a clone of five drives reaches the box."""
    rng = np.random.default_rng(seed)
    starts = rng.choice(1000, DRIVES, replace=False)
    drives = [drive(person, int(start), rng) for start in starts]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "clone.onnx"
        clone(drives, file, seed=seed, persons_only=True, quiet=True)
        score = score_network(Scene.load(SCENE), "0", file, SCORE_DECISIONS)
    assert score is not None
    return score.successes / score.starts


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=6)
    seeds = parser.parse_args().seeds
    print(f"| {SCENE}, driven | starts reached, mean | networks that reach all | least | CPU s |")
    print("|---|---|---|---|---|")
    for name, person in PERSONS.items():
        began = time.process_time()
        shares = [share_of_starts(person, seed) for seed in range(seeds)]
        print(
            f"| {name} | {statistics.mean(shares):.0%} | {shares.count(1.0)} of {seeds} "
            f"| {min(shares):.0%} | {time.process_time() - began:.0f} |",
            flush=True,
        )


if __name__ == "__main__":
    restart_with_one_thread()
    main()
