"""Work in a thread: a share of the processor, between ticks."""

import itertools
import math
import threading
from collections.abc import Callable

import pytest

from ai4u_edu.explain.pacing import Pacing, StoppedError

WORK_S = 0.003
"""Processor time that each piece of work takes in these tests."""


class Waits(threading.Event):
    """An event that is waited for in no time."""

    def __init__(self) -> None:
        super().__init__()
        self.seconds: list[float] = []

    def wait(self, timeout: float | None = None) -> bool:
        self.seconds.append(timeout or 0.0)
        return self.is_set()


def paced(
    share: float,
    waits: Waits,
    next_tick_at: Callable[[], float] = lambda: math.inf,
    work_s: float = WORK_S,
) -> Pacing:
    """Return a pacing at the time 10 s, each piece of whose work takes a time."""
    pieces = itertools.count()
    return Pacing(
        lambda: share,
        waits,
        next_tick_at,
        clock=lambda: 10.0,
        thread_time=lambda: work_s * next(pieces),
    )


def test_it_rests_for_the_rest_of_its_share() -> None:
    waits = Waits()
    pacing = paced(0.25, waits)
    pacing.rest()
    assert waits.seconds == pytest.approx([0.009])  # 3 ms of work, a quarter of 12 ms
    waits.set()
    with pytest.raises(StoppedError):
        pacing.rest()


@pytest.mark.parametrize(
    ("ticks_at", "waited"),
    [
        ((10.016,), []),  # far enough
        ((10.001, 10.016), [0.003]),  # until the tick is over
        ((9.999, 10.016), [0.002]),  # it runs
        ((9.0,), []),  # a world that is far behind ticks all the time
        ((10.001, 10.002, 10.003), [0.003, 0.004, 0.005]),  # it never fits
    ],
)
def test_it_works_between_two_ticks(ticks_at: tuple[float, ...], waited: list[float]) -> None:
    waits, ticks = Waits(), iter(ticks_at)
    paced(1.0, waits, lambda: next(ticks)).rest()
    assert waits.seconds[0] == 0.0
    assert waits.seconds[1:] == pytest.approx(waited)


def test_little_work_needs_no_rest() -> None:
    waits = Waits()
    paced(0.25, waits, work_s=0.0).rest()
    assert waits.seconds == []
