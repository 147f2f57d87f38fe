"""A script's reset begins one episode, and gives its first percept; whatever happens meanwhile."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from queue import Queue
from socket import SHUT_RDWR
from threading import Event
from typing import Any

import pytest

from ai4u_edu import BasicAgent
from ai4u_edu.blocks.brains.links.link import LinkThread, Observation, Reply, ResetRequest
from ai4u_edu.remote import Robot
from ai4u_edu.wire import native
from tests.page.server.rooms import Room
from tests.remote.faulty_proxy import Faults, FaultyProxy
from tests.remote.rooms import Script, connect, log_room
from tests.waiting import LIMIT_S, until

LATE = Faults(latency=0.02)
LOSSY = Faults(drop=0.1, duplicate=0.1, reorder=0.1, latency=0.01, reset=0.03)


@contextmanager
def begun_episodes(agent: BasicAgent) -> Iterator[list[int]]:
    """The episodes of an agent that begin meanwhile, by their numbers."""
    begun: list[int] = []

    def note(agent: BasicAgent) -> None:
        begun.append(agent.episode)

    agent.begin_of_episode.connect(note)
    yield begun
    agent.begin_of_episode.disconnect(note)


def reset_once(robot: Robot, agent: BasicAgent, seed: int | None = None) -> None:
    """Resets: one episode begins, its first percept comes back, and it goes on."""
    with begun_episodes(agent) as begun:
        percept = robot.reset(seed)
        for _ in range(3):
            robot.act(log=[1])
            after = robot.sense()
        assert begun == [percept.episode] == [after.episode]
    assert percept["place"].tolist() == [percept.episode, 0]
    assert percept.step == 0


@pytest.mark.parametrize("skip_frame", [0, 4])
@pytest.mark.parametrize("seed", [None, 7])
def test_the_first_reset_in_realtime_begins_one_episode(seed: int | None, skip_frame: int) -> None:
    with log_room(time_scale=8.0, skip_frame=skip_frame) as room:
        for _ in range(6):
            with connect(room.url) as robot:
                reset_once(robot, room.sim.agents[0], seed)
                reset_once(robot, room.sim.agents[0])


def test_each_of_several_agents_begins_one_episode() -> None:
    with log_room(3, time_scale=8.0, skip_frame=4) as room:

        def drive(agent: BasicAgent) -> None:
            for _ in range(5):
                with connect(room.url, agent.id) as robot:
                    reset_once(robot, agent)

        with ThreadPoolExecutor() as pool:
            assert list(pool.map(drive, room.sim.agents)) == [None] * 3


@pytest.mark.parametrize("faults", [LATE, LOSSY])
def test_over_a_bad_network_a_reset_begins_one_episode(faults: Faults) -> None:
    with (
        log_room(time_scale=8.0, skip_frame=4) as room,
        FaultyProxy(room.url, faults) as proxy,
        connect(proxy.url) as robot,
    ):
        for _ in range(2):
            reset_once(robot, room.sim.agents[0])


def begin_in_realtime(room: Room, script: Script) -> tuple[native.Welcome, native.Percept]:
    """Says hello in a world that stands still, in the middle of a decision without the script."""
    room.runner.pause().result(LIMIT_S)
    welcome = script.hello(mode="realtime")
    assert isinstance(welcome, native.Welcome)
    room.runner.step().result(LIMIT_S)
    return welcome, script.percept()


def heard(room: Room) -> bool:
    """Return True if an answer of the script is queued for the next decision."""
    brain: Any = room.sim.agents[0].brain
    return len(brain._link.exchange) == 1


@pytest.mark.parametrize("is_lost", [False, True])
def test_a_reset_in_the_middle_of_a_decision_is_not_answered_with_its_end(is_lost: bool) -> None:
    with log_room(skip_frame=1, time_scale=1.0) as room, ExitStack() as scripts:
        script = scripts.enter_context(Script(room))
        welcome, before = begin_in_realtime(room, script)
        script.say(native.Reset(before.seq, None))
        until(lambda: heard(room))
        if is_lost:
            script.socket.socket.shutdown(SHUT_RDWR)
            until(lambda: room.sim.agents[0].brain._link.outbox is None)  # type: ignore[attr-defined]
        room.runner.step(6).result(LIMIT_S)
        if is_lost:
            script = scripts.enter_context(Script(room))
            assert script.hello(mode="realtime", session=welcome.session) == welcome
        percept = script.percept()
        assert (percept.episode, percept.step) == (before.episode + 1, 0)
        assert room.sim.agents[0].episode == before.episode + 1
        script.act(percept, 1)
        until(lambda: heard(room))
        room.runner.step(2).result(LIMIT_S)
        assert script.percept().episode == percept.episode


@pytest.mark.parametrize("restarts", [1, 2])
def test_a_restart_while_a_script_owes_an_answer_truncates_its_episode(restarts: int) -> None:
    with log_room(time_scale=1.0) as room, Script(room) as script:
        _, before = begin_in_realtime(room, script)
        for _ in range(restarts):  # by a person
            room.runner.reset().result(LIMIT_S)
            room.runner.step(3).result(LIMIT_S)
        script.act(before, 1)
        until(lambda: heard(room))
        room.runner.step(2).result(LIMIT_S)
        end = script.percept()
        assert (end.episode, end.truncated) == (before.episode, True)
        script.say(native.Reset(end.seq, None))
        until(lambda: heard(room))
        room.runner.step(2).result(LIMIT_S)
        first = script.percept()
        assert (first.episode, first.step) == (before.episode + restarts + 1, 0)
        assert not first.truncated


def test_a_session_that_is_taken_up_again_begins_one_episode() -> None:
    with log_room(time_scale=8.0, skip_frame=4) as room:
        first = connect(room.url)
        first.sense()
        with connect(room.url, "a", session=first.session) as robot:
            reset_once(robot, room.sim.agents[0])


def situation_of(episode: int) -> Observation:
    """The first of an episode; its number is the episode's."""
    nothing: Any = None
    return Observation(
        number=episode,
        episode=episode,
        percept=nothing,
        reward=0.0,
        terms={},
        steps=0,
        tick=0,
        done=False,
        truncated=False,
        paused=False,
        stopped=False,
    )


def test_an_ai4u_script_is_not_told_of_the_episode_that_it_has_ended() -> None:
    told: Queue[Observation | None] = Queue()
    asks_for_reset = Event()

    def talk(situation: Observation | None, until: float) -> Reply | None:
        told.put(situation)
        asks_for_reset.wait(LIMIT_S)
        return Reply(ResetRequest(), situation)

    before, after, anew = map(situation_of, (1, 2, 3))
    desk = LinkThread(talk, "a script's desk")
    desk.put(before)
    assert told.get(timeout=LIMIT_S) is before
    desk.put(after)  # the end of the decision in which it asks
    asks_for_reset.set()
    assert desk.exchange(after, LIMIT_S) == Reply(ResetRequest(), before)
    assert not desk._has_work()  # there is nothing to tell it until the episode has begun
    desk.put(anew)
    assert told.get(timeout=LIMIT_S) is anew
    desk.close()
