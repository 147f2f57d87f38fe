"""Scripts that wait: for a world that is not there, or for an agent that another script has."""

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.remote import AsyncRobot, LostError, RefusedError, RemotePercept
from ai4u_edu.remote.dialogue import Dialogue
from ai4u_edu.remote.steps import ConnectionLostError, Note, Open
from tests.browser.kept_port import kept_port
from tests.page.server.rooms import served
from tests.remote.rooms import Script, connect, log_of, log_room, patient_rules
from tests.waiting import LIMIT_S, until

NOBODY = "no world answers yet (connection refused: nothing listens there); trying again for up to"
LOST = "the connection is lost ("


def notes(caplog: pytest.LogCaptureFixture) -> list[str]:
    return [each.getMessage() for each in caplog.records if each.name == "ai4u_edu.remote"]


def drive(url: str) -> str:
    with connect(url) as robot:
        return str(robot.sense()["id"])


def drive_by_asyncio(url: str) -> str:
    async def run() -> str:
        async with AsyncRobot(url, patience=LIMIT_S) as robot:
            return str((await robot.sense())["id"])

    return asyncio.run(run())


@pytest.mark.parametrize("use", [drive, drive_by_asyncio])
def test_a_script_waits_for_a_world_that_starts_later(
    use: Callable[[str], str], caplog: pytest.LogCaptureFixture
) -> None:
    with kept_port() as port, ThreadPoolExecutor() as pool:
        script = pool.submit(use, f"http://127.0.0.1:{port}")
        until(lambda: notes(caplog))
        assert notes(caplog)[0].startswith(NOBODY)
        with log_room(port=port):
            assert script.result(LIMIT_S) == "a"
    assert notes(caplog)[-1] == "connected: this script drives agent 'a'"


def test_a_script_waits_until_another_one_gives_its_agent_back(
    caplog: pytest.LogCaptureFixture,
) -> None:
    # real time: it is to pass, and does not begin before the first script is gone
    with log_room(2, grace=0.2) as room, ThreadPoolExecutor() as pool:
        with Script(room) as first:
            first.hello()
            script = pool.submit(connect, room.url, "a")
            until(lambda: notes(caplog))
            assert notes(caplog)[0].startswith(
                "agent 'a' is driven by another script; free are 'b'; an agent is free when its "
                "script ends, or 0.2 s after the connection is lost; trying again for up to"
            )
        with script.result(LIMIT_S) as robot:
            assert robot.sense()["id"] == "a"


def test_without_patience_there_is_one_attempt(caplog: pytest.LogCaptureFixture) -> None:
    with log_room() as room, Script(room) as first:
        first.hello()
        with pytest.raises(RefusedError, match="is driven by another script") as refusal:
            connect(room.url, patience=0)
        assert refusal.value.code == "agent_taken"
    with kept_port() as port, pytest.raises(LostError, match=r"^expected a world, got connection"):
        connect(f"http://127.0.0.1:{port}", patience=0)
    assert notes(caplog) == []


def test_a_script_goes_on_in_a_world_that_was_restarted(caplog: pytest.LogCaptureFixture) -> None:
    with kept_port() as port, ThreadPoolExecutor() as pool:
        with log_room(port=port) as room:
            robot = connect(room.url, mode="lockstep")
            robot.reset()
            robot.act(log=[1])
            before = robot.sense()

        def drive_on() -> RemotePercept:
            while not (percept := robot.sense()).done:
                robot.act(log=[2])
            return percept

        driving = pool.submit(drive_on)
        until(lambda: notes(caplog))
        assert notes(caplog)[0].startswith(LOST)
        with log_room(port=port) as room:
            end = driving.result(LIMIT_S)
            assert (end.truncated, end.terminated, end.reward) == (True, False, 0.0)
            assert (end.episode, end["place"][0]) == (before.episode, before["place"][0])
            assert robot.sense() is end
            assert robot.reset().step == 0
            robot.act(log=[3])
            assert robot.sense().step == 1
            robot.close()
            assert [number for _, _, number in log_of(room)] == [3.0]


def test_a_script_is_not_given_a_robot_with_other_sensors() -> None:
    with kept_port() as port:
        with log_room(port=port) as room:
            robot = connect(room.url, "", mode="lockstep")
            robot.sense()
        other = Scene.load("box_chase").build()
        with served(other, port=port, rules=patient_rules()) as room:
            with pytest.raises(LostError, match="has other sensors or actuators by now; expected"):
                robot.reset()
            agent = room.sim.agents[0]
            until(lambda: agent.brain is agent.brains[0] and len(agent.brains) == 1)


def test_a_script_that_was_away_for_too_long_begins_another_session() -> None:
    # real time: it is to pass, and does not begin before the connection is lost
    with log_room(grace=0.2) as room:
        agent = room.sim.agents[0]
        robot = connect(room.url, mode="lockstep")
        before, first = agent.brains[0], robot.sense()
        session = robot.session
        robot._connection._close()
        until(lambda: agent.brain is before)
        robot.act(log=[1])
        assert robot.sense().truncated
        assert robot.session != session
        assert robot.reset().episode > first.episode
        robot.close()


def test_waiting_note_is_shown_once() -> None:
    dialogue = Dialogue("a", patience=LIMIT_S)
    steps = dialogue.begin()
    step: Any = next(steps)
    said = []
    for _ in range(200):
        if isinstance(step, Note):
            said.append(step.text)
        if isinstance(step, Open):
            step = steps.throw(ConnectionLostError("nothing listens there"))
        else:
            step = steps.send(None)
    assert len(said) == 1
