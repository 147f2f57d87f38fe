"""Stalls by a clock that a test sets."""

import threading

import pytest

from ai4u_edu.runtime.tick_monitor import STALL_S, TickMonitor


class Clock:
    """Shows what it is set to."""

    now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def monitor(clock: Clock) -> TickMonitor:
    return TickMonitor(clock, tuple)


def test_what_takes_too_long_is_a_stall_until_it_ends(monitor: TickMonitor, clock: Clock) -> None:
    monitor.begin()
    clock.now = STALL_S
    assert (monitor.is_stalled, monitor.stall) == (False, None)
    clock.now = STALL_S + 3
    stall = monitor.stall
    assert stall is not None
    assert (stall.since, stall.seconds, stall.block) == (0.0, STALL_S + 3, "")
    monitor.begin()  # the next tick of a long command
    assert monitor.stall is None
    clock.now += 100
    monitor.end()
    assert (monitor.is_stalled, monitor.stall, monitor.under_way()) == (False, None, None)


def test_a_stall_is_logged_when_it_begins_and_when_it_ends(
    monitor: TickMonitor, clock: Clock, caplog: pytest.LogCaptureFixture
) -> None:
    monitor.begin()
    for now in (1, 3, 4, 5, 60):
        clock.now = float(now)
        monitor.log_changes()
    monitor.end()
    for now in (61, 62):
        clock.now = float(now)
        monitor.log_changes()
    told = [record.getMessage() for record in caplog.records]
    assert len(told) == 2
    assert told[0].startswith("The world has not answered for 4 s (test_tick_monitor.py, line ")
    assert told[1] == "The world goes on, after about 61 s"


def test_a_process_that_was_stopped_in_a_tick_logs_nothing(
    monitor: TickMonitor, clock: Clock, caplog: pytest.LogCaptureFixture
) -> None:
    monitor.begin()
    clock.now = 3600.0
    monitor.log_changes()
    monitor.begin()
    monitor.log_changes()
    assert not caplog.records


def test_a_thread_that_has_ended_is_nowhere(clock: Clock) -> None:
    monitor = TickMonitor(clock, tuple)
    thread = threading.Thread(target=monitor.begin)
    thread.start()
    thread.join()
    clock.now = 10.0
    stall = monitor.stall
    assert stall is not None
    assert (stall.where, str(stall)) == ("", "The world has not answered for 10 s")
