"""Worlds that wait for a key, seeds that repeat, and the time of an episode."""

import math
from collections.abc import Callable
from typing import Any

import pytest

from ai4u_edu import (
    BasicAgent,
    CircleShape,
    Command,
    ControlRequestor,
    LocalBrain,
    RBMoveActuator,
    RemoteBrain,
    Scene,
    WASDRBMoveController,
    World,
)
from ai4u_edu.recording import Recorder
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import capture_bodies
from tests.builders import small_sim, still
from tests.page.server.rooms import NOWHERE
from tests.runtime.running import running, wait_for_tick
from tests.waiting import LIMIT_S


def played_sim(*controllers: Any) -> ControlRequestor:
    """A world with an agent for each controller."""
    world, agents = World(), []
    for number, controller in enumerate(controllers):
        world.add_body(f"body {number}", CircleShape(radius=0.5), position=(0, 3 * number))
        brain = controller
        if not isinstance(controller, RemoteBrain):
            brain = LocalBrain(controller=controller, skip_frame=0)
        agents.append(
            BasicAgent(
                body=f"body {number}",
                id=str(number),
                actuators=[RBMoveActuator(move_amount=2)],
                brains=[brain],
            )
        )
    return ControlRequestor(world, agents)


def spin(_percept: Any) -> dict[str, Any]:
    return {"move": [0, 0.5, 0, 0]}


def advance(runner: Runner, times: int = 3) -> None:
    for _ in range(times):
        runner.advance()


@pytest.mark.parametrize("time_scale", [1.0, math.inf])
def test_a_world_waits_for_the_person_and_so_do_all_others(time_scale: float) -> None:
    sim = played_sim(WASDRBMoveController(), spin)
    runner = Runner(sim, seed=1, wait_for_key=True, time_scale=time_scale)
    before = capture_bodies(sim)
    advance(runner)
    assert (sim.world.ticks, runner.latest.waiting, runner.is_waiting_for_key) == (0, "key", True)
    assert capture_bodies(sim) == before
    runner.start_episode()
    advance(runner)
    assert sim.world.ticks > 0
    assert (runner.latest.waiting, runner.is_waiting_for_key) == ("", False)
    assert sim.agent("1").last_action["move"][1] == 0.5


@pytest.mark.parametrize(
    "begin",
    [
        Runner.reset,
        Runner.try_again,
        Runner.new_start,
        lambda runner: runner.submit(runner.sim.reset),
    ],
)
def test_it_waits_again_after_each_reset(begin: Callable[[Runner], object]) -> None:
    sim = played_sim(WASDRBMoveController())
    runner = Runner(sim, seed=1, wait_for_key=True)
    runner.start_episode()
    advance(runner)
    begin(runner)
    advance(runner)
    assert (sim.episode, sim.world.ticks, runner.latest.waiting) == (2, 0, "key")


def test_it_waits_after_a_reset_by_another_agents_brain_and_says_so() -> None:
    def restless(_percept: Any) -> Any:
        return Command.RESTART if sim.world.ticks == 5 else {}

    sim = played_sim(WASDRBMoveController(), restless)
    runner = Runner(sim, seed=1, wait_for_key=True)
    runner.start_episode()
    advance(runner, 10)
    assert (sim.episode, sim.world.ticks) == (2, 0)
    assert (runner.latest.episode, runner.latest.waiting) == (2, "key")


def test_the_person_may_sit_at_any_agent() -> None:
    runner = Runner(played_sim(spin, WASDRBMoveController()), wait_for_key=True)
    advance(runner)
    assert runner.latest.waiting == "key"


def test_nothing_waits_where_no_person_drives() -> None:
    for controller in (spin, RemoteBrain(port=NOWHERE)):
        sim = played_sim(controller)
        advance(Runner(sim, wait_for_key=True))
        assert sim.world.ticks > 0


def test_who_takes_an_agent_over_in_an_episode_does_not_stop_it() -> None:
    sim = played_sim(spin)
    runner = Runner(sim, seed=1, wait_for_key=True)
    advance(runner)
    sim.agents[0].use_brain(LocalBrain(controller=WASDRBMoveController(), skip_frame=0))
    ticks = sim.world.ticks
    advance(runner)
    assert sim.world.ticks == ticks + 3
    runner.reset()
    advance(runner)
    assert sim.world.ticks == 0


def test_a_runner_that_is_not_told_to_wait_runs() -> None:
    sim = played_sim(WASDRBMoveController())
    advance(Runner(sim, seed=1))
    assert sim.world.ticks == 3


