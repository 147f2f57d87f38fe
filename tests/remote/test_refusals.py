"""Each thing that a script may do wrong has its own error, with what to do."""

import contextlib
import logging
import math
from functools import partial
from typing import Any

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed

from ai4u_edu.base.errors import ActionError, ParameterError
from ai4u_edu.blocks.brains import remote_status
from ai4u_edu.page.server.limits.rate_limit import RateLimit
from ai4u_edu.page.server.scripts import sockets
from ai4u_edu.remote import LostError, RefusedError, RemoteError
from ai4u_edu.wire import native
from tests.page.server.rooms import UPGRADE, Room, raw_answer, served
from tests.page.server.test_api import get
from tests.remote.rooms import (
    Script,
    connect,
    log_of,
    log_room,
    log_sim,
    patient_rules,
    unused_address,
)
from tests.waiting import LIMIT_S, until


def refused(room: Room, code: str, **hello: object) -> str:
    """Send a hello that is refused; check the problem and the close, and return the text."""
    with Script(room) as script:
        problem = script.hello(**hello)
        assert isinstance(problem, native.Problem), problem
        assert problem.code == code
        closed, reason = script.end()
        assert closed == native.PROBLEMS[code]
        assert problem.text.startswith(reason)
        return problem.text


def test_each_refusal_says_what_to_do() -> None:
    with log_room(2, token="sesame", grace=60.0) as room:
        said = {"token": "sesame"}
        assert refused(room, "version", **said, version=7) == (
            "expected version 1, got 7; install the ai4u-edu that the world has "
            "(pip install -U ai4u-edu, on both machines)"
        )
        assert refused(room, "unknown_agent", **said, agent="A") == (
            "no agent has the id 'A'; known are 'a', 'b'"
        )
        assert refused(room, "unknown_agent", **said, agent="") == (
            "which agent? none was named; known are 'a', 'b'"
        )
        assert refused(room, "bad_token") == (
            "expected this world's token, got none; take the whole address that its terminal "
            "shows, as in connect('http://teacher:8080/?token=...')"
        )
        assert "got another one" in refused(room, "bad_token", token="open")
        assert refused(room, "unknown_key", **said, keys=("plaec",)) == (
            "there is no sensor called 'plaec'; did you mean 'place'?"
        )
        assert refused(room, "session_over", **said, session="1234") == (
            "session '1234' of agent 'a' is over; connect again"
        )
        assert refused(room, "malformed", **said, secret="short") == (
            "secret: expected at least 16 characters, got 5"
        )
        with Script(room) as first:
            first.hello(**said)
            assert refused(room, "agent_taken", **said, secret="another long secret") == (
                "agent 'a' is driven by another script; free are 'b'; an agent is free when its "
                "script ends, or 60 s after the connection is lost"
            )


def test_a_client_of_another_version_is_told_so() -> None:
    with log_room() as room:
        for spoken, got in (("ai4u-edu-remote.v9", "ai4u-edu-remote.v9"), (None, "none")):
            with Script(room, subprotocol=spoken) as script:
                problem = script.hear()
                assert isinstance(problem, native.Problem)
                assert problem.code == "version"
                assert problem.text.startswith(
                    f"expected subprotocol 'ai4u-edu-remote.v1', got {got}; install"
                )
                assert script.end()[0] == native.PROBLEMS["version"]


def script_in_snapshot(room: Room) -> Any:
    return get(room, "api/snapshot")["agents"][0]["script"]


