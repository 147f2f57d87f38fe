"""The wall clock, the queue of commands and the snapshots."""

import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest

from ai4u_edu import BasicAgent, CircleShape, ControlRequestor, LocalBrain, Scene, World
from ai4u_edu.runner import Runner
from tests.builders import small_sim


@pytest.fixture
def runner() -> Iterator[Runner]:
    runner = Runner(Scene.load("box_chase").build(), seed=1)
    runner.start()
    yield runner
    runner.stop()


def wait_for(runner: Runner, ticks: int) -> None:
    seen = runner.latest
    while runner.latest.tick < ticks:
        seen = runner.wait(seen, 1.0)


def test_it_keeps_the_wall_clock() -> None:
    runner = Runner(Scene.load("box_chase").build(), seed=1, time_scale=4.0)
    runner.start()
    began = time.perf_counter()
    wait_for(runner, 240)
    took = time.perf_counter() - began
    runner.stop()
    # never faster than asked; slower only as far as the machine is busy
    assert took >= 0.95
    assert runner.latest.real_time_factor == pytest.approx(4.0, rel=0.5)


def test_as_fast_as_it_goes() -> None:
    runner = Runner(Scene.load("box_chase").build(), time_scale=float("inf"))
    runner.start()
    wait_for(runner, 600)
    runner.stop()
    assert runner.latest.real_time_factor > 1.0


@pytest.mark.parametrize("scale", [0.0, -1.0, float("nan")])
def test_bad_time_scale(scale: float) -> None:
    with pytest.raises(ValueError, match="time scale: expected a number above 0, got"):
        Runner(Scene.load("box_chase").build(), time_scale=scale)


def test_pause_lets_keys_go_and_resume_goes_on(runner: Runner) -> None:
    keyboard = runner.sim.agents[0].keyboard
    keyboard.hold(["KeyW"])
    runner.pause().result(5)
    assert keyboard.held() == set()
    tick = runner.latest.tick
    time.sleep(0.1)
    assert runner.latest.tick == tick
    assert runner.latest.paused
    runner.step(3).result(5)
    assert runner.latest.tick == tick + 3
    runner.resume().result(5)
    wait_for(runner, tick + 10)


def test_commands_run_between_two_decisions_in_the_runners_thread(runner: Runner) -> None:
    def look() -> tuple[bool, str]:
        return runner.sim.between_decisions(), threading.current_thread().name

    for _ in range(10):
        assert runner.submit(look).result(5) == (True, "runner")


def test_commands_are_not_starved_where_decisions_always_overlap() -> None:
    world = World()
    agents = []
    for index, skip in enumerate((6, 7)):
        world.add_body(f"robot{index}", CircleShape(), position=(0, 3 * index))
        brain = LocalBrain(controller=lambda percept: {}, skip_frame=skip)
        agents.append(BasicAgent(body=f"robot{index}", id=str(index), brains=[brain]))
    sim = ControlRequestor(world, agents)
    runner = Runner(sim, time_scale=0.5)
    runner.start()
    assert runner.submit(lambda: 5).result(5) == 5
    runner.stop()


def test_a_commands_error_goes_to_whoever_asked(runner: Runner) -> None:
    with pytest.raises(ZeroDivisionError):
        runner.submit(lambda: 1 / 0).result(5)
    assert runner.latest.error == ""
    wait_for(runner, runner.latest.tick + 5)


def test_an_error_in_a_block_stops_the_world_with_a_sentence_and_reset_goes_on() -> None:
    fail = [True]

    def controller(percept: Any) -> dict[str, Any]:
        if fail[0] and percept["done"] is False:
            raise RuntimeError("no idea")
        return {}

    runner = Runner(small_sim(controller=controller))
    runner.start()
    seen = runner.latest
    while not runner.latest.error:
        seen = runner.wait(seen, 1.0)
    assert runner.latest.error == "RuntimeError: no idea"
    fail[0] = False
    runner.reset(seed=9).result(5)
    wait_for(runner, 5)
    assert runner.latest.error == ""
    assert runner.latest.seed == 9
    runner.stop()


def test_snapshots_are_frozen_and_replaced(runner: Runner) -> None:
    first = runner.latest
    later = runner.wait(first, 5.0)
    assert later is not first
    assert later.stage is first.stage
    with pytest.raises(AttributeError):
        first.tick = 3  # type: ignore[misc]  # that it can't be set is what is tested
    percept = first.agents[0].percept
    assert percept["vision"].flags.writeable is False


def test_the_snapshot_shows_the_percept_that_the_brain_got(runner: Runner) -> None:
    def look() -> bool:
        return runner.latest.agents[0].percept is runner.sim.agents[0].percept

    runner.pause().result(5)
    assert runner.submit(look).result(5)


def test_stop_cancels_what_still_waits() -> None:
    runner = Runner(Scene.load("box_chase").build())
    runner.start()
    runner.stop()
    future = runner.submit(lambda: 1)
    assert future.cancelled()
