"""The wall clock, the queue of commands and the snapshots."""

import asyncio
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any, ClassVar

import pytest
from gymnasium.spaces import Box

from ai4u_edu import (
    BasicAgent,
    Brain,
    CircleShape,
    Command,
    ControlRequestor,
    LocalBrain,
    RemoteBrain,
    ReplayController,
    Scene,
    Sensor,
    World,
)
from ai4u_edu.base.errors import BlockError, NoDecisionError
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot, capture_snapshot
from tests.builders import small_sim, small_world
from tests.server.rooms import free_port
from tests.waiting import LIMIT_S, until


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
    began = time.perf_counter()  # a busy machine may leave this thread waiting after the start
    runner.start()
    wait_for(runner, 240)
    took = time.perf_counter() - began
    runner.stop()
    # never faster than asked; slower only as far as the machine is busy
    assert took >= 0.95
    assert runner.latest.real_time_factor == pytest.approx(4.0, rel=0.5)


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


def test_as_fast_as_it_goes() -> None:
    runner = Runner(Scene.load("box_chase").build(), time_scale=float("inf"))
    runner.start()
    wait_for(runner, 600)
    runner.stop()
    assert runner.latest.real_time_factor > 1.0


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


def test_pause_lets_keys_go_and_resume_goes_on(runner: Runner) -> None:
    keyboard = runner.sim.agents[0].keyboard
    keyboard.hold(["KeyW"])
    runner.pause().result(LIMIT_S)
    assert keyboard.held() == set()
    tick = runner.latest.tick
    time.sleep(0.1)
    assert runner.latest.tick == tick
    assert runner.latest.paused
    runner.step(3).result(LIMIT_S)
    assert runner.latest.tick == tick + 3
    runner.resume().result(LIMIT_S)
    wait_for(runner, tick + 10)


def test_commands_run_between_two_decisions_in_the_runners_thread(runner: Runner) -> None:
    def look() -> tuple[bool, str]:
        return runner.sim.between_decisions(), threading.current_thread().name

    for _ in range(10):
        assert runner.submit(look).result(LIMIT_S) == (True, "runner")


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
    assert runner.submit(lambda: 5).result(LIMIT_S) == 5
    runner.stop()


def test_a_commands_error_goes_to_whoever_asked(runner: Runner) -> None:
    with pytest.raises(ZeroDivisionError):
        runner.submit(lambda: 1 / 0).result(LIMIT_S)
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
    assert runner.latest.error == (
        "RuntimeError: no idea (while LocalBrain(ScriptController) of agent '0' was deciding)"
    )
    fail[0] = False
    runner.reset(seed=9).result(LIMIT_S)
    wait_for(runner, 5)
    assert runner.latest.error == ""
    assert runner.latest.seed == 9
    runner.stop()


def test_snapshots_are_frozen_and_replaced(runner: Runner) -> None:
    first = runner.latest
    later = runner.wait(first, 5.0)
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
    runner.start()
    runner.stop()
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
    wait_for(runner, 5)
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


@pytest.mark.parametrize(
    ("old", "new"), [("use", "replace_sim"), ("show", "show_past"), ("call", "notify_answer")]
)
def test_old_names_of_methods_still_work_and_warn(runner: Runner, old: str, new: str) -> None:
    with pytest.warns(DeprecationWarning, match=f"Runner.{old} is now Runner.{new}"):
        assert getattr(runner, old) == getattr(runner, new)
    with pytest.raises(AttributeError, match="'Runner' object has no attribute 'unknown'"):
        getattr(runner, "unknown")  # noqa: B009 - a type checker would refuse it


def test_a_world_that_can_not_begin_changes_nothing(runner: Runner) -> None:
    before, other = runner.sim, Scene.load("box_chase").build()

    def fail(_: BasicAgent) -> None:
        raise ZeroDivisionError

    other.agents[0].before_the_reset.connect(fail)
    with pytest.raises(ZeroDivisionError):
        runner.replace_sim(other).result(LIMIT_S)
    assert runner.sim is before
    wait_for(runner, runner.latest.tick + 5)


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


def test_the_past_is_seen_and_changes_nothing(runner: Runner) -> None:
    runner.pause().result(LIMIT_S)
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
    time.sleep(0.25)
    assert runner.latest is seen  # nobody has to draw it again
    runner.show_past(None).result(LIMIT_S)
    assert (runner.latest.past, runner.latest.tick, runner.latest.paused) == ("", live.tick, True)


def test_whoever_looks_at_the_past_has_the_time_stand_still(runner: Runner) -> None:
    keyboard = runner.sim.agents[0].keyboard
    keyboard.hold(["KeyW"])
    runner.show_past(replace(runner.latest, past="then")).result(LIMIT_S)
    ticks = runner.sim.world.ticks
    assert not keyboard.held()
    time.sleep(0.1)
    assert runner.sim.world.ticks == ticks


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


