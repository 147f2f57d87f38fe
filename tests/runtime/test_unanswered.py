"""Blocks that fail, that do not answer, and that must not end the world's thread."""

import asyncio
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, ClassVar

import pytest
from gymnasium.spaces import Box

from ai4u_edu import BasicAgent, Brain, Command, ControlRequestor, RemoteBrain, Scene, Sensor
from ai4u_edu.base.errors import BlockError, NoDecisionError
from ai4u_edu.runtime.runner import Runner
from tests.builders import small_sim, small_world
from tests.runtime.running import running, wait_for, wait_for_tick
from tests.server.rooms import NOWHERE
from tests.waiting import LIMIT_S, until


@pytest.fixture
def runner() -> Iterator[Runner]:
    with running(Runner(Scene.load("box_chase").build(), seed=1)) as runner:
        yield runner


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
    with running(runner):
        with pytest.raises(NoDecisionError, match=r"agent '0' took no decision: Silent answered"):
            runner.step_decision().result(LIMIT_S)
        assert runner.latest.tick == ticks
        runner.resume().result(LIMIT_S)


def test_a_decision_that_a_script_does_not_take_says_what_it_waits_for() -> None:
    runner = Runner(small_sim(brains=[RemoteBrain(port=NOWHERE, skip_frame=4)]))
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

    with running(Runner(small_sim(controller=controller))) as runner:
        error_text = wait_for(runner, lambda snapshot: snapshot.error).error
        assert type(error).__name__ in error_text
        where = "Brain LocalBrain(ScriptController) of agent '0', test_unanswered.py, line"
        assert where in error_text
        fail[0] = False
        runner.reset(seed=9).result(LIMIT_S)
        wait_for_tick(runner, 5)


@pytest.mark.parametrize("error", [*ENDINGS, StopIteration()], ids=repr)
def test_a_commands_ending_is_handed_on_as_an_error(runner: Runner, error: BaseException) -> None:
    def command() -> None:
        raise fresh(error)

    with pytest.raises(BlockError, match=type(error).__name__):
        runner.submit(command).result(LIMIT_S)
    wait_for_tick(runner, runner.latest.tick + 5)


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
    with running(runner):
        error = wait_for(runner, lambda snapshot: snapshot.error).error
        assert "SystemExit (raised by Brain Restless of agent '0'" in error


def test_a_world_that_can_not_be_pictured_says_so_in_the_last_picture(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    class Nameless(Silent):
        """Brain that has a title only at first."""

        fails: ClassVar[bool] = False

        def title(self) -> str:
            if self.fails:
                raise RuntimeError("no title")
            return "me"

    runner = Runner(small_sim(brains=[Nameless()]))
    monkeypatch.setattr(Nameless, "fails", True)
    with running(runner):
        wait_for(runner, lambda snapshot: snapshot.error == "RuntimeError: no title")
        monkeypatch.setattr(Nameless, "fails", False)
        runner.reset().result(LIMIT_S)
        assert runner.latest.error == ""


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
        runner.stop(LIMIT_S)
        assert closed.wait(LIMIT_S)


def test_a_block_that_does_not_answer_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ai4u_edu.runtime.tick_monitor.STALL_S", 0.0)
    with stuck_runner() as (runner, _):
        stall = runner.stall
        assert stall is not None
        assert (stall.block, stall.agent) == ("Sensor Stuck 'stuck'", "0")
        assert stall.where.startswith("test_unanswered.py, line ")
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
    assert (stall.block, stall.where.partition(",")[0]) == ("", "test_unanswered.py")


def test_a_world_that_stands_still_or_waits_for_a_script_is_not_stalled(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("ai4u_edu.runtime.runner.REST_POLL_S", 60.0)
    monkeypatch.setattr("ai4u_edu.runtime.pending_answers.HOLD_POLL_S", 60.0)
    sim = small_sim(brains=[Silent(answer=Command.HOLD)])
    runner = Runner(sim, clock=lambda: 100.0)
    monkeypatch.setattr(
        "ai4u_edu.runtime.tick_monitor.STALL_S", -1.0
    )  # whatever is under way is one
    with running(runner):
        until(lambda: sim.waiting_for_brain and runner.stall is None)
        runner.pause().result(LIMIT_S)
        until(lambda: runner.stall is None)


def test_stopping_leaves_a_stuck_block_behind_and_its_brain_alone(
    caplog: pytest.LogCaptureFixture,
) -> None:
    closed: list[bool] = []
    with stuck_runner() as (runner, _):
        brain = runner.sim.agents[0].brain
        close = brain.close

        def note_and_close() -> None:
            closed.append(True)
            close()

        brain.close = note_and_close  # type: ignore[method-assign]
        waiting = runner.pause()
        # real time: the block does not return before the test lets it, whenever this is over
        runner.stop(timeout=0.01)
        assert runner.is_left_behind
        assert waiting.cancelled()
        assert not closed
        assert "left behind unfinished: Sensor Stuck 'stuck' of agent '0'" in caplog.text
    assert closed  # by its own thread, once it could


@pytest.mark.parametrize("ask", ["pause", "reset", "scale"])
def test_a_long_pause_between_two_ticks_keeps_no_command_waiting(ask: str) -> None:
    sim = ControlRequestor(small_world(), [BasicAgent(body="robot", brains=[Silent()])])
    with running(Runner(sim, time_scale=1e-6)) as runner:  # the next tick is due in hours
        wait_for_tick(runner, 1)
        asked = runner.scale_time(1.0) if ask == "scale" else getattr(runner, ask)()
        asked.result(LIMIT_S)
        if ask == "scale":
            wait_for_tick(runner, 3)


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
