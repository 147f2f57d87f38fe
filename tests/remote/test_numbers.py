"""Frames that come twice, late, or not at all: everything counts once, and where it belongs."""

from functools import partial

import pytest

from ai4u_edu import BasicAgent
from ai4u_edu.remote import RefusedError
from ai4u_edu.wire import native
from tests.page.server.rooms import Room
from tests.remote.rooms import Script, connect, log_of, log_room
from tests.waiting import LIMIT_S, until


def test_each_action_is_the_answer_to_one_percept() -> None:
    with log_room() as room, Script(room) as script:
        assert isinstance(script.hello(), native.Welcome)
        for number in range(1, 4):
            percept = script.percept()
            script.act(percept, number)
        last = script.percept()
        first = log_of(room)[0][1]
        assert log_of(room) == [(1, first, 1.0), (1, first + 1, 2.0), (1, first + 2, 3.0)]
        assert (last.step, last.reward, last.terms) == (first + 3, 1.0, {"pay": 1.0})


def test_a_repeated_action_is_applied_once_and_the_next_percept_said_again() -> None:
    with log_room() as room, Script(room) as script:
        script.hello()
        first = script.percept()
        script.act(first, 1)
        second = script.percept()
        script.act(first, 1)
        assert script.percept() == second
        script.act(first, 99)  # another action under an old number
        assert script.percept() == second
        script.act(second, 2)
        script.percept()
        assert [number for _, _, number in log_of(room)] == [1.0, 2.0]


def test_an_action_for_a_percept_that_is_yet_to_come_is_no_answer() -> None:
    with log_room() as room, Script(room) as script:
        script.hello()
        percept = script.percept()
        script.act(percept, 1, seq=percept.seq + 1)
        assert script.percept() == percept
        assert log_of(room) == []


@pytest.mark.parametrize("changed", [{"step": 7}, {"episode": 7}])
def test_an_action_says_which_step_it_is_for(changed: dict[str, int]) -> None:
    with log_room() as room, Script(room) as script:
        script.hello()
        percept = script.percept()
        script.act(percept, 1, **changed)
        problem = script.hear()
        assert isinstance(problem, native.Problem)
        assert (problem.code, problem.seq) == ("bad_action", percept.seq)
        assert log_of(room) == []
        script.act(percept, 2)
        script.percept()
        assert [number for _, _, number in log_of(room)] == [2.0]


def test_a_repeated_hello_is_answered_again_with_the_percept() -> None:
    with log_room() as room, Script(room) as script:
        welcome = script.hello()
        percept = script.percept()
        assert script.hello() == welcome
        assert script.percept() == percept


def test_a_repeated_reset_begins_one_episode() -> None:
    with log_room() as room, Script(room) as script:
        script.hello()
        before = script.percept()
        script.say(native.Reset(before.seq, 5))
        after = script.percept()
        script.say(native.Reset(before.seq, 5))
        assert script.percept() == after
        assert (after.episode, after.step) == (before.episode + 1, 0)
        assert room.sim.world.seeds.seed == 5


def test_an_action_that_comes_too_late_is_applied_to_no_other_step() -> None:
    # real time: the world is to go on without the script once this has passed
    with log_room(receive_timeout=200) as room, Script(room) as script:
        script.hello()
        percept = script.percept()
        agent = room.sim.agents[0]
        until(lambda: agent.steps > percept.step + 1)  # the world went on without it
        script.act(percept, 13)
        later = script.percept()
        assert later.step > percept.step + 1
        assert 13.0 not in [number for _, _, number in log_of(room)]
        assert later.reward == later.step - percept.step  # what was paid meanwhile is not lost


def beyond(agent: BasicAgent, step: int) -> None:
    """Waits until an agent has taken more decisions than that."""
    until(lambda: agent.steps > step)


def test_rewards_missed_by_a_script_are_sent_once_by_name() -> None:
    # real time: the world is to go on without the script whenever this has passed
    with log_room(receive_timeout=200) as room, Script(room) as script:
        agent, paid = room.sim.agents[0], {}
        agent.end_of_update_state.connect(
            lambda agent: paid.update({(agent.episode, agent.steps): dict(agent.reward_terms)})
        )
        script.hello()
        first = script.percept()
        for _ in range(2):
            before = first
            beyond(agent, before.step + 2)
            script.act(before, 1)  # too late
            first = script.percept()
            decision = (first.episode, first.step)
            until(partial(paid.__contains__, decision))  # the script is told first
            missed = [
                paid[first.episode, step]["pay"] for step in range(before.step + 1, first.step + 1)
            ]
            assert len(missed) >= 3
            assert first.terms == {"pay": sum(missed)}
            assert first.reward == sum(missed)
        script.act(first, 2)
        last = script.percept()
        assert last.reward == last.step - first.step


