"""Options add to the page of a world, and each can be left out."""

import subprocess
import sys
from uuid import uuid4

import httpx
import pytest

from ai4u_edu import Scene
from ai4u_edu.base.options import PAGE_OPTIONS
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.room import serve_world
from ai4u_edu.runtime.runner import Runner
from tests.page.panel.rooms import PanelPage, PanelRoom, picture
from tests.page.server.rooms import PATIENT
from tests.playing import played
from tests.room import greeting
from tests.waiting import LIMIT_S, until
from tests.without import ACT, OPTIONS, STEPS, code_without


def test_an_option_from_elsewhere_adds_a_command_and_parts() -> None:
    scene = Scene.load("box_chase")
    runner = Runner(scene.build(), seed=1)
    editor = SceneEditor(runner, scene)
    runner.paused = True
    runner.start()
    page_id = uuid4().hex
    modules = (*PAGE_OPTIONS, greeting.__name__)
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
            page.part("tabs", tabs=[{"name": "greeting", "title": "Greeting"}])
            script = httpx.get(f"{world.url}web/options/greeting.js", timeout=LIMIT_S)
            assert script.headers["content-type"].startswith("text/javascript")
            assert "export class Tab" in script.text
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
@pytest.mark.parametrize("option", OPTIONS)
def test_play_scripts_and_environments_work_without_an_option(option: str) -> None:
    refused = OPTIONS[option]
    main = code_without(refused, "from ai4u_edu.cli.main import main; main()")
    with played("box_chase", program=["-c", main]) as world:
        with PanelPage(world.url + "ws/panel") as page:
            page.part("run")
            page.part("scene", title="Box chase")
            page.done("new_start")
            page.send({"type": "show", "agent": "0", "tabs": ["agent", "blocks", "world", "past"]})
            for name in ("agent", "blocks", "world", "past", "view"):
                page.part(name)
            if option == "explain":
                answer = page.failed("why", on=True)
                assert answer["text"].startswith("no command is called 'why'")
            else:
                page.done("why", on=True)
        missions = httpx.get(f"{world.url}api/missions", timeout=LIMIT_S).json()["missions"]
        # the course's judges, which read programs, judge the exercises among the missions
        assert bool(missions) == (option not in ("missions", "lessons", "program"))
        steps = "" if option == "learn" else STEPS
        command = [sys.executable, "-c", code_without(refused, steps + ACT.format(url=world.url))]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr, done.stdout) == (0, "", "True\n")


@pytest.mark.slow
def test_a_driver_from_a_missing_option_is_an_error_that_says_so() -> None:
    main = code_without(OPTIONS["learn"], "from ai4u_edu.cli.main import main; main()")
    command = [sys.executable, "-c", main, "play", "box_chase", "--brain", "zoo:box_chase"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "--brain needs ai4u_edu.learn.training.assigned, which" in done.stderr
