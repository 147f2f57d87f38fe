"""Cost of ``--watch`` for a training: ``python -m tests.benchmarks.watch_cost``.

It learns box_chase repeatedly, from the same seed and for as many steps, in turn with the page and
without it, and compares the seconds of consecutive pairs. The whole training counts: the page's
start, its world, and each model that is sent to it. The processor time of the training alone is
printed too; other load on the machine changes it less.
"""

import argparse
import os
import statistics
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from ai4u_edu.learn.training import train

MAX_SHARE = 0.05
"""Share of the training's time that watching may cost."""


class Took(NamedTuple):
    """Times of one training."""

    seconds: float
    processor: float
    """Processor time (s) of the training's process, without the page's."""


def learn(algo: str, steps: int, folder: Path, *, watch: bool) -> Took:
    """Train once."""
    began, worked = time.perf_counter(), time.process_time()
    train(
        "box_chase",
        algo,
        steps=steps,
        out=folder,
        settings={"enough": 0},
        watch=watch,
        quiet=True,
    )
    return Took(time.perf_counter() - began, time.process_time() - worked)


def main() -> None:
    """Run the pairs and print the cost of watching in each."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--algo", default="sac")
    parser.add_argument("--steps", type=int, default=8000)
    parser.add_argument("--pairs", type=int, default=5)
    chosen = parser.parse_args()
    for display in ("DISPLAY", "WAYLAND_DISPLAY"):  # opens no browser
        os.environ.pop(display, None)
    pairs: list[tuple[Took, Took]] = []
    with tempfile.TemporaryDirectory() as folder:
        learn(chosen.algo, 500, Path(folder) / "warm", watch=False)
        for pair in range(chosen.pairs):
            # the order alternates, so that growing load on the machine slows both alike
            first = bool(pair % 2)
            took = {
                watch: learn(
                    chosen.algo, chosen.steps, Path(folder) / f"{pair}-{watch}", watch=watch
                )
                for watch in (first, not first)
            }
            pairs.append((took[False], took[True]))
            alone, watched = pairs[-1]
            print(
                f"{chosen.algo}, {chosen.steps} steps: {alone.seconds:.1f} s, watched "
                f"{watched.seconds:.1f} s ({watched.seconds / alone.seconds - 1:+.1%}); processor "
                f"{alone.processor:.1f} s, {watched.processor:.1f} s "
                f"({watched.processor / alone.processor - 1:+.1%})",
                flush=True,
            )
    for index, what in enumerate(Took._fields):
        share = statistics.median(watched[index] / alone[index] - 1 for alone, watched in pairs)
        verdict = "within" if share <= MAX_SHARE else "more than"
        print(f"{what}, median of {len(pairs)} pairs: {share:+.1%}, {verdict} {MAX_SHARE:.0%}")


if __name__ == "__main__":
    main()
