"""Several agents, in lockstep and in realtime; and people who want something meanwhile."""

import threading
from socket import SHUT_RDWR
from typing import Any

import pytest

from ai4u_edu.page.server.limits import frames
from ai4u_edu.page.server.scripts import sockets
from ai4u_edu.remote import Robot
from tests.remote.rooms import Place, Script, connect, log_of, log_room
from tests.waiting import LIMIT_MS, LIMIT_S, until


def test_in_lockstep_all_agents_take_each_step_together() -> None:
    with log_room(3) as room:
        robots = [connect(room.url, agent, mode="lockstep") for agent in "abc"]
        ends: list[int] = []

        def drive(robot: Robot) -> None:
            with robot:  # whoever has finished leaves, since the others would wait for it
                for number in range(50):
                    robot.act(log=[number])
                    robot.sense()
                ends.append(robot.sense().tick)

        threads = [threading.Thread(target=drive, args=(robot,)) for robot in robots]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(LIMIT_S)
        assert len(ends) == 3
        for agent in "abc":
            assert [number for _, _, number in log_of(room, agent)] == list(range(50))
        # an agent that was claimed while the world waited for another one begins with the next tick
        assert max(ends) - min(ends) <= 1


def test_a_silent_script_in_realtime_slows_nobody() -> None:
    with log_room(2) as room, Script(room) as silent:
        silent.hello(mode="realtime")
        with connect(room.url, "b", mode="lockstep") as robot:
            for number in range(300):
                robot.act(log=[number])
                robot.sense()
            assert len(log_of(room, "b")) == 300
        status = room.sim.agent("a").brain.status()  # type: ignore[attr-defined]  # RemoteBrain
        assert (status.state, status.decisions) == ("late", 0)


def test_a_world_that_waits_still_does_what_people_ask() -> None:
    with log_room() as room, Script(room) as script:
        welcome = script.hello()
        percept = script.percept()
        room.runner.pause().result(LIMIT_S)
        assert room.runner.latest.paused
        room.runner.resume().result(LIMIT_S)
        script.act(percept, 1)
        percept = script.percept()
        room.runner.reset(seed=9).result(LIMIT_S)
        until(lambda: room.runner.submit(lambda: room.sim.waiting_for_brain).result(LIMIT_S))
        assert script.hello() == welcome  # nothing was sent before: it owes an answer
        assert script.percept() == percept
        script.act(percept, 2)
        assert script.percept().truncated  # its episode was cut off


@pytest.mark.parametrize("time_scale", [float("inf"), 1000.0])
def test_blocks_run_in_the_worlds_own_thread_wherever_answers_are_heard(time_scale: float) -> None:
    names = []

    class Where(Place):
        def read(self, body: object, view: object) -> object:
            names.append(threading.current_thread().name)
            return super().read(body, view)

    with log_room(time_scale=time_scale) as room:
        sensor = room.sim.agents[0].sensors[0]
        sensor.__class__ = Where
        with connect(room.url, mode="lockstep") as robot:
            robot.sense()
            names.clear()
            for number in range(50):
                robot.act(log=[number])
                robot.sense()
        assert len(names) >= 50
        assert set(names) == {"runner"}


def test_answers_take_the_short_way_and_find_another_one(monkeypatch: pytest.MonkeyPatch) -> None:
    taken = []
    hear = sockets._ScriptConnection.hear_answer

    def count(self: sockets._ScriptConnection, frame: bytes) -> bool:
        taken.append(hear(self, frame))
        return taken[-1]

    monkeypatch.setattr(sockets._ScriptConnection, "hear_answer", count)
    for extension, short in ((frames.EXTENSION, True), ("there is none", False)):
        monkeypatch.setattr(sockets, "EXTENSION", extension)
        taken.clear()
        with log_room() as room, connect(room.url, mode="lockstep") as robot:
            for number in range(20):
                robot.act(log=[number])
                robot.sense()
            assert [number for _, _, number in log_of(room)] == list(range(20))
        assert (taken.count(True) >= 20) == short


@pytest.mark.parametrize("silence", ["idle", "cut off"])
def test_a_silent_script_in_lockstep_is_given_up_and_the_world_goes_on(silence: str) -> None:
    # real time: the limit is to pass, and is raised when it has
    with log_room(2, receive_timeout=300) as room, Script(room) as silent:
        silent.hello()
        percept = silent.percept()
        brain: Any = room.sim.agent("a").brain
        if silence == "cut off":
            silent.socket.socket.shutdown(SHUT_RDWR)
        until(lambda: brain.status().missing > 100)  # asked each time, that would take 30 s
        status = brain.status()
        assert status.state == "late"
        assert "given up, the world goes on until it answers" in status.reason
        if silence == "idle":
            brain.receive_timeout = int(LIMIT_MS)
            silent.act(percept, 7)  # too late; but it is there again, and is waited for
            percept = silent.percept()
            silent.act(percept, 8)
            assert silent.percept().step == percept.step + 1
            assert 7.0 not in [number for _, _, number in log_of(room)]
