"""A world that a teacher holds stands still, whatever its pages ask for."""

import math
from collections.abc import Callable

import pytest

from ai4u_edu import WASDRBMoveController
from ai4u_edu.base.errors import NoDecisionError
from ai4u_edu.blocks.keyboard import Keyboard
from ai4u_edu.runtime.runner import Runner
from tests.builders import small_sim


def advance(runner: Runner, times: int = 2) -> None:
    for _ in range(times):
        runner.advance()


def driven(time_scale: float = 1.0) -> Runner:
    sim = small_sim(controller=WASDRBMoveController())
    sim.agents[0].keyboard = Keyboard(clock=lambda: 0.0)  # holds keys until they are released
    return Runner(sim, seed=1, time_scale=time_scale)


@pytest.mark.slow
@pytest.mark.parametrize("time_scale", [1.0, math.inf])
def test_it_stands_still_with_its_keys_released_and_goes_on(time_scale: float) -> None:
    runner = driven(time_scale)
    advance(runner)
    keyboard = runner.sim.agents[0].keyboard
    keyboard.hold({"KeyW"})
    runner.hold(True)
    runner.advance()
    ticks = runner.sim.world.ticks
    advance(runner)
    assert (runner.sim.world.ticks, runner.latest.waiting) == (ticks, "teacher")
    assert keyboard.held() == frozenset()
    runner.hold(False)
    advance(runner)
    assert runner.sim.world.ticks > ticks
    assert runner.latest.waiting == ""


@pytest.mark.slow
@pytest.mark.parametrize(
    "ask",
    [
        Runner.resume,
        *(
            pytest.param(each, marks=pytest.mark.nightly)
            for each in (Runner.start_episode, Runner.try_again, Runner.new_start)
        ),
        lambda runner: runner.replace_sim(small_sim(), seed=3),
    ],
)
def test_nothing_that_a_page_asks_for_ends_it(ask: Callable[[Runner], object]) -> None:
    runner = Runner(small_sim(controller=WASDRBMoveController()), seed=1, wait_for_key=True)
    runner.hold(True)
    advance(runner)
    ask(runner)
    advance(runner)
    assert (runner.sim.world.ticks, runner.latest.waiting) == (0, "teacher")


def test_it_can_not_be_stepped() -> None:
    runner = driven()
    runner.pause()
    runner.hold(True)
    for future in (runner.step(), runner.step_decision()):
        runner.advance()
        with pytest.raises(NoDecisionError, match="teacher"):
            future.result()
    assert runner.sim.world.ticks == 0


def test_a_world_that_was_paused_is_paused_afterwards() -> None:
    runner = driven()
    runner.pause()
    runner.hold(True)
    runner.hold(False)
    advance(runner)
    assert (runner.sim.world.ticks, runner.latest.paused, runner.latest.waiting) == (0, True, "")
