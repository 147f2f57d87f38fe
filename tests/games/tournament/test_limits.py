"""Processor time of an entry's decisions."""

import threading
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from ai4u_edu.games.tournament import limits
from ai4u_edu.games.tournament.entry import file_driver
from ai4u_edu.games.tournament.game import game
from ai4u_edu.games.tournament.limits import DECISION_CPU_S, GAME_CPU_S, CpuMeter, OverTimeError
from ai4u_edu.locale import unpacked
from tests.waiting import LIMIT_S, until


class Clocks:
    """Processor time of all threads that a test sets; the meter's thread gets it when it may."""

    def __init__(self) -> None:
        self.now = 0.0
        self.stopped: list[float] = []
        """Times at which the meter has stopped a decision."""
        self.asked = 0
        """Times that the meter's thread has asked."""
        self.answers = threading.Semaphore(0)
        self._free = False

    def answer_all(self) -> None:
        """Let the meter's thread never wait again."""
        self._free = True
        self.answers.release()

    def process_time(self) -> float:
        if threading.current_thread().name == "cpu meter":
            self.asked += 1
            assert self._free or self.answers.acquire(timeout=LIMIT_S)
        return self.now

    def thread_time(self) -> float:
        return self.now


@pytest.fixture
def clocks(monkeypatch: pytest.MonkeyPatch) -> Clocks:
    made = Clocks()
    fake = SimpleNamespace(process_time=made.process_time, thread_time=made.thread_time)
    monkeypatch.setattr(limits, "time", fake)
    monkeypatch.setattr(limits, "CHECK_INTERVAL_S", 0.001)
    return made


@pytest.fixture
def meter(clocks: Clocks) -> Iterator[CpuMeter]:
    made = CpuMeter(lambda: clocks.stopped.append(clocks.now))
    yield made
    clocks.answer_all()
    made.close()


def test_a_decision_that_takes_too_long_is_stopped(clocks: Clocks, meter: CpuMeter) -> None:
    def decide() -> None:
        with meter.measuring():
            clocks.now += 1.5 * DECISION_CPU_S
            clocks.answer_all()
            until(lambda: clocks.stopped)

    with pytest.raises(OverTimeError, match=r"it took 1\.5 s of processor time for a decision"):
        decide()


def test_a_game_has_a_limit_of_its_own(clocks: Clocks, meter: CpuMeter) -> None:
    def decide() -> None:
        with meter.measuring():
            clocks.now += DECISION_CPU_S

    for _ in range(round(GAME_CPU_S / DECISION_CPU_S)):
        decide()
    with pytest.raises(OverTimeError, match="more than 60 s of processor time in one game"):
        decide()
    assert clocks.stopped == []


def test_time_between_two_decisions_counts_for_none(clocks: Clocks, meter: CpuMeter) -> None:
    """The meter's thread stands still after it has begun to look, as on a busy machine."""
    with meter.measuring():
        until(lambda: clocks.asked == 1)
    clocks.now += 2 * DECISION_CPU_S
    with meter.measuring():
        clocks.answers.release()
        until(lambda: clocks.asked == 2)  # it has looked
    assert clocks.stopped == []


def test_a_closed_meter_has_no_thread(clocks: Clocks, meter: CpuMeter) -> None:
    """A thread that outlives its game would read the clocks of the next one."""
    with meter.measuring():
        until(lambda: clocks.asked == 1)
    closing = threading.Thread(target=meter.close)
    closing.start()
    clocks.answer_all()
    closing.join()
    assert "cpu meter" not in [each.name for each in threading.enumerate()]


@pytest.mark.needs("train", "tournament")
@pytest.mark.slow
def test_the_limits_of_a_game_hold_for_the_load_of_a_network(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from ai4u_edu.games.tournament import drivers
    from tests.games.tournament.bad_networks import folding

    path = tmp_path / "folding.onnx"
    folding(path, 1000)
    entries = [
        {"name": "ann", "drivers": {"": file_driver("network", path, 10**6)}},
        {"name": "bob", "drivers": {"": {"kind": "scene"}}},
    ]
    monkeypatch.setattr(drivers, "LOAD_CPU_S", 0.02)
    told = game({"name": "sumo"}, 0, entries)
    assert (told["forfeit"], told["ticks"]) == (0, 0)
    assert unpacked(told["reason"]) == "it took more than 5 s of processor time to load"
    monkeypatch.setattr(drivers, "LOAD_CPU_S", LIMIT_S)
    assert game({"name": "sumo"}, 0, entries)["forfeit"] == -1
