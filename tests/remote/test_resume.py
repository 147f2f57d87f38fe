"""Connections that are lost, and sessions that go on over other ones."""

import threading
from contextlib import suppress
from functools import partial
from socket import SHUT_RDWR

import pytest
from websockets.exceptions import ConnectionClosed

from ai4u_edu.page.server.limits.rate_limit import RateLimit
from ai4u_edu.page.server.scripts import sockets
from ai4u_edu.page.server.scripts.sockets import MAX_STRAY_FRAMES_PER_S
from ai4u_edu.remote import LostError, RefusedError, Robot
from ai4u_edu.remote.dialogue import Dialogue
from ai4u_edu.remote.steps import ConnectionLostError, Flow, Open, Receive, Send, Step
from ai4u_edu.wire import native
from tests.remote.rooms import SECRET, Script, connect, log_of, log_room
from tests.waiting import LIMIT_S, until


def cut(robot: Robot) -> None:
    """Cuts a robot's connection, without a farewell."""
    robot._connection._connected.socket.shutdown(SHUT_RDWR)


def test_a_session_goes_on_where_it_was() -> None:
    with log_room() as room:
        with Script(room) as script:
            welcome = script.hello()
            assert isinstance(welcome, native.Welcome)
            script.act(script.percept(), 1)
            percept = script.percept()
            script.socket.socket.shutdown(SHUT_RDWR)  # without a farewell
        with Script(room) as script:
            again = script.hello(session=welcome.session)
            assert again == welcome
            assert script.percept() == percept
            script.act(percept, 2)
            assert script.percept().step == percept.step + 1
        assert [number for _, _, number in log_of(room)] == [1.0, 2.0]


def test_the_secret_alone_is_enough_and_nothing_else_is() -> None:
    with log_room() as room, Script(room) as first:
        welcome = first.hello()
        assert isinstance(welcome, native.Welcome)
        with Script(room) as thief:
            answer = thief.hello(session=welcome.session, secret=SECRET + "?")
            assert isinstance(answer, native.Problem)
            assert answer.code == "session_over"
        with Script(room) as second:
            assert second.hello() == welcome
            code, reason = first.end()
            assert (code, reason) == (
                native.PROBLEMS["taken_over"],
                "the session goes on over another connection",
            )
            assert second.percept().seq == 1


def test_a_lost_connection_is_taken_up_again_unnoticed() -> None:
    with (
        log_room() as room,
        connect(room.url, mode="lockstep") as robot,
    ):
        robot.reset()
        for number in range(1, 40):
            robot.act(log=[number])
            if number % 10 == 0:
                cut(robot)
            robot.sense()
        assert [number for _, _, number in log_of(room)] == list(range(1, 40))
        assert [step for _, step, _ in log_of(room)] == list(range(39))


def test_a_script_that_comes_too_late_begins_another_session() -> None:
    # real time: it is to pass, and does not begin before the connection is lost
    with log_room(grace=0.2) as room:
        robot = connect(room.url, mode="lockstep")
        before = room.sim.agents[0].brains[0]
        robot.sense()
        session = robot.session
        cut(robot)
        until(lambda: room.sim.agents[0].brain is before)
        with pytest.raises(RefusedError, match=r"session '\w+' of agent 'a' is over"):
            connect(room.url, "a", mode="lockstep", session=session).sense()
        assert robot.reset().step == 0
        assert robot.session != session
        robot.close()


def test_another_process_may_go_on_with_a_session() -> None:
    with log_room() as room:
        first = connect(room.url, mode="lockstep")
        percept = first.sense()
        with connect(room.url, "a", mode="lockstep", session=first.session) as second:
            assert second.sense() == percept
            second.act(log=[1])
            assert second.sense().step == percept.step + 1

            def go_on() -> None:
                first.act(log=[2])  # may be sent before the end of the connection arrives
                first.sense()

            with pytest.raises(LostError, match="the session goes on over another connection"):
                go_on()


def test_in_realtime_a_lost_script_stops_its_agent() -> None:
    with log_room(time_scale=1.0) as room:
        agent = room.sim.agents[0]
        robot = connect(room.url)
        robot.act(log=[5])
        robot.sense()
        until(lambda: agent.last_action.get("log") == (5.0,))
        cut(robot)
        until(lambda: agent.last_action.get("log") == (0.0,))
        until(lambda: agent.brain.status().state == "lost")  # type: ignore[attr-defined]  # RemoteBrain
        robot.close()


def test_in_realtime_a_lost_script_frees_its_agent_after_the_grace_time() -> None:
    # real time: it is to pass, and does not begin before the connection is lost
    with log_room(time_scale=1.0, grace=0.2) as room:
        before = room.sim.agents[0].brain
        robot = connect(room.url)
        robot.sense()
        cut(robot)
        until(lambda: room.sim.agents[0].brain is before)
        robot.close()


FLOODED = f"expected at most {MAX_STRAY_FRAMES_PER_S} frames a second that answer nothing"


