"""Times by a clock at which a world ticks, runs its commands and is drawn."""

import time
from concurrent.futures import Future
from typing import Any

import pytest

from ai4u_edu import BasicAgent, CircleShape, ControlRequestor, LocalBrain, Scene, World
from ai4u_edu.runtime.clock import MAX_LAG_S
from ai4u_edu.runtime.runner import DECISION_WAIT_S, Runner
from ai4u_edu.snapshot import Snapshot, capture_snapshot
from tests.builders import small_sim
from tests.runtime.clocks import ManualClock
from tests.runtime.running import running, wait_for_tick


def advance(runner: Runner, times: int) -> None:
    for _ in range(times):
        runner.advance()


def advance_until_done(runner: Runner, asked: "Future[Any]") -> None:
    for _ in range(100):
        if asked.done():
            return
        runner.advance()
    pytest.fail("a hundred ticks later it still waits")


def test_ticks_keep_to_the_clock() -> None:
    clock = ManualClock()
    runner = Runner(Scene.load("box_chase").build(), seed=1, time_scale=4.0, clock=clock)
    began = clock.now
    advance(runner, 240)
    assert runner.sim.world.ticks == 240
    assert clock.now - began == pytest.approx(1.0)
    assert runner.latest.real_time_factor == pytest.approx(4.0, rel=0.05)
    assert runner.lateness == pytest.approx(0.0, abs=1e-9)


def test_no_tick_is_earlier_than_the_wall_clock_allows() -> None:
    runner = Runner(Scene.load("box_chase").build(), seed=1, time_scale=4.0)
    # real time: a least time, measured from before the start; a busy machine only adds to it
    began = time.perf_counter()
    with running(runner):
        wait_for_tick(runner, 120)
        # real time: as above
        assert time.perf_counter() - began >= 119 / 240


@pytest.mark.parametrize(("delay", "skipped"), [(0.2, 0.0), (10.0, 10.0 - MAX_LAG_S)])
def test_a_short_delay_is_caught_up_and_a_long_one_is_skipped(delay: float, skipped: float) -> None:
    clock = ManualClock()
    runner = Runner(small_sim(), seed=1, clock=clock)
    began = clock.now
    advance(runner, 30)
    clock.now += delay
    runner.advance()
    assert runner.lateness > 0
    advance(runner, 29)
    # the tick at which the delay is noticed was due already
    assert clock.now - began - skipped == pytest.approx(1.0, abs=1.1 / 60)


def test_a_world_without_a_pace_does_not_sleep(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = ManualClock()
    sim = Scene.load("box_chase").build()
    runner = Runner(sim, time_scale=float("inf"), clock=clock)
    decide = sim.step_decision

    def step_decision() -> int:
        clock.now += 0.01
        return decide()

    monkeypatch.setattr(sim, "step_decision", step_decision)
    advance(runner, 100)
    assert sim.world.ticks == 500
    assert clock.slept == []
    assert runner.latest.real_time_factor == pytest.approx(5 / 60 / 0.01, rel=0.05)


def test_at_one_go_a_decision_is_what_it_is_tick_by_tick() -> None:
    seen = []
    for whole_decision in (False, True):
        sim = Scene.load("box_chase").build()
        runner = Runner(sim, seed=3)
        while sim.agents[0].steps < 20:
            runner._tick(whole_decision=whole_decision)
        state = capture_snapshot(sim)
        seen.append((state.tick, state.bodies, state.agents[0].percept, state.agents[0].reward))
        assert runner._schedule.ticked == sim.world.ticks == 100
    assert seen[0] == seen[1]


def test_a_command_waits_until_the_decision_is_over() -> None:
    runner = Runner(Scene.load("box_chase").build(), seed=1, clock=ManualClock())
    for decision in range(1, 4):
        runner.advance()
        asked = runner.submit(lambda: runner.sim.world.ticks)
        advance_until_done(runner, asked)
        assert asked.result() == 5 * decision


def overlapping() -> ControlRequestor:
    """Two agents whose decisions have no common end for long."""
    world = World()
    agents = []
    for index, skip in enumerate((6, 7)):
        world.add_body(f"robot{index}", CircleShape(), position=(0, 3 * index))
        brain = LocalBrain(controller=lambda percept: {}, skip_frame=skip)
        agents.append(BasicAgent(body=f"robot{index}", id=str(index), brains=[brain]))
    return ControlRequestor(world, agents)


def test_commands_are_not_starved_where_decisions_always_overlap() -> None:
    clock = ManualClock()
    runner = Runner(overlapping(), time_scale=0.5, clock=clock)
    runner.advance()
    began = clock.now
    asked = runner.submit(runner.sim.between_decisions)
    advance_until_done(runner, asked)
    assert asked.result() is False
    assert DECISION_WAIT_S <= clock.now - began <= DECISION_WAIT_S + 2 / 30


@pytest.mark.parametrize(
    ("takes", "least", "most"), [(0.0, 60, 60), (0.004, 28, 34), (0.02, 9, 11)]
)
def test_snapshots_that_take_long_are_fewer_and_the_ticks_are_not(
    takes: float, least: int, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    now, shown = 100.0, 0
    runner = Runner(Scene.load("box_chase").build(), seed=1, clock=lambda: now)
    picture = runner._picture

    def slow_picture() -> Snapshot:
        nonlocal now, shown
        now += takes
        shown += 1
        return picture()

    monkeypatch.setattr(runner, "_picture", slow_picture)
    for number in range(60):
        runner._schedule.due = now = max(now, 100 + number / 60)
        runner._tick()
    assert runner.sim.world.ticks == 60
    assert least <= shown <= most


@pytest.mark.parametrize(
    ("ticks", "shown"), [((1, 1), 60), ((16, 1), 30), ((16, 16), 30), ((4, 4), 60)]
)
def test_a_picture_waits_for_a_tick_that_leaves_time_for_it(
    ticks: tuple[int, int], shown: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    now, after = 100.0, []
    runner = Runner(Scene.load("box_chase").build(), seed=1, clock=lambda: now)
    picture, tick = runner._picture, runner.sim.tick

    def slow_tick() -> None:
        nonlocal now
        tick()
        now += ticks[runner.sim.world.ticks % 2] / 1000

    def slow_picture() -> Snapshot:
        nonlocal now
        now += 0.001
        after.append(ticks[runner.sim.world.ticks % 2])
        return picture()

    monkeypatch.setattr(runner.sim, "tick", slow_tick)
    monkeypatch.setattr(runner, "_picture", slow_picture)
    for number in range(60):
        now = runner._schedule.due = 100 + number / 60
        runner._tick()
    assert len(after) == pytest.approx(shown, abs=1)
    assert set(after[1:]) == {min(ticks)}


@pytest.mark.parametrize("scale", [0.0, -1.0, float("nan")])
def test_bad_time_scale(scale: float) -> None:
    with pytest.raises(ValueError, match="time scale: expected a number above 0, got"):
        Runner(Scene.load("box_chase").build(), time_scale=scale)
