"""The client's verbs, against a real server."""

import asyncio

import numpy as np
import pytest

from ai4u_edu.base.errors import ActionError, NameNotFoundError
from ai4u_edu.remote import AsyncRobot, LostError, RemoteError, Robot
from ai4u_edu.wire.native import Output
from tests.remote.rooms import connect, log_of, log_room
from tests.waiting import LIMIT_S, until


def test_sense_act_reset() -> None:
    with log_room(max_steps=3) as room, connect(room.url, mode="lockstep") as robot:
        percept = robot.reset(seed=4)
        assert robot.sense() is percept  # until it is answered
        assert (percept.episode, percept.step, percept.done) == (2, 0, False)
        assert percept["place"].tolist() == [2.0, 0.0]
        assert (percept["id"], percept["done"]) == ("a", False)
        robot.act(log=[7])
        percept = robot.sense()
        assert (percept.step, percept.reward, percept.reward_terms) == (1, 1.0, {"pay": 1.0})
        robot.act({"log": np.array([8.0])})
        robot.act(9)  # one actuator: its numbers alone; the percept in between was not looked at
        percept = robot.sense()
        assert (percept.truncated, percept.terminated, percept.done) == (True, False, True)
        with pytest.raises(ActionError, match=r"^the episode is over \(truncated\); reset\(\)"):
            robot.act(log=[1])
        assert robot.reset().episode == 3
        assert [entry for entry in log_of(room) if entry[0] == 2] == [
            (2, 0, 7.0),
            (2, 1, 8.0),
            (2, 2, 9.0),
        ]


def test_iteration_gives_what_needs_an_action() -> None:
    with log_room(max_steps=4) as room, connect(room.url, mode="lockstep") as robot:
        robot.reset()
        steps = []
        for percept in robot:
            steps.append(percept.step)
            robot.act(log=[percept.step])
        assert steps == [0, 1, 2, 3]
        assert robot.percept is not None
        assert robot.percept.truncated
        robot.reset()
        with pytest.raises(RemoteError, match=r"expected robot.act\(...\) in the loop, such as "):
            for _ in robot:
                pass
        for percept in robot:
            robot.act()
            assert percept.step < 4
        assert [episode for episode, _, _ in log_of(room) if episode == 3] == []


def test_percepts_are_frozen_and_know_their_names() -> None:
    with log_room() as room, connect(room.url, mode="lockstep") as robot:
        percept = robot.sense()
        with pytest.raises(ValueError, match="read-only"):
            percept["place"][0] = 1.0
        with pytest.raises(NameNotFoundError, match="no reading is called 'plaec'; did you mean"):
            percept["plaec"]
        assert set(percept) == {"place", "done", "id"}


@pytest.mark.parametrize(
    ("action", "complaint"),
    [
        ({"lgo": [1]}, "no actuator is called 'lgo'; did you mean 'log'?"),
        ({"log": [1, 2]}, "action 'log': expected 1 finite number, got [1, 2]"),
        ({"log": "fast"}, "action 'log': expected 1 finite number, got 'fast'"),
        ({"log": [float("nan")]}, "action 'log': expected 1 finite number, got [nan]"),
        ({"log": None}, "action 'log': expected 1 finite number, got None"),
    ],
)
def test_a_bad_action_is_found_before_it_leaves(action: dict[str, object], complaint: str) -> None:
    with log_room() as room, connect(room.url, mode="lockstep") as robot:
        with pytest.raises(ActionError) as caught:
            robot.act(action)
        assert str(caught.value) == complaint
        robot.act(log=[1])
        assert robot.sense().reward == 1.0
        assert room.sim.agents[0].brain.status().refused == 0  # type: ignore[attr-defined]


def test_what_the_world_refuses_can_be_answered_again() -> None:
    with log_room() as room, connect(room.url, mode="lockstep") as robot:
        percept = robot.sense()
        robot._dialogue.outputs = {"log": Output("log", "box", (0.0, 0.0), (1.0, 1.0), True)}
        robot.act(log=[1, 2])
        with pytest.raises(ActionError, match="action 'log': expected 1 numbers, got 2"):
            robot.sense()
        assert robot.sense() is percept


def test_a_robot_that_is_closed_gives_the_seat_back() -> None:
    with log_room() as room:
        before = room.sim.agents[0].brain
        with connect(room.url) as robot:
            robot.sense()
            assert room.sim.agents[0].brain.title() == "RemoteBrain(a script)"
        until(lambda: room.sim.agents[0].brains == [before])
        assert room.sim.agents[0].brain is before
        robot.close()
        with pytest.raises(LostError, match="the robot was closed"):
            robot.act(log=[1])
        with connect(room.url) as again:
            assert again.sense()["id"] == "a"


def test_a_notebooks_cell_can_be_run_again() -> None:
    with log_room() as room:
        first = connect(room.url, mode="lockstep")
        second = connect(room.url, mode="lockstep")
        with pytest.raises(LostError, match="the robot was closed"):
            first.sense()
        assert second.sense()["id"] == "a"
        second.close()


def drive(robot: Robot) -> None:
    for _ in range(100):
        robot.act(log=[1])


def test_another_brain_takes_the_place_and_the_script_is_told() -> None:
    with log_room() as room, connect(room.url, mode="lockstep") as robot:
        robot.act(log=[1])
        agent = room.sim.agents[0]
        room.runner.submit(lambda: agent.use_brain(agent.brains[0])).result(LIMIT_S)
        with pytest.raises(LostError, match="ended"):
            drive(robot)
        assert agent.brain is agent.brains[0]


def test_the_asynchronous_robot_has_the_same_verbs() -> None:
    async def drive(url: str, agent: str) -> list[int]:
        async with AsyncRobot(url, agent, mode="lockstep", patience=LIMIT_S) as robot:
            await robot.reset()
            steps = []
            async for percept in robot:
                steps.append(percept.step)
                await robot.act(log=[percept.step])
            return steps

    async def both(url: str) -> list[list[int]]:
        return list(await asyncio.gather(drive(url, "a"), drive(url, "b")))

    with log_room(2, max_steps=5) as room:
        assert [len(steps) for steps in asyncio.run(both(room.url))] == [5, 5]


def test_robot_repr_and_spaces() -> None:
    with log_room() as room, connect(room.url, mode="lockstep") as robot:
        assert repr(robot) == "Robot('a' in 'A room', lockstep)"
        spaces = robot.spaces
        assert spaces.action.shape == (1,)
        assert list(spaces.observation) == ["place"]
        assert robot.welcome.rewards == ("pay",)