@pytest.fixture
def _slow_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let rate limits count by a clock that stands still: no script on a busy machine is too slow
    to reach them."""
    monkeypatch.setattr(sockets, "RateLimit", partial(RateLimit, clock=lambda: 0.0))


def flood(script: Script, late: native.Percept) -> tuple[int, str]:
    """Answer one percept again and again; return how the connection ends."""
    with suppress(ConnectionClosed):
        for _ in range(2 * MAX_STRAY_FRAMES_PER_S):
            script.act(late, 99)
    return script.end()


@pytest.mark.usefixtures("_slow_counts")
def test_a_seated_script_that_floods_is_sent_away_and_may_come_back() -> None:
    with log_room(2) as room:
        with Script(room) as script:
            welcome = script.hello()
            assert isinstance(welcome, native.Welcome)
            late = script.percept()  # before the other one has the world wait
            with connect(room.url, "b", mode="lockstep") as other:
                script.act(late, 1)
                ended: list[tuple[int, str]] = []
                flooding = threading.Thread(target=lambda: ended.append(flood(script, late)))
                flooding.start()
                other.sense()
                flooding.join(LIMIT_S)
            assert ended == [(native.PROBLEMS["too_fast"], FLOODED)]
        with Script(room) as script:
            assert script.hello(session=welcome.session) == welcome
            percept = script.percept()
            script.act(percept, 2)
            script.percept()
        assert [number for _, _, number in log_of(room)] == [1.0, 2.0]


@pytest.mark.usefixtures("_slow_counts")
def test_fast_answers_do_not_count_as_flood() -> None:
    with log_room() as room, Script(room) as script:
        script.hello()
        for number in range(2 * MAX_STRAY_FRAMES_PER_S):
            script.act(script.percept(), number)
        script.percept()
        assert len(log_of(room)) == 2 * MAX_STRAY_FRAMES_PER_S


@pytest.mark.usefixtures("_slow_counts")
def test_a_flooding_scripts_seat_is_free_after_the_grace_time() -> None:
    # real time: it is to pass, and does not begin before the connection is closed
    with log_room(grace=0.2) as room:
        with Script(room) as script:
            script.hello()
            late = script.percept()
            script.act(late, 1)
            assert flood(script, late) == (native.PROBLEMS["too_fast"], FLOODED)
            until(lambda: room.runner.latest.agents[0].remote is None)
        with Script(room) as another:
            assert isinstance(another.hello(secret="another script's secret"), native.Welcome)


def test_nothing_is_left_behind() -> None:
    # real time: it is to pass, and does not begin before a connection is lost
    with log_room(grace=0.1) as room:
        connect(room.url).close()
        agent = room.sim.agents[0]
        until(lambda: agent.brain is agent.brains[0])
        before = threading.active_count()
        for _ in range(5):
            robot = connect(room.url)
            robot.sense()
            cut(robot)
            until(lambda: len(agent.brains) == 1 and agent.brain is agent.brains[0])
            robot.close()
        until(lambda: threading.active_count() <= before)


def test_a_connection_lost_before_the_first_percept_is_taken_up_with_one_hello_only() -> None:
    dialogue = Dialogue("a", patience=LIMIT_S)
    hellos: list[bytes] = []
    with log_room() as room, Script(room) as script:
        welcome = native.encode(script.hello())

        def greeted(flow: Flow[object], first: Step) -> Step:
            assert isinstance(first, Open)
            said = flow.send(None)
            assert isinstance(said, Send)
            hellos.append(said.frame)
            assert isinstance(flow.send(None), Receive)
            try:
                return flow.send(welcome)
            except StopIteration:
                return first

        beginning = dialogue.begin()
        greeted(beginning, next(beginning))
        sensing = dialogue.sense()
        assert isinstance(next(sensing), Receive)
        again = greeted(sensing, sensing.throw(ConnectionLostError("cut")))
        assert again == Send(hellos[1])  # and not the first one's, of another session
        assert hellos[0] != hellos[1]


@pytest.mark.parametrize(
    ("chosen", "of_the_room", "late", "lost"),
    [
        ("", "", (5.0,), (0.0,)),
        ("", "coast", None, None),
        ("hold", "coast", (5.0,), (5.0,)),
        ("coast", "", None, None),
        ("stop", "hold", (0.0,), (0.0,)),
    ],
)
def test_a_script_or_its_room_says_what_is_done_when_its_action_is_missing(
    chosen: native.OnMissing, of_the_room: native.OnMissing, late: object, lost: object
) -> None:
    with log_room(time_scale=8.0, on_missing=of_the_room) as room:
        agent = room.sim.agents[0]
        robot = connect(room.url, on_missing=chosen)
        robot.act(log=[5])
        steps = robot.sense().step

        def done_since() -> object:
            until(lambda: agent.steps > steps + 5)
            return room.runner.submit(lambda: agent.last_action.get("log")).result(LIMIT_S)

        assert done_since() == late
        cut(robot)
        until(lambda: agent.brain.status().state == "lost")  # type: ignore[attr-defined]
        steps = agent.steps
        assert done_since() == lost
        robot.close()
