"""A script on another machine, while somebody changes the agent or the scene under it."""

import pytest

from ai4u_edu import Scene
from ai4u_edu.blocks import RemoteBrain
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.remote import RemoteError, Robot, connect
from tests.page.editing.harness import TEXT
from tests.page.server.rooms import served
from tests.waiting import LIMIT_S, Deadline, until


def drive_on(robot: Robot) -> None:
    """Drive until the world says that this is over."""
    deadline = Deadline()
    while deadline.left():
        robot.act(move=[1, 0, 0, 0])


def test_a_script_hears_that_the_agent_is_another_one_and_can_come_back() -> None:
    scene = Scene.loads(TEXT)
    with served(scene.build()) as room:
        editor = SceneEditor(room.runner, scene)
        with connect(room.url, patience=LIMIT_S) as robot:
            robot.act(move=[1, 0, 0, 0])
            editor.move_body("wall", -4, 1).result(LIMIT_S)
            robot.act(move=[1, 0, 0, 0])  # that was none of its business
            editor.add_block("0", "sensors", {"type": "HeadingSensor"}).result(LIMIT_S)
            with pytest.raises(RemoteError, match="the agent's blocks were changed; connect again"):
                drive_on(robot)
        with connect(room.url, patience=LIMIT_S) as robot:
            assert "heading" in robot.sense()
            agent = room.runner.sim.agents[0]
            until(lambda: "script" in agent.brain.title())
            assert editor.driver_of("0") == ""
        until(lambda: editor.driver_of("0") == "brain:0")


def test_another_scene_ends_a_scripts_turn_and_leaves_nothing_behind() -> None:
    scene = Scene.loads(TEXT)
    with served(scene.build()) as room:
        editor = SceneEditor(room.runner, scene)
        with connect(room.url, patience=LIMIT_S) as robot:
            robot.act(move=[1, 0, 0, 0])
            old = room.runner.sim.agents[0]
            editor.open(Scene.load("sumo")).result(LIMIT_S)
            with pytest.raises(RemoteError):
                drive_on(robot)
        assert isinstance(old.brain, RemoteBrain)
        assert old.brain.status().state == "waiting"
        with connect(room.url, agent="orange", patience=LIMIT_S) as robot:
            assert robot.sense()["id"] == "orange"
