"""Fields: a script tells a robot more than actions, over our protocol."""

import asyncio
import logging
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from ai4u_edu import AgentArraySensor
from ai4u_edu.recording import Recorder
from ai4u_edu.remote import AsyncRobot, RemoteError
from ai4u_edu.wire import native
from tests.page.server.rooms import Room, served
from tests.remote.rooms import Script, connect, log_sim, patient_rules
from tests.remote.test_report import Lines
from tests.waiting import LIMIT_S


@contextmanager
def told_room(report: Any = None) -> Iterator[Room]:
    """A room whose agent has a sensor of two numbers."""
    goal = AgentArraySensor(perception_key="goal", size=2, range_min=-5, range_max=5)
    sim = log_sim(sensors=[goal])
    rules = patient_rules(lockstep=True)
    with served(sim, rules=rules, script_report=report or Lines()) as room:
        room.runner.scale_time(float("inf"))
        yield room


def test_numbers_reach_the_sensor_and_texts_the_agent() -> None:
    with told_room() as room, connect(room.url, mode="lockstep") as robot:
        assert robot.welcome.fields == ("goal",)
        assert robot.sense()["goal"].tolist() == [0, 0]
        robot.tell(goal=[1, 2.5], colour="red")
        robot.act(log=[1])
        assert robot.sense()["goal"].tolist() == [1, 2.5]
        assert room.sim.agents[0].fields == {"goal": ("1.0", "2.5"), "colour": ("red",)}
        robot.act(log=[2])  # it stays
        assert robot.sense()["goal"].tolist() == [1, 2.5]
        robot.tell(goal=[-1, 0])
        assert robot.reset(seed=3)["goal"].tolist() == [-1, 0], "the first percept has it"
        robot.tell(goal=None, colour=None)
        robot.act(log=[3])
        robot.sense()
        assert room.sim.agents[0].fields == {}


def test_an_unknown_field_is_reported_to_all(caplog: pytest.LogCaptureFixture) -> None:
    lines, sentence = Lines(), "no sensor reads the field 'gaol'; did you mean 'goal'?"
    with told_room(lines) as room, connect(room.url, mode="lockstep") as robot:
        robot.sense()
        with caplog.at_level(logging.INFO, "ai4u_edu.remote"):
            robot.tell(gaol=[1, 2])
            robot.tell(gaol=[1, 2])
        assert [record.message.count(sentence) for record in caplog.records] == [1]
        for _ in range(2):
            robot.act(log=[1])
            robot.sense()
        status = room.sim.agents[0].brain.status()  # type: ignore[attr-defined]
        assert (status.warnings, status.warning) == (1, sentence)


def test_what_does_not_fit_is_refused(caplog: pytest.LogCaptureFixture) -> None:
    with told_room() as room, connect(room.url, mode="lockstep") as robot:
        robot.sense()
        for value in (object(), [[1]], {1: 2}.items()):
            with pytest.raises(RemoteError, match="tell: goal: expected numbers, text or None"):
                robot.tell(goal=value)
        with pytest.raises(RemoteError, match="tell: "):
            robot.tell(goal="x" * 10_000)
        robot.tell(goal=[9, 9])
        robot.act(log=[1])
        robot.sense()
        status = room.sim.agents[0].brain.status()  # type: ignore[attr-defined]
        assert "expected values from -5 to 5, got 9.0" in status.warning


def test_an_async_robot_tells_as_well() -> None:
    async def drive(url: str) -> Any:
        async with AsyncRobot(url, mode="lockstep", patience=LIMIT_S) as robot:
            await robot.sense()
            await robot.tell(goal=[1, 1])
            await robot.act(log=[1])
            return (await robot.sense())["goal"].tolist()

    with told_room() as room:
        assert asyncio.run(drive(room.url)) == [1, 1]


def test_a_recording_has_it_once() -> None:
    with told_room() as room, connect(room.url, mode="lockstep") as robot:
        recorder = Recorder(room.sim)
        robot.tell(goal=[2, 3])
        robot.reset(seed=3)
        for number in range(4):
            robot.act(log=[number])
            robot.sense()
        robot.reset()
        (episode,) = [each for each in recorder.episodes if each.seed == 3]
    assert [tuple(given.values) for given in episode.inputs] == [(2, 3)]


def test_an_answer_without_fields_is_as_short_as_before() -> None:
    with told_room() as room, Script(room) as script:
        assert isinstance(script.hello(), native.Welcome)
    assert native.encode(native.Reset(3, None)) == native.encode(native.Reset(3, None, None))
