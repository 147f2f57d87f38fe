"""Bytecodes and calls of a decision: ``python -m tests.benchmarks.bytecodes``.

They are the same at every run, also on a machine that has much else to do, so two versions can be
compared where no clock can be trusted. What is done in C, by the physics and the rays, is not
counted. Arguments: scenes, ``--observation``, ``--decisions``, ``--resets``, ``--top``.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

from ai4u_edu.learn.envs import SceneEnv

SCENES = ("yardstick", "box_chase", "sample_scene")


class Count:
    """Bytecodes and calls by function."""

    def __init__(self) -> None:
        self.bytecodes: Counter[CodeType] = Counter()
        self.calls: Counter[CodeType] = Counter()

    def run(self, work: Callable[[], Any]) -> Any:
        """Call a function, count what it runs and return its result."""
        before = sys.gettrace()
        sys.settrace(self._enter)
        try:
            return work()
        finally:
            sys.settrace(before)

    def show(self, title: str, times: int, top: int) -> None:
        """Print a line for all together and one for each of the largest functions."""
        print(
            f"{title}: {self.bytecodes.total() / times:,.0f} bytecodes, "
            f"{self.calls.total() / times:,.0f} calls of Python functions"
        )
        for code, count in self.bytecodes.most_common(top):
            file = Path(code.co_filename)
            place = f"{file.parent.name}/{file.name}:{code.co_firstlineno} {code.co_qualname}"
            print(f"  {count / times:8,.1f} in {self.calls[code] / times:6.2f} calls: {place}")

    def _enter(self, frame: FrameType, _event: str, _arg: Any) -> Callable[..., Any]:
        frame.f_trace_opcodes, frame.f_trace_lines = True, False
        code = frame.f_code
        self.calls[code] += 1

        def trace(_frame: FrameType, event: str, _arg: Any) -> Callable[..., Any]:
            self.bytecodes[code] += event == "opcode"
            return trace

        return trace


def count_scene(scene: str, observation: str, decisions: int, resets: int, top: int) -> None:
    """Print what decisions and resets of a scene run; actions are random, from one seed."""
    env = SceneEnv(scene, observation=observation)
    env.action_space.seed(1)
    env.reset(seed=1)
    steps = Count()
    for _ in range(decisions):
        action = env.action_space.sample()
        _, _, terminated, truncated, _ = steps.run(partial(env.step, action))
        if terminated or truncated:
            env.reset()
    steps.show(f"{scene}, a decision", decisions, top)
    starts = Count()
    for seed in range(resets):
        starts.run(partial(env.reset, seed=seed))
    starts.show(f"{scene}, a reset", resets, top)


def main() -> None:
    """Print the counts of the scenes that are asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", default=list(SCENES))
    parser.add_argument("--observation", default="flat")
    parser.add_argument("--decisions", type=int, default=300)
    parser.add_argument("--resets", type=int, default=20)
    parser.add_argument("--top", type=int, default=0, help="largest functions to list")
    options = parser.parse_args()
    for scene in options.scenes:
        count_scene(scene, options.observation, options.decisions, options.resets, options.top)


if __name__ == "__main__":
    main()
