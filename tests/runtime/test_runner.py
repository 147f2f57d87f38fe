"""The wall clock, the queue of commands and the snapshots."""

import threading
from collections.abc import Iterator
from dataclasses import replace
from threading import Semaphore
from typing import Any

import pytest

from ai4u_edu import (
    BasicAgent,
    LocalBrain,
    ReplayController,
    Scene,
)
from ai4u_edu.blocks.keyboard import Keyboard
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.runtime.runner import Runner
from tests.builders import small_sim
from tests.runtime.clocks import ManualClock
from tests.runtime.running import running, wait_for, wait_for_tick
from tests.waiting import LIMIT_S


@pytest.fixture
def runner() -> Iterator[Runner]:
    with running(Runner(Scene.load("box_chase").build(), seed=1)) as runner:
        yield runner


def test_pause_lets_keys_go_and_resume_goes_on(runner: Runner) -> None:
    keyboard = runner.sim.agents[0].keyboard
    keyboard.hold(["KeyW"])
    runner.pause().result(LIMIT_S)
    assert keyboard.held() == set()
    tick = runner.latest.tick
    for _ in range(3):  # it goes on drawing, and does not tick
        seen = runner.wait(runner.latest, LIMIT_S)
        assert (seen.tick, seen.paused) == (tick, True)
    runner.step(3).result(LIMIT_S)
    assert runner.latest.tick == tick + 3
    runner.resume().result(LIMIT_S)
    wait_for_tick(runner, tick + 10)