def test_a_bad_action_is_answered_and_never_applied(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(remote_status, "WARNING_INTERVAL_S", LIMIT_S)  # the first one stays
    with log_room() as room, Script(room) as script:
        script.hello()
        percept = script.percept()
        wrong: list[tuple[dict[str, tuple[float, ...]], str]] = [
            ({"lgo": (1.0,)}, "agent 'a' has no actuator 'lgo'; did you mean 'log'?"),
            ({"log": ()}, "action 'log': expected 1 numbers, got 0: ()"),
            ({"log": (float("nan"),)}, "action 'log': expected finite numbers, got (nan,)"),
            ({"log": (float("inf"),)}, "action 'log': expected finite numbers, got (inf,)"),
        ]
        for values, complaint in wrong:
            script.say(native.Action(percept.episode, percept.step, percept.seq, values))
            assert script.hear() == native.Problem("bad_action", complaint, percept.seq)
        assert log_of(room) == []
        until(lambda: script_in_snapshot(room)["warnings"] == len(wrong))
        assert script_in_snapshot(room)["warning"] == wrong[0][1]
        assert script_in_snapshot(room)["refused"] == len(wrong)
        script.act(percept, -5)  # out of range: cut, and counted
        script.percept()
        assert [number for _, _, number in log_of(room)] == [0.0]
        assert room.sim.agents[0].brain.status().clipped == 1  # type: ignore[attr-defined]


def test_malformed_frames_are_answered_and_then_end_the_connection() -> None:
    with log_room() as room, Script(room) as script:
        script.hello()
        percept = script.percept()
        for _ in range(sockets.MAX_MALFORMED_FRAMES - 1):
            script.socket.send(b"\xc1")
            problem = script.hear()
            assert isinstance(problem, native.Problem)
            assert problem.code == "bad_message"
            assert problem.text.startswith("expected msgpack, got b'\\xc1' (")
        script.act(percept, 1)  # a good one in between: the count begins again
        script.percept()
        for _ in range(sockets.MAX_MALFORMED_FRAMES):
            script.socket.send("text")
        code, reason = script.end()
        assert code == native.PROBLEMS["malformed"]
        assert reason.startswith("5 malformed frames in a row; the last: expected msgpack")


def test_a_close_that_is_not_taken_in_time_is_no_error(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(sockets, "CLOSE_TIMEOUT_S", 0.0)  # for a script that never reads
    with log_room() as room, Script(room, subprotocol=None) as script:
        script.end()
    assert [each.getMessage() for each in caplog.records if each.levelno >= logging.ERROR] == []


@pytest.mark.parametrize("message", [native.Bye("x"), native.Reset(1, None)])
def test_first_message_must_be_hello(message: native.Message) -> None:
    with log_room() as room, Script(room) as script:
        script.say(message)
        kind = type(message).__name__.lower()
        assert script.hear() == native.Problem("bad_message", f"expected a hello, got a {kind}", 0)


def test_a_second_hello_can_not_be_another_one() -> None:
    with log_room(2) as room, Script(room) as script:
        script.hello()
        script.percept()
        assert script.hello(agent="b") == native.Problem(
            "bad_message", "expected one hello in a connection, got another one", 0
        )
        assert room.sim.agent("b").brain.title() == "LocalBrain(ScriptController)"


def test_a_frame_that_is_too_large_ends_the_connection() -> None:
    with log_room() as room, Script(room) as script:
        script.hello()
        script.socket.send(bytes(native.MAX_SCRIPT_FRAME_BYTES + 1))
        assert script.end() == (
            native.PROBLEMS["too_large"],
            f"expected at most {native.MAX_SCRIPT_FRAME_BYTES} bytes in a frame, got "
            f"{native.MAX_SCRIPT_FRAME_BYTES + 1}",
        )


def test_a_flood_ends_the_connection(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sockets, "RateLimit", partial(RateLimit, clock=lambda: 0.0))
    with log_room() as room, Script(room) as script:
        script.hello()
        percept = script.percept()
        late = native.encode(native.Action(1, 0, percept.seq + 9, {}))
        with contextlib.suppress(ConnectionClosed):  # it may be over before all are sent
            for _ in range(2 * sockets.MAX_STRAY_FRAMES_PER_S):
                script.socket.send(late)
        assert script.end() == (
            native.PROBLEMS["too_fast"],
            f"expected at most {sockets.MAX_STRAY_FRAMES_PER_S} frames a second that answer "
            "nothing",
        )


def test_a_connection_that_says_nothing_is_ended() -> None:
    # real time: it is to pass
    with log_room(hello_timeout=0.1) as room, Script(room) as script:
        assert script.end() == (native.PROBLEMS["malformed"], "expected a hello within 0.1 s")


def test_a_foreign_page_may_not_open_the_socket() -> None:
    with log_room() as room:
        status, why = raw_answer(
            room.url + "ws/remote", "Host: localhost", "Origin: http://evil.example", *UPGRADE
        )
        assert status == 403
        assert why.startswith("Origin: expected")


def test_the_client_raises_what_the_world_says() -> None:
    with log_room(2) as room:
        with pytest.raises(RefusedError, match="no agent has the id 'red'") as refusal:
            connect(room.url, agent="red")
        assert refusal.value.code == "unknown_agent"
    with (
        served(log_sim(), allowed_hosts=["elsewhere"], rules=patient_rules()) as room,
        pytest.raises(LostError, match="expected a world, got answer 403 Host: expected"),
    ):
        connect(room.url)
    with (
        unused_address() as address,
        pytest.raises(LostError, match="is it running, and is the address right"),
    ):
        connect(f"http://{address}", patience=0)


def test_among_several_agents_lockstep_has_to_be_allowed() -> None:
    with log_room(2, lockstep=None) as room:
        with pytest.raises(RefusedError, match="expected mode='realtime'") as refusal:
            connect(room.url, "a", mode="lockstep")
        assert refusal.value.code == "lockstep_refused"
        assert str(refusal.value) == (
            "expected mode='realtime' (ai4u-edu bridge --realtime), got 'lockstep', in which a "
            "script has all 2 agents of this world wait for it; whoever runs the world has to "
            "allow that (ai4u-edu play --lockstep)"
        )
        with connect(room.url, "a") as robot:  # the seat is free
            robot.act(log=[1])
    with log_room(2, lockstep=True) as room, connect(room.url, "b", mode="lockstep") as robot:
        assert robot.sense()["id"] == "b"


def test_a_single_agent_is_driven_in_lockstep_unless_the_world_forbids_it() -> None:
    with log_room(lockstep=None) as room, connect(room.url, mode="lockstep") as robot:
        assert robot.sense()["id"] == "a"
    with log_room(lockstep=False) as room:
        with pytest.raises(RefusedError, match="in which a script has the world wait for it"):
            connect(room.url, mode="lockstep")
        with connect(room.url) as robot:
            assert robot.sense()["id"] == "a"


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ({"mode": "lockstp"}, "connect: mode: expected one of 'lockstep', 'realtime', got"),
        ({"on_missing": "hodl"}, "connect: on_missing: expected one of '', 'coast', 'hold', 's"),
        ({"agent": 7}, "connect: agent: expected text of up to 400 characters, got 7"),
        ({"keys": [7]}, "connect: keys: expected text of up to 400 characters, got 7"),
        ({"keys": 7}, "connect: keys: expected a list of up to 1024, got 7"),
        ({"session": None}, "connect: session: expected text of up to 400 characters, got None"),
        ({"token": object()}, "connect: expected text and names of keys, got <object object"),
        ({"patience": float("nan")}, "patience: expected a number of seconds from 0 on, got nan"),
    ],
)
def test_a_wrong_argument_is_refused_before_anybody_is_asked(
    arguments: dict[str, Any], complaint: str
) -> None:
    with unused_address() as address, pytest.raises(RemoteError) as caught:
        connect(f"http://{address}", **arguments)
    assert str(caught.value).startswith(complaint)


