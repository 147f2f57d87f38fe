"""The lines for whoever runs a world: which scripts come, go, are refused and act in vain."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from socket import SHUT_RDWR

import pytest

from ai4u_edu import RemoteBrain
from ai4u_edu.base.log_limit import LOG_INTERVAL_S
from ai4u_edu.blocks.brains.links import ai4u
from ai4u_edu.blocks.brains.remote_status import RemoteStatus
from ai4u_edu.page.server.scripts import ScriptReport
from ai4u_edu.page.server.scripts.report import EVENTS_PER_S, MAX_WAITING_LINES
from ai4u_edu.remote import Robot
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire import native
from tests.builders import small_sim
from tests.page.server.rooms import Clock, Room, served
from tests.playing import played
from tests.remote.rooms import Script, connect, log_sim, patient_rules
from tests.remote.test_bridge import begin
from tests.remote.udp_script import udp_script
from tests.waiting import LIMIT_MS, LIMIT_S, until

OTHER = "another long secret"
IN_VAIN = "the script of agent 'a' sent what has no effect: "


class Lines(list[str]):
    """A report that keeps everything."""

    def note_event(self, text: str) -> None:
        self.append(text)

    def note_mistake(self, kind: str, text: str) -> None:
        self.append(text)


@contextmanager
def reported_room(agents: int = 1, **rules: object) -> Iterator[tuple[Room, Lines]]:
    lines = Lines()
    changes = {"lockstep": True} | rules
    with served(log_sim(agents), rules=patient_rules(**changes), script_report=lines) as room:
        room.runner.scale_time(float("inf"))
        yield room, lines


def test_a_script_joins_is_lost_comes_back_and_leaves() -> None:
    with reported_room() as (room, lines):
        robot = connect(room.url, mode="lockstep")
        assert lines == ["a script drives agent 'a' (lockstep)"]
        robot._connection._connected.socket.shutdown(SHUT_RDWR)
        until(lambda: len(lines) == 2)
        assert lines[1] == (
            f"the script of agent 'a' is lost; the agent is kept for it for {LIMIT_S:g} s"
        )
        robot.act(log=[1])
        robot.sense()
        assert lines[2] == "the script of agent 'a' is back"
        robot.close()
        until(lambda: len(lines) == 4)
        assert lines[3] == "the script of agent 'a' has left: the script has ended"


def test_a_script_that_does_not_come_back() -> None:
    # real time: it is to pass
    with reported_room(grace=0.1) as (room, lines):
        robot = connect(room.url)
        robot._connection._connected.socket.shutdown(SHUT_RDWR)
        until(lambda: lines[-1].endswith("has left: the script did not come back"))


def test_a_script_is_refused() -> None:
    with reported_room(2, token="sesame") as (room, lines), Script(room) as script:
        script.hello()
        script.end()
        (line,) = lines
        assert line.startswith("a script was refused: expected this world's token, got none; take")
        assert "sesame" not in line


def test_actions_without_effect_are_reported() -> None:
    with reported_room() as (room, lines), Script(room) as script:
        script.hello()
        percept = script.percept()
        wrong: list[tuple[dict[str, tuple[float, ...]], str]] = [
            ({"lgo": (1.0,)}, "agent 'a' has no actuator 'lgo'; did you mean 'log'?"),
            ({"log": ()}, "action 'log': expected 1 numbers, got 0: ()"),
            ({"log": (float("nan"),)}, "action 'log': expected finite numbers, got (nan,)"),
        ]
        for values, complaint in wrong:
            script.say(native.Action(percept.episode, percept.step, percept.seq, values))
            script.hear()
            assert lines[-1] == IN_VAIN + complaint
        script.act(percept, 1, step=percept.step + 7)
        script.hear()
        assert lines[-1].startswith(IN_VAIN + f"percept {percept.seq} is of episode ")
        script.socket.send(b"\xc1")
        script.hear()
        assert lines[-1].startswith("a script sent what has no effect: expected msgpack, got b'")


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def told() -> list[str]:
    return []


@pytest.fixture
def report(clock: Clock, told: list[str]) -> Iterator[ScriptReport]:
    with ScriptReport(Runner(small_sim()), told.append, clock) as report:
        yield report


def test_lines_of_one_kind_are_limited_and_counted(
    report: ScriptReport, clock: Clock, told: list[str]
) -> None:
    for number in range(100):
        report.note_mistake("a", f"number {number}")
    clock.now = LOG_INTERVAL_S
    report.note_mistake("a", "another one")
    until(lambda: len(told) == 2)
    assert told == ["number 0", "another one (99 more since the last such line)"]


def test_a_flood_of_events_fills_no_terminal(
    report: ScriptReport, clock: Clock, told: list[str]
) -> None:
    for number in range(1000):
        report.note_event(f"event {number}")
    clock.now = 1.0
    report.note_event("later")
    until(lambda: told[-1:] == ["later"])
    assert len(told) == EVENTS_PER_S + 1


def test_a_blocked_terminal_blocks_nobody_else(clock: Clock) -> None:
    is_blocked, may_go_on = threading.Event(), threading.Event()
    told: list[str] = []

    def tell(line: str) -> None:
        told.append(line)
        is_blocked.set()
        assert may_go_on.wait(LIMIT_S)

    with ScriptReport(Runner(small_sim()), tell, clock) as report:
        report.note_event("first")
        assert is_blocked.wait(LIMIT_S)
        for number in range(2 * MAX_WAITING_LINES):
            report.note_mistake(f"kind {number}", f"number {number}")
        may_go_on.set()
        until(lambda: f"number {MAX_WAITING_LINES - 1}" in told)
        assert len(told) == 1 + MAX_WAITING_LINES


def test_a_script_can_not_command_the_terminal(report: ScriptReport, told: list[str]) -> None:
    report.note_event("left: \x1b[2J\r\nroot# " + "x" * 1000)
    until(lambda: told)
    assert told[0].startswith("left: ?[2J??root# xxx")
    assert len(told[0]) <= 300


def test_an_ai4u_script_joins_acts_in_vain_and_leaves(
    told: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ai4u, "CONNECT_INTERVAL_S", LIMIT_S)  # it asks the script once
    with udp_script() as script:
        brain = RemoteBrain(port=script.port, receive_timeout=round(LIMIT_MS))
        runner = Runner(small_sim(brains=[brain]))
        runner.start()
        try:
            with ScriptReport(runner, told.append):
                begin(script)
                until(lambda: told)
                assert told == ["an AI4U script drives agent '0'"]
                script.say("move;1;nan")
                script.hear()
                until(lambda: len(told) == 2)
                assert told[1].startswith("the AI4U script of agent '0' sent what has no effect: ")
                script.say("halt")
                until(lambda: len(told) == 3)
                assert told[2].startswith("the AI4U script of agent '0' has left: ")
        finally:
            runner.stop(LIMIT_S)


def test_the_end_of_the_world_is_nothing_that_an_ai4u_script_did(
    told: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    looks: list[RemoteStatus] = []
    status = RemoteBrain.status

    def noted_status(brain: RemoteBrain) -> RemoteStatus:
        looks.append(status(brain))
        return looks[-1]

    monkeypatch.setattr(RemoteBrain, "status", noted_status)
    monkeypatch.setattr(ai4u, "CONNECT_INTERVAL_S", LIMIT_S)  # it asks the script once
    with udp_script() as script:
        brain = RemoteBrain(port=script.port, receive_timeout=round(LIMIT_MS))
        runner = Runner(small_sim(brains=[brain]))
        runner.start()
        with ScriptReport(runner, told.append):
            begin(script)
            until(lambda: told)
            runner.stop(LIMIT_S)
            until(lambda: [look.state for look in looks[-2:]] == ["waiting"] * 2)
        assert told == ["an AI4U script drives agent '0'"]


@pytest.mark.slow
def test_play_prints_the_lines() -> None:
    with played("box_chase", "--grace", str(LIMIT_S)) as server:

        def printed(text: str) -> bool:
            return any(text in line for line in server.told)

        robot: Robot = connect(server.url, "0")
        until(lambda: printed("a script drives agent '0' (realtime)"))
        robot.close()
        until(lambda: printed("the script of agent '0' has left: the script has ended"))
        with pytest.raises(Exception, match="no agent has the id 'red'"):
            connect(server.url, "red")
        until(lambda: printed("a script was refused: no agent has the id 'red'; known are '0'"))
