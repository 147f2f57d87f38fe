"""Timing of several contenders in turn, so that other load on the machine slows all of them."""

import statistics
import time
from collections.abc import Callable, Mapping
from typing import NamedTuple

Work = Callable[[], None]


class Timing(NamedTuple):
    """Times of one contender."""

    microseconds: float
    """Microseconds for one unit of work, median over the rounds."""
    fastest: float
    """The same in the fastest round, which other load on the machine changes least."""
    speed: float
    """Speed relative to the reference contender, median of the rounds' ratios."""


def race(
    contenders: Mapping[str, Callable[[], tuple[Work, int]]],
    against: str,
    rounds: int,
    clock: Callable[[], float] = time.perf_counter,
) -> dict[str, Timing]:
    """Run each contender once a round and return the times by name.

    Args:
        contenders: functions by name that prepare a round, which is not timed, and return its work
            and the units of work in it.
        against: name of the reference contender.
        rounds: number of rounds, after a first one that is not counted.
        clock: function that returns seconds; ``time.process_time`` leaves out other processes,
            also those that a contender uses.
    """
    took: dict[str, list[float]] = {name: [] for name in contenders}
    for _ in range(rounds + 1):
        for name, prepare in contenders.items():
            work, units = prepare()
            began = clock()
            work()
            took[name].append((clock() - began) / units * 1e6)
    base = took[against]
    return {
        name: Timing(
            statistics.median(each[1:]),
            min(each[1:]),
            statistics.median(b / a for a, b in zip(each[1:], base[1:], strict=True)),
        )
        for name, each in took.items()
    }
