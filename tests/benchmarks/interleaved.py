"""Times several things in turns, so that a machine that is busy now and then slows all of them."""

import statistics
import time
from collections.abc import Callable, Mapping
from typing import NamedTuple

Work = Callable[[], None]


class Timing(NamedTuple):
    """What one contender took."""

    microseconds: float
    """For one unit of work, the median over the rounds."""
    fastest: float
    """The same in the fastest round: where others use the machine, the median tells of them too."""
    speed: float
    """How many times as fast as the one it is compared with, the median of the rounds' ratios."""


def race(
    contenders: Mapping[str, Callable[[], tuple[Work, int]]],
    against: str,
    rounds: int,
    clock: Callable[[], float] = time.perf_counter,
) -> dict[str, Timing]:
    """Lets each do its work once a round.

    Args:
        contenders: by name, what gets one ready for a round: its work, and how many units that is.
            Getting ready is not timed.
        against: the one that all others are compared with.
        rounds: how many; one more comes before them, which is not counted.
        clock: gives seconds; ``time.process_time`` leaves out what other processes take, and also
            what a contender has other processes do.
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