# -- what does not answer, and what must not end the thread --------------------------------------


class Silent(Brain):
    """Answers with the same command, for ever."""

    answer: Any = Command.WAIT

    def decide(self, percept: Any) -> Any:
        return self.answer


@pytest.mark.parametrize(("answer", "ticks"), [(Command.WAIT, 1), (Command.HOLD, 0)])
def test_a_decision_that_does_not_begin_is_refused_and_the_world_goes_on(
    answer: Command, ticks: int
) -> None:
    runner = Runner(small_sim(brains=[Silent(answer=answer, skip_frame=4)]))
    runner.paused = True
    runner.start()
    try:
        with pytest.raises(NoDecisionError, match=r"agent '0' took no decision: Silent answered"):
            runner.step_decision().result(LIMIT_S)
        assert runner.latest.tick == ticks
        runner.resume().result(LIMIT_S)
    finally:
        runner.stop()
    assert not runner.is_left_behind


def test_a_decision_that_a_script_does_not_take_says_what_it_waits_for() -> None:
    runner = Runner(small_sim(brains=[RemoteBrain(port=free_port(), skip_frame=4)]))
    runner.paused = True
    asked = runner.step_decision()
    runner.advance()
    with pytest.raises(NoDecisionError, match="no AI4U script listens at"):
        asked.result(0)
    runner.stop()


def test_the_decision_of_an_agent_that_respawned_in_the_middle_of_one_ends() -> None:
    sim = small_sim(skip_frame=4)
    runner = Runner(sim)
    runner.paused = True
    runner.step(2)
    runner.advance()
    assert sim.is_deciding(sim.agents[0])
    sim.restart(sim.agents[0])
    sim.agents[0].use_brain(Silent(skip_frame=4))
    asked = runner.step_decision()
    runner.advance()
    assert asked.exception(0) is not None


ENDINGS = [SystemExit(3), KeyboardInterrupt(), GeneratorExit(), asyncio.CancelledError()]


def fresh(error: BaseException) -> BaseException:
    return type(error)(*error.args)


@pytest.mark.parametrize("error", ENDINGS, ids=repr)
def test_a_block_can_not_end_the_runners_thread(error: BaseException) -> None:
    fail = [True]

    def controller(percept: Any) -> dict[str, Any]:
        if fail[0]:
            raise fresh(error)
        return {}

    runner = Runner(small_sim(controller=controller))
    runner.start()
    try:
        seen = runner.latest
        while not runner.latest.error:
            seen = runner.wait(seen, 1.0)
        told = runner.latest.error
        assert type(error).__name__ in told
        assert "Brain LocalBrain(ScriptController) of agent '0', test_runner.py, line" in told
        fail[0] = False
        runner.reset(seed=9).result(LIMIT_S)
        wait_for(runner, 5)
    finally:
        runner.stop()


@pytest.mark.parametrize("error", [*ENDINGS, StopIteration()], ids=repr)
def test_a_commands_ending_is_handed_on_as_an_error(runner: Runner, error: BaseException) -> None:
    def command() -> None:
        raise fresh(error)

    with pytest.raises(BlockError, match=type(error).__name__):
        runner.submit(command).result(LIMIT_S)
    wait_for(runner, runner.latest.tick + 5)


def test_without_a_thread_ctrl_c_goes_to_whoever_ticks() -> None:
    def controller(percept: Any) -> dict[str, Any]:
        raise KeyboardInterrupt

    runner = Runner(small_sim(controller=controller))
    with pytest.raises(KeyboardInterrupt):
        runner.advance()
    runner.stop()


def test_a_brain_that_fails_while_the_time_stands_still_is_told_of() -> None:
    class Restless(Silent):
        """Can't be idle, nor be closed."""

        def idle(self) -> None:
            raise SystemExit

        def close(self) -> None:
            raise SystemExit

    runner = Runner(small_sim(brains=[Restless()]))
    runner.paused = True
    runner.start()
    seen = runner.latest
    while not runner.latest.error:
        seen = runner.wait(seen, 1.0)
    assert "SystemExit (raised by Brain Restless of agent '0'" in runner.latest.error
    runner.stop()
    assert not runner.is_left_behind


def test_a_world_that_can_not_be_pictured_says_so_in_the_last_picture() -> None:
    class Nameless(Silent):
        """Has a title only at first."""

        fails: ClassVar[bool] = False

        def title(self) -> str:
            if self.fails:
                raise RuntimeError("no title")
            return "me"

    runner = Runner(small_sim(brains=[Nameless()]))
    runner.start()
    Nameless.fails = True
    seen = runner.latest
    while not runner.latest.error:
        seen = runner.wait(seen, 1.0)
    assert runner.latest.error == "RuntimeError: no title"
    Nameless.fails = False
    runner.reset().result(LIMIT_S)
    assert runner.latest.error == ""
    runner.stop()