def test_a_scene_can_choose_not_to_wait() -> None:
    text = Scene.load("box_chase").dumps()
    assert "wait_for_key" not in text
    scene = Scene.loads(f"{text}\nwait_for_key: false\n")
    sim = scene.build()
    advance(Runner(sim, wait_for_key=True))
    assert sim.world.ticks == 3


def test_buttons_step_and_a_paused_world_goes_on_waiting() -> None:
    sim = played_sim(WASDRBMoveController())
    runner = Runner(sim, seed=1, wait_for_key=True)
    runner.pause()
    runner.start_episode()
    runner.resume()
    advance(runner)
    assert (sim.world.ticks, runner.latest.waiting) == (0, "key")
    runner.pause()
    runner.step()
    runner.advance()
    runner.step_decision()
    runner.advance()
    assert sim.world.ticks == 2
    assert runner.latest.waiting == ""


@pytest.mark.slow
def test_waiting_changes_no_number_and_records_nothing() -> None:
    found = []
    for waits in (False, True):
        sim = Scene.load("sumo").build()
        recorder = Recorder(sim)
        runner = Runner(sim, seed=5, recorder=recorder, wait_for_key=waits)
        advance(runner, 0 if not waits else 4)
        current = recorder.current_episode()
        assert current is None or not any(map(len, current.agents))
        runner.start_episode()
        while sim.world.ticks < 60:
            runner.advance()
        episode = recorder.current_episode()
        assert episode is not None
        found.append((capture_bodies(sim), [len(agent) for agent in episode.agents]))
    assert found[0] == found[1]


def test_a_key_starts_a_world_with_a_thread_at_once() -> None:
    sim = played_sim(WASDRBMoveController())
    with running(Runner(sim, seed=1, wait_for_key=True)) as runner:
        runner.start_episode().result(LIMIT_S)
        wait_for_tick(runner, 1)


# -- seeds ---------------------------------------------------------------------------------------


def seeds(runner: Runner, *commands: Callable[[Runner], object]) -> list[int]:
    """Return the seed after each of some commands."""
    found = []
    for command in commands:
        command(runner)
        runner.advance()
        found.append(runner.latest.seed)
    return found


def test_try_again_repeats_the_start_and_new_start_draws_another() -> None:
    runner = Runner(small_sim(), seed=7)
    again, new, after, reset = seeds(
        runner, Runner.try_again, Runner.new_start, Runner.try_again, Runner.reset
    )
    assert again == 7
    assert new == after != 7
    assert reset != new
    twin = Runner(small_sim(), seed=7)
    assert seeds(twin, Runner.new_start, Runner.reset) == [new, reset]  # chance from the seed alone


def test_a_locked_seed_holds_for_every_reset_without_one() -> None:
    sim = small_sim()
    runner = Runner(sim, seed=7)
    runner.lock_seed(True)
    assert seeds(runner, Runner.reset, lambda _: sim.reset(), Runner.try_again) == [7, 7, 7]
    assert runner.latest.is_seed_locked
    (new,) = seeds(runner, Runner.new_start)
    assert new != 7
    assert seeds(runner, Runner.reset, lambda runner: runner.reset(3)) == [new, 3]
    assert seeds(runner, Runner.reset) == [3]
    runner.lock_seed(False)
    assert seeds(runner, Runner.reset) != [3]


def test_another_world_keeps_the_lock() -> None:
    runner = Runner(small_sim(), seed=7)
    runner.lock_seed(True)
    runner.replace_sim(small_sim())
    runner.advance()
    assert runner.latest.is_seed_locked


# -- the time of an episode ----------------------------------------------------------------------


def test_the_clock_stops_at_the_end_and_begins_again() -> None:
    sim = small_sim(controller=still)
    runner = Runner(sim, seed=1)
    advance(runner, 5)
    assert runner.latest.episode_time == runner.latest.time
    sim.agents[0].add_reward(1, request_done=True)
    advance(runner, 10)
    runner.pause()
    runner.advance()
    latest = runner.latest
    assert latest.agents[0].terminated
    assert latest.episode_time == pytest.approx(6 / 60)
    assert latest.time == pytest.approx(15 / 60)
    runner.reset()
    runner.advance()
    assert runner.latest.episode_time == 0


def test_it_stops_for_the_persons_and_not_for_the_others() -> None:
    sim = played_sim(WASDRBMoveController(), spin, WASDRBMoveController())
    runner = Runner(sim, seed=1)
    for agent_id, is_stopped in (("1", False), ("0", False), ("2", True)):
        sim.agent(agent_id).add_reward(1, request_done=True)
        advance(runner, 2)
        runner.submit(lambda: None)  # publishes
        runner.advance()
        latest = runner.latest
        assert (latest.episode_time < latest.time) == is_stopped
