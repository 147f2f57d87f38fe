"""Remote scripts when their world is replaced, or goes back in time."""

from concurrent.futures import ThreadPoolExecutor
from threading import Event

import pytest

from ai4u_edu import Scene
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.remote import LostError, RefusedError, Robot
from tests.page.server.rooms import served
from tests.remote.rooms import connect, patient_rules
from tests.waiting import LIMIT_S

AHEAD = [0.1, 0.0, 0.0, 0.0]


def drive(robot: Robot, decisions: int) -> None:
    for _ in range(decisions):
        robot.act(move=AHEAD)


def test_a_script_is_told_and_gets_the_agent_of_the_same_id_in_the_other_world() -> None:
    with served(Scene.load("box_chase").build(), rules=patient_rules()) as room:
        robot = connect(room.url)
        robot.act(move=AHEAD)
        other = Scene.load("box_chase").build()
        room.runner.replace_sim(other, seed=3).result(LIMIT_S)
        with pytest.raises(LostError, match="another world has taken its place; connect again"):
            drive(robot, 20)
        with connect(room.url, mode="lockstep") as again:
            again.act(move=AHEAD)
            again.sense()
            assert other.agents[0].brain.title() == "RemoteBrain(a script)"
            assert other.agents[0].last_action["move"] == pytest.approx(AHEAD)


def test_a_script_keeps_its_agent_when_the_world_goes_back_in_time() -> None:
    sim = Scene.load("box_chase").build()
    recorder = Recorder(sim)
    with served(sim, rules=patient_rules()) as room:
        room.runner.recorder = recorder
        with connect(room.url, mode="lockstep") as robot:
            first = robot.reset(seed=6)
            drive(robot, 10)
            assert robot.sense().step == 10
            episode = room.runner.submit(recorder.current_episode).result(LIMIT_S)
            assert episode is not None
            room.runner.continue_from(Replay(episode), 4).result(LIMIT_S)
            drive(robot, 4)  # what it says of what it sensed before counts no more
            percept = robot.sense()
            assert percept.episode > first.episode
            assert percept.step == 7


def test_a_script_is_told_the_title_of_the_scene_that_is_there() -> None:
    title = "Box chase"
    with served(
        Scene.load("box_chase").build(), title=lambda: title, rules=patient_rules()
    ) as room:
        with connect(room.url) as robot:
            assert robot.welcome.title == "Box chase"
        title = "Maze"
        with connect(room.url) as robot:
            assert robot.welcome.title == "Maze"


def test_a_script_whose_world_is_replaced_while_it_asks_for_an_agent_is_told() -> None:
    may_go, has_agent = Event(), Event()

    def title() -> str:
        """Note that an agent of the first world was found for the script."""
        has_agent.set()
        return "Box chase"

    scene = Scene.load("box_chase")
    with (
        served(scene.build(), title=title, rules=patient_rules()) as room,
        ThreadPoolExecutor() as pool,
    ):
        room.runner.submit(lambda: may_go.wait(LIMIT_S))
        room.runner.replace_sim(scene.build())
        has_agent.clear()
        script = pool.submit(connect, room.url)
        assert has_agent.wait(LIMIT_S)
        may_go.set()
        with pytest.raises(RefusedError, match="another world has taken its place"):
            script.result(LIMIT_S)
