"""Options add to the page of a world, and each can be left out."""

import subprocess
import sys
from uuid import uuid4

import pytest

from ai4u_edu import Scene
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.room import serve_world
from ai4u_edu.room.options import OPTIONS
from ai4u_edu.runtime.runner import Runner
from tests.page.panel.rooms import PanelPage, PanelRoom, picture
from tests.page.server.rooms import PATIENT
from tests.room import greeting
from tests.waiting import LIMIT_S, until

WITHOUT_EXPLANATIONS = """
import sys

sys.modules["ai4u_edu.explain"] = sys.modules["ai4u_edu.explain_page"] = None

from ai4u_edu.cli import play  # the command's module itself
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.remote import connect
from ai4u_edu.room import Room, RoomSettings
from ai4u_edu.page.server import ServerThread
from tests.page.panel.rooms import PanelPage
from tests.page.server.rooms import PATIENT

with Room(RoomSettings(scene="box_chase", wait_for_key=False)) as room:
    with ServerThread(room.page.app, timeouts=PATIENT) as server:
        with PanelPage(server.url + "ws/panel") as page:
            page.part("run")
            page.done("new_start")
            print(page.failed("why", on=True)["text"])
        with connect(server.url, agent="0") as robot:
            robot.act(move=[1, 0, 0, 0])
            print("done" in robot.sense())
env = SceneEnv("box_chase")
env.reset(seed=1)
env.step(env.action_space.sample())
"""


def test_an_option_from_elsewhere_adds_a_command_and_parts() -> None:
    scene = Scene.load("box_chase")
    runner = Runner(scene.build(), seed=1)
    editor = SceneEditor(runner, scene)
    runner.paused = True
    runner.start()
    page_id = uuid4().hex
    modules = (*OPTIONS, greeting.__name__)
    with serve_world(runner, options=modules, timeouts=PATIENT) as world:
        option, other = greeting.made[-1], PanelPage(world.url + "ws/panel")
        room = PanelRoom(runner, world.viewer, editor, world.context, world.url)
        with room.page(f"?page={page_id}") as page, other, picture(room, page_id):
            assert page.done("greet", who="world")["text"] == "Hello world."
            page.part("greeting", text="Hello world")
            label = option.label
            assert label is not None
            until(lambda: label.texts)
            assert label.texts[0] == f"Hello world at {runner.latest.tick}"
            assert "expected str" in page.failed("greet", who=3)["text"]
            page.done("why", on=True)  # those of the package are there too
            other.done("reduce_motion", on=True)
            assert "greeting" not in other.parts
    assert option.is_stopped
    runner.stop(LIMIT_S)


def test_a_page_does_without_an_option_that_is_not_there() -> None:
    runner = Runner(Scene.load("box_chase").build(), seed=1)
    with (
        serve_world(runner, options=("no_such_option",), timeouts=PATIENT) as world,
        PanelPage(world.url + "ws/panel") as page,
    ):
        page.part("run")
        assert "no command is called 'why'" in page.failed("why", on=True)["text"]
    runner.stop(LIMIT_S)


@pytest.mark.slow
def test_play_scripts_and_environments_work_without_explanations() -> None:
    command = [sys.executable, "-c", WITHOUT_EXPLANATIONS]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    refused, has_sensed = done.stdout.splitlines()
    assert refused.startswith("no command is called 'why'")
    assert has_sensed == "True"
