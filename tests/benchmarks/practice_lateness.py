"""Lateness of a world's ticks with a practice beside it, and without one.

``python -m tests.benchmarks.practice_lateness`` answers: does a training disturb the world?

A world of box_chase runs at its own speed, driven by its network. In turns, a network practises for
rewards in a process beside it, as the tab Teach has it do, or does not. Ticks are late by the time
from when they are due until they begin. Other load on the machine makes both late; the difference
between neighbouring turns is what the practice does. Arguments: ``--seconds N``, ``--turns N``.
"""

import argparse
import os
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path

import numpy as np

from ai4u_edu import Scene
from ai4u_edu.learn.training.run import Run
from ai4u_edu.learn.training.varying import with_driver
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.teach.practice import PracticeFolder, PracticeProcess, PracticeRequest

SCENE = "box_chase"
DECISIONS = 1_000_000
"""Decisions of a practice, which never ends by itself here."""
AWAY = {"touch": -1.0}
"""Factors with which it never reaches the goal, and so does not end early."""


class TimedRunner(Runner):
    """Runner that notes how late each tick is."""

    late_s: list[float]

    def _tick(self, *, whole_decision: bool = False) -> None:
        self.late_s.append(self._clock() - self._schedule.due)
        super()._tick(whole_decision=whole_decision)


def measure(seconds: float, *, has_practice: bool) -> list[float]:
    """Return how late (s) each tick of a world was."""
    scene, _ = with_driver(Scene.load(SCENE), "zoo")
    runner = TimedRunner(scene.build(), seed=1, wait_for_key=False)
    runner.late_s = []
    with ExitStack() as stack:
        if has_practice:
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
            request = PracticeRequest(scene.dumps(), SCENE, "", "0", DECISIONS, 0, AWAY)
            _, request = PracticeFolder(folder).add(SCENE, request)
            practice = PracticeProcess(request)
            stack.callback(lambda: practice.problem)  # waits for its end
            stack.callback(practice.kill)
            while not Run(Path(request.folder)).progress.is_file():  # it learns
                practice.wait(0.1)
        runner.start()
        time.sleep(seconds)
        runner.stop(10.0)
    return runner.late_s


def main() -> None:
    """Measure in turns, and print a table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--turns", type=int, default=3)
    chosen = parser.parse_args()
    late: dict[bool, list[float]] = {False: [], True: []}
    for turn in range(chosen.turns):
        for has_practice in (turn % 2 == 1, turn % 2 == 0):  # growing load makes both late
            late[has_practice] += measure(chosen.seconds, has_practice=has_practice)
    print(f"load average {os.getloadavg()[0]:.1f}, {os.cpu_count()} cores")
    print(
        "| a practice beside it | ticks | late, median | late, 99th percentile |\n|---|---|---|---|"
    )
    for has_practice, numbers in late.items():
        median, most = 1000 * np.percentile(numbers, [50, 99])
        print(f"| {has_practice} | {len(numbers)} | {median:.2f} ms | {most:.2f} ms |")


if __name__ == "__main__":
    main()