class Stuck(Sensor):
    """Does not answer while it is stuck."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.goes_on = threading.Event()
        self.goes_on.set()
        self.is_read = threading.Event()

    def space(self) -> Box:
        return Box(0.0, 1.0, (1,))

    def read(self, body: Any, view: Any) -> list[float]:
        self.is_read.set()
        self.goes_on.wait()
        return [0.0]


@contextmanager
def stuck_runner(**options: Any) -> Iterator[tuple[Runner, Stuck]]:
    """A runner whose thread is in a sensor that does not answer until the end."""
    sensor, closed = Stuck(), threading.Event()
    sim = small_sim([sensor])
    sim.agents[0].brain.close = closed.set  # type: ignore[method-assign]
    runner = Runner(sim, **options)
    sensor.goes_on.clear()
    sensor.is_read.clear()
    runner.start()
    assert sensor.is_read.wait(LIMIT_S)
    try:
        yield runner, sensor
    finally:
        sensor.goes_on.set()
        runner.stop()
        assert closed.wait(LIMIT_S)


def test_a_block_that_does_not_answer_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ai4u_edu.runtime.tick_monitor.STALL_S", 0.0)
    with stuck_runner() as (runner, _):
        stall = runner.stall
        assert stall is not None
        assert (stall.block, stall.agent) == ("Sensor Stuck 'stuck'", "0")
        assert stall.where.startswith("test_runner.py, line ")
        assert str(stall).startswith("Sensor Stuck 'stuck' of agent '0' has not answered for ")
        waiting = runner.pause()
        assert not waiting.done()


def test_a_command_that_does_not_end_is_a_stall_too(
    runner: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ai4u_edu.runtime.tick_monitor.STALL_S", 0.0)
    begun, goes_on = threading.Event(), threading.Event()

    def command() -> None:
        begun.set()
        goes_on.wait()

    runner.submit(command)
    assert begun.wait(LIMIT_S)
    stall = runner.stall
    goes_on.set()
    assert stall is not None
    assert (stall.block, stall.where.partition(",")[0]) == ("", "test_runner.py")


def test_a_world_that_stands_still_or_waits_for_a_script_is_not_stalled(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("ai4u_edu.runtime.world_thread.REST_POLL_S", 60.0)
    monkeypatch.setattr("ai4u_edu.runtime.world_thread.HOLD_POLL_S", 60.0)
    sim = small_sim(brains=[Silent(answer=Command.HOLD)])
    runner = Runner(sim, clock=lambda: 100.0)
    monkeypatch.setattr(
        "ai4u_edu.runtime.tick_monitor.STALL_S", -1.0
    )  # whatever is under way is one
    runner.start()
    until(lambda: sim.waiting_for_brain and runner.stall is None)
    runner.pause().result(LIMIT_S)
    until(lambda: runner.stall is None)
    runner.stop()


def test_stopping_leaves_a_stuck_block_behind_and_its_brain_alone(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr("ai4u_edu.runtime.world_thread.STOP_S", 0.01)
    closed: list[bool] = []
    with stuck_runner() as (runner, _):
        brain = runner.sim.agents[0].brain
        close = brain.close

        def note_and_close() -> None:
            closed.append(True)
            close()

        brain.close = note_and_close  # type: ignore[method-assign]
        waiting = runner.pause()
        runner.stop()
        assert runner.is_left_behind
        assert waiting.cancelled()
        assert not closed
        assert "left behind unfinished: Sensor Stuck 'stuck' of agent '0'" in caplog.text
        monkeypatch.undo()
    assert closed  # by its own thread, once it could


@pytest.mark.parametrize("ask", ["pause", "reset", "scale"])
def test_a_long_pause_between_two_ticks_keeps_no_command_waiting(ask: str) -> None:
    sim = ControlRequestor(small_world(), [BasicAgent(body="robot", brains=[Silent()])])
    runner = Runner(sim, time_scale=0.0001)  # a tick takes minutes
    runner.start()
    wait_for(runner, 1)
    asked = runner.scale_time(1.0) if ask == "scale" else getattr(runner, ask)()
    asked.result(LIMIT_S)
    if ask == "scale":
        wait_for(runner, 3)
    runner.stop()
    assert not runner.is_left_behind


def test_many_ticks_at_once_end_with_an_error_or_with_the_runner() -> None:
    decisions = []

    def controller(percept: Any) -> dict[str, Any]:
        decisions.append(1)
        if len(decisions) == 3:
            raise RuntimeError("enough")
        return {}

    runner = Runner(small_sim(controller=controller))
    runner.paused = True
    runner.step(10**9)
    runner.advance()
    assert len(decisions) == 3
    runner.stop()
