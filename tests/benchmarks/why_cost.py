"""Cost of explanations: ``python -m tests.benchmarks.why_cost``.

A network of the zoo drives in real time, in a process that is tuned as ``ai4u-edu play`` is. Nobody
asks why, then somebody does; each pair is compared within one run, as machines and load differ.
With ``--maps``, somebody looks at the arrows and the values over the floor as well.
"""

import argparse
import statistics
import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ai4u_edu import Scene, trained_brain
from ai4u_edu.explain.live import INTEREST_S
from ai4u_edu.explain.live_maps import MapChoice
from ai4u_edu.explain.page import page_option
from ai4u_edu.runtime.process_tuning import tuned_process
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner

PAIRS = 5
SECONDS = 6.0
"""Length of each half of a pair."""
ASKS_PER_S = 8.0
"""Rate at which a page's panel asks."""

_late_s: list[float] = []
_tick = Runner._tick


class Half(NamedTuple):
    """Half of a pair."""

    late_ms: float
    """Lateness of 99% of the ticks (ms)."""
    core: float
    """Share of a core (%)."""


def main() -> None:
    """Print lateness of ticks and the share of a core, off and on."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", nargs="*", default=["box_chase", "maze", "parking"])
    parser.add_argument("--pairs", type=int, default=PAIRS)
    parser.add_argument("--maps", action="store_true")
    options = parser.parse_args()
    Runner._tick = _timed_tick  # type: ignore[method-assign]  # to measure
    with tuned_process():
        for scene in options.scenes:
            pairs = _pairs(scene, options.pairs, has_maps=options.maps)
            for name in Half._fields:
                off, on = (
                    statistics.median(getattr(pair[half], name) for pair in pairs)
                    for half in (0, 1)
                )
                print(f"{scene:10} {name:8} off {off:6.2f}  on {on:6.2f}  more {on - off:+.2f}")


def _pairs(scene: str, count: int, *, has_maps: bool) -> list[tuple[Half, Half]]:
    sim = Scene.load(scene).build()
    agent = sim.agents[0]
    agent.use_brain(trained_brain(f"zoo:{scene}"))
    runner = Runner(sim, seed=1)
    option = page_option(runner, ReplayPlayer(runner))
    requests = MapChoice(has_field=True, has_values=True).requests(agent.id) if has_maps else ()

    def ask() -> None:
        option.explainer.why(agent.id)
        for request in requests:
            option.maps.ask(request)

    runner.start()
    try:
        _half(runner, None)  # warms up
        return [(_half(runner, None), _half(runner, ask)) for _ in range(count)]
    finally:
        option.stop()
        runner.stop()


def _half(runner: Runner, ask: Callable[[], object] | None) -> Half:
    if ask is None:
        time.sleep(INTEREST_S + 1.0)  # until nobody is interested any more
    _late_s.clear()
    began, used = time.perf_counter(), time.process_time()
    while time.perf_counter() - began < SECONDS:
        if ask is not None:
            ask()
        time.sleep(1 / ASKS_PER_S)
    share = (time.process_time() - used) / (time.perf_counter() - began)
    return Half(1000 * float(np.percentile(_late_s, 99)), 100 * share)


def _timed_tick(self: Runner, *, whole_decision: bool = False) -> None:
    _late_s.append(self._clock() - self._schedule.due)
    _tick(self, whole_decision=whole_decision)


if __name__ == "__main__":
    main()