def test_in_realtime_the_world_does_not_wait_and_an_action_counts_once() -> None:
    with log_room(time_scale=1.0) as room, Script(room) as script:
        script.hello(mode="realtime")
        percept = script.percept()
        agent = room.sim.agents[0]
        until(lambda: agent.steps > percept.step + 5)
        script.act(percept, 13)
        later = script.percept()
        until(lambda: agent.steps > later.step + 5)
        assert 13.0 in [number for _, _, number in log_of(room)]
        assert agent.brain.status().decisions == 1  # type: ignore[attr-defined]  # a RemoteBrain
        assert later.step > percept.step


def answered_in_realtime(room: Room, script: Script) -> native.Percept:
    """Return the percept after a script answered with 1 in the middle of the decision before.

    The world is paused; the decision before went on without the script.
    """
    room.runner.pause().result(LIMIT_S)
    script.hello(mode="realtime")
    room.runner.step().result(LIMIT_S)
    script.act(script.percept(), 1)
    until(lambda: answers(room) == 1)
    room.runner.step().result(LIMIT_S)
    return script.percept()


def answers(room: Room) -> int:
    """Return the number of queued answers of the script."""
    return len(room.sim.agents[0].brain._link.exchange)  # type: ignore[attr-defined]


def test_in_realtime_a_percept_comes_before_the_next_tick() -> None:
    with log_room(skip_frame=1, time_scale=1.0) as room, Script(room) as script:
        percept = answered_in_realtime(room, script)
        assert (percept.step, percept.tick) == (room.sim.agents[0].steps, room.sim.world.ticks)


def test_in_realtime_a_late_action_counts() -> None:
    with log_room(skip_frame=1, time_scale=1.0) as room, Script(room) as script:
        answered_in_realtime(room, script)
        room.runner.step().result(LIMIT_S)
        assert log_of(room)[-1][2] == 1.0


def test_in_realtime_a_late_action_gives_way_to_one_in_time() -> None:
    with log_room(skip_frame=1, time_scale=1.0) as room, Script(room) as script:
        script.act(answered_in_realtime(room, script), 2)
        until(lambda: answers(room) == 2)
        room.runner.step(4).result(LIMIT_S)
        assert [number for _, _, number in log_of(room)] == [2.0] * 4
        status = room.sim.agents[0].brain.status()  # type: ignore[attr-defined]  # a RemoteBrain
        assert (status.decisions, status.ignored) == (1, 1)


def test_an_episode_that_is_over_wants_a_reset() -> None:
    with log_room(max_steps=3) as room, Script(room) as script:
        script.hello()
        percept = script.percept()
        while not percept.truncated:
            script.act(percept, 1)
            percept = script.percept()
        script.act(percept, 2)
        assert script.hear() == native.Problem(
            "episode_over", "the episode is over; expected a reset", percept.seq
        )
        script.say(native.Reset(percept.seq, None))
        assert script.percept().step == 0


def test_of_several_agents_one_begins_anew_alone_unless_it_gives_a_seed() -> None:
    with log_room(2, seeded_resets=True) as room, Script(room) as script:
        script.hello()
        percept = script.percept()
        world = room.sim.episode
        script.say(native.Reset(percept.seq, None))
        percept = script.percept()
        assert (percept.episode, room.sim.episode) == (2, world)
        script.say(native.Reset(percept.seq, 3))
        assert (script.percept().episode, room.sim.episode) == (3, world + 1)


def test_one_of_several_does_not_reset_the_world_of_the_others_unless_that_is_allowed() -> None:
    with log_room(2) as room, Script(room) as script:
        script.hello()
        percept = script.percept()
        before = room.sim.episode
        script.say(native.Reset(percept.seq, 3))
        problem = script.hear()
        assert isinstance(problem, native.Problem)
        assert (problem.code, problem.seq) == ("seed_refused", percept.seq)
        assert problem.text == (
            "expected a reset without a seed, which begins an episode for this agent; with one it "
            "would begin for all 2 agents, and whoever runs the world has to allow that (ai4u-edu "
            "play --seeded-resets)"
        )
        script.say(native.Reset(percept.seq, None))
        assert script.percept().episode == percept.episode + 1
        assert room.sim.episode == before


def test_the_client_says_so_and_can_go_on() -> None:
    with log_room(2) as room, connect(room.url, "b", mode="lockstep") as robot:
        with pytest.raises(RefusedError, match="expected a reset without a seed") as refusal:
            robot.reset(seed=3)
        assert refusal.value.code == "seed_refused"
        robot.act(log=[7])
        robot.sense()
        assert [number for _, _, number in log_of(room, "b")] == [7.0]
        assert robot.reset().step == 0


def test_a_script_gets_the_readings_that_it_wants() -> None:
    with log_room() as room, Script(room) as script:
        welcome = script.hello(keys=("id", "done"))
        assert isinstance(welcome, native.Welcome)
        assert [reading.key for reading in welcome.readings] == ["done", "id"]
        percept = script.percept()
        assert (percept.data, percept.texts) == (b"\x00", ("a",))