def test_commands_run_between_two_decisions_in_the_runners_thread(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # no decision takes so long that a command runs in the middle of it
    monkeypatch.setattr("ai4u_edu.runtime.runner.DECISION_WAIT_S", LIMIT_S)
    sim = Scene.load("box_chase").build()

    def look() -> tuple[bool, str]:
        return sim.between_decisions(), threading.current_thread().name

    with running(Runner(sim, seed=1, clock=ManualClock())) as runner:
        for _ in range(10):
            assert runner.submit(look).result(LIMIT_S) == (True, "runner")


def test_a_commands_error_goes_to_whoever_asked(runner: Runner) -> None:
    with pytest.raises(ZeroDivisionError):
        runner.submit(lambda: 1 / 0).result(LIMIT_S)
    assert runner.latest.error == ""
    wait_for_tick(runner, runner.latest.tick + 5)


def test_an_error_in_a_block_stops_the_world_with_a_sentence_and_reset_goes_on() -> None:
    fail = [True]

    def controller(percept: Any) -> dict[str, Any]:
        if fail[0] and percept["done"] is False:
            raise RuntimeError("no idea")
        return {}

    with running(Runner(small_sim(controller=controller))) as runner:
        assert wait_for(runner, lambda snapshot: snapshot.error).error == (
            "RuntimeError: no idea (while LocalBrain(ScriptController) of agent '0' was deciding)"
        )
        fail[0] = False
        runner.reset(seed=9).result(LIMIT_S)
        wait_for_tick(runner, 5)
        assert runner.latest.error == ""
        assert runner.latest.seed == 9


def test_snapshots_are_frozen_and_replaced(runner: Runner) -> None:
    first = runner.latest
    later = runner.wait(first, LIMIT_S)
    assert later is not first
    assert later.static_scene is first.static_scene
    with pytest.raises(AttributeError):
        first.tick = 3  # type: ignore[misc]  # that it can't be set is what is tested
    percept = first.agents[0].percept
    assert percept["vision"].flags.writeable is False


def test_the_snapshot_shows_the_percept_that_the_brain_got(runner: Runner) -> None:
    def look() -> bool:
        return runner.latest.agents[0].percept is runner.sim.agents[0].percept

    runner.pause().result(LIMIT_S)
    assert runner.submit(look).result(LIMIT_S)


def test_stop_cancels_what_still_waits() -> None:
    runner = Runner(Scene.load("box_chase").build())
    with running(runner):
        pass
    future = runner.submit(lambda: 1)
    assert future.cancelled()


def test_another_world_takes_this_ones_place(runner: Runner) -> None:
    before = runner.sim
    before.agents[0].keyboard.hold(["KeyW"])
    closed: list[str] = []
    before.agents[0].brain.close = lambda: closed.append("old")  # type: ignore[method-assign]
    other = Scene.load("donut").build()
    runner.pause().result(LIMIT_S)
    runner.replace_sim(other, seed=7).result(LIMIT_S)
    assert runner.sim is other
    assert (runner.latest.seed, runner.latest.tick, runner.latest.paused) == (7, 0, True)
    assert {body.name for body in runner.latest.static_scene.bodies} == set(other.world.bodies)
    assert closed == ["old"]
    assert not before.agents[0].keyboard.held()
    runner.resume().result(LIMIT_S)
    wait_for_tick(runner, 5)
    assert other.world.ticks >= 5


def test_another_world_goes_on_where_it_stands_with_the_brain_that_it_shares(
    runner: Runner,
) -> None:
    runner.pause().result(LIMIT_S)
    brain = runner.sim.agents[0].brain
    brain.close = lambda: pytest.fail("it still drives")  # type: ignore[method-assign]
    other = Scene.load("box_chase").build()
    other.reset(3)
    other.step()
    other.agents[0].use_brain(brain)
    ticks = other.world.ticks
    runner.replace_sim(other).result(LIMIT_S)
    assert (runner.latest.seed, runner.latest.tick) == (3, ticks)
    del brain.close


def test_a_world_that_can_not_begin_changes_nothing(runner: Runner) -> None:
    before, other = runner.sim, Scene.load("box_chase").build()

    def fail(_: BasicAgent) -> None:
        raise ZeroDivisionError

    other.agents[0].before_the_reset.connect(fail)
    with pytest.raises(ZeroDivisionError):
        runner.replace_sim(other).result(LIMIT_S)
    assert runner.sim is before
    wait_for_tick(runner, runner.latest.tick + 5)


def test_the_recorder_goes_along_to_another_world() -> None:
    sim = Scene.load("box_chase").build()
    recorder = Recorder(sim)
    runner = Runner(sim, seed=1, recorder=recorder)
    for _ in range(20):
        sim.tick()
    runner.replace_sim(Scene.load("donut").build(), seed=2)
    runner.advance()
    while runner.sim.agents[0].steps < 4:
        runner.sim.tick()
    runner.reset(3)
    runner.advance()
    assert [episode.seed for episode in recorder.episodes] == [1, 2]
    assert recorder.episodes[0].changed is None
    assert Replay(recorder.episodes[1]).verdict.exact


def driven(runner: Runner, actions: list[dict[str, list[float]]]) -> list[tuple[Any, ...]]:
    """Return percept, reward terms, poses and tick after each of some decisions."""
    sim, found = runner.sim, []
    sim.agents[0].use_brain(LocalBrain(controller=ReplayController(actions=actions)))
    for _ in actions:
        percept = sim.step()
        poses = [
            (body.pose, body.velocity, body.angular_velocity) for body in sim.world.bodies.values()
        ]
        found.append((percept.data, sim.agents[0].reward_terms, poses, sim.world.ticks))
    return found


TURNS: list[dict[str, list[float]]] = [
    {"move": [0.1, 0.5 - 0.05 * step, 0.0, 0.0]} for step in range(20)
]


def test_the_past_is_seen_and_changes_nothing(
    runner: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    runner.pause().result(LIMIT_S)
    turns = Semaphore(0)  # of the paused world; each draws it
    monkeypatch.setattr(runner.sim.agents[0].brain, "idle", turns.release)
    live = runner.latest
    past = replace(live, past="step 1 of 3", tick=-7, paused=False)
    runner.show_past(past).result(LIMIT_S)
    seen = runner.latest
    assert (seen.past, seen.tick, seen.paused, seen.static_scene) == (
        "step 1 of 3",
        -7,
        True,
        live.static_scene,
    )
    for _ in range(2):
        assert turns.acquire(timeout=LIMIT_S)
    assert runner.latest is seen  # nobody has to draw it again
    runner.show_past(None).result(LIMIT_S)
    assert (runner.latest.past, runner.latest.tick, runner.latest.paused) == ("", live.tick, True)


def test_whoever_looks_at_the_past_has_the_time_stand_still() -> None:
    runner = Runner(Scene.load("box_chase").build(), seed=1)
    keyboard = runner.sim.agents[0].keyboard = Keyboard(clock=lambda: 0.0)
    runner.advance()
    keyboard.hold(["KeyW"])
    runner.show_past(replace(runner.latest, past="then"))
    for _ in range(10):  # until no agent is in a decision
        if not runner.latest.past:
            runner.advance()
    assert runner.latest.past == "then"
    ticks = runner.sim.world.ticks
    assert not keyboard.held()
    for _ in range(3):
        runner.advance()
    assert runner.sim.world.ticks == ticks > 0


@pytest.mark.parametrize("order", ["resume", "reset", "step"])
def test_as_soon_as_something_goes_on_it_is_now(runner: Runner, order: str) -> None:
    runner.show_past(replace(runner.latest, past="then")).result(LIMIT_S)
    getattr(runner, order)().result(LIMIT_S)
    assert runner.latest.past == ""


def test_a_world_goes_on_from_the_past_bit_for_bit() -> None:
    sim = Scene.load("box_chase").build()
    recorder = Recorder(sim)
    runner = Runner(sim, seed=6, recorder=recorder)
    there = driven(runner, TURNS)
    runner.reset(7)
    runner.advance()
    brain = sim.agents[0].brain
    done = runner.continue_from(Replay(recorder.episodes[-1]), 12)
    runner.paused = True
    runner._run_commands()
    done.result(0)
    assert runner.sim is sim
    assert sim.agents[0].brain is brain
    assert (runner.latest.seed, runner.latest.tick, runner.latest.past) == (6, 60, "")
    assert not runner.paused
    assert driven(runner, TURNS[12:]) == there[12:]
    runner.reset()
    runner.advance()
    continued = recorder.episodes[-1]
    assert len(continued.agents[0]) == 20  # what came before belongs to it
    assert Replay(continued).verdict.exact
    assert continued.agents[0].driver == "Recording, LocalBrain(ReplayController)"


def test_an_episode_of_another_world_is_continued_in_its_own() -> None:
    other = Runner(Scene.load("donut").build(), seed=3)
    recorder = Recorder(other.sim)
    there = driven(other, TURNS)
    recorder.finish()
    sim = Scene.load("box_chase").build()
    runner = Runner(sim, seed=1, recorder=Recorder(sim))
    done = runner.continue_from(Replay(recorder.episodes[-1]), 5)
    runner._run_commands()
    done.result(0)
    assert runner.sim is not sim
    assert driven(runner, TURNS[5:]) == there[5:]
    assert runner.recorder is not None
    runner.recorder.finish()
    assert Replay(runner.recorder.episodes[-1]).verdict.exact
    assert len(runner.recorder.episodes[-1].agents[0]) == 20
