"""Work in a thread: a share of the processor, between ticks."""

import threading

import pytest

from ai4u_edu.explain.pacing import Pacing, StoppedError

PACING = "ai4u_edu.explain.pacing"


class Waits(threading.Event):
    """An event that is waited for in no time."""

    def __init__(self) -> None:
        super().__init__()
        self.seconds: list[float] = []

    def wait(self, timeout: float | None = None) -> bool:
        self.seconds.append(timeout or 0.0)
        return self.is_set()


@pytest.fixture(autouse=True)
def _every_millisecond_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    processor_s = iter(range(100))
    monkeypatch.setattr(f"{PACING}.time.thread_time", lambda: 0.003 * next(processor_s))
    monkeypatch.setattr(f"{PACING}.time.monotonic", lambda: 10.0)


def test_it_rests_for_the_rest_of_its_share() -> None:
    waits = Waits()
    paced = Pacing(lambda: 0.25, waits)
    paced.rest()
    assert waits.seconds == pytest.approx([0.009])  # 3 ms of work, a quarter of 12 ms
    waits.set()
    with pytest.raises(StoppedError):
        paced.rest()


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
    Pacing(lambda: 1.0, waits, lambda: next(ticks)).rest()
    assert waits.seconds[0] == 0.0
    assert waits.seconds[1:] == pytest.approx(waited)


def test_little_work_needs_no_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    waits = Waits()
    monkeypatch.setattr(f"{PACING}.time.thread_time", lambda: 0.0)
    Pacing(lambda: 0.25, waits).rest()
    assert waits.seconds == []