@pytest.mark.parametrize("seed", [-1, 2**63, 2**64, 1.5, math.nan, "7", True, [7]])
def test_a_wrong_seed_is_refused_before_it_leaves(seed: Any) -> None:
    with log_room() as room, connect(room.url, mode="lockstep") as robot:
        with pytest.raises(ParameterError, match=r"^seed: expected a whole number from 0 to"):
            robot.reset(seed=seed)
        assert robot.reset(seed=np.int64(7)).step == 0
        assert room.sim.world.seeds.seed == 7
        assert robot.reset(seed=2**63 - 1).step == 0
        assert room.sim.world.seeds.seed == 2**63 - 1


@pytest.mark.parametrize("numbers", [[1.0] * 1000, [1e300] * 1024, ["x" * 10_000], None])
def test_a_long_action_is_refused_in_a_short_sentence(numbers: Any) -> None:
    with log_room() as room, connect(room.url, mode="lockstep") as robot:
        percept = robot.sense()
        said = native.Action(percept.episode, percept.step, percept.seq, {"log": numbers})
        robot._connection.run(robot._dialogue._answer(said))
        with pytest.raises((RemoteError, ActionError)) as caught:
            robot.sense()
        assert len(str(caught.value)) < 200
        robot.act(log=[1])
        assert robot.sense().step == percept.step + 1
