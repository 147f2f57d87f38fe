"""Missions in the page of a running world: opened, checked, answered and left."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from ai4u_edu import Scene
from ai4u_edu.locale import LIBRARY, PSEUDO, Catalogue
from ai4u_edu.missions.checks import Chooses
from ai4u_edu.missions.mission import library_missions
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.scene_pictures import load_by_name
from ai4u_edu.room import serve_world
from ai4u_edu.runtime.runner import Runner
from tests.missions.test_run import TEXT
from tests.page.panel.rooms import PanelPage, PanelRoom, panel_room
from tests.page.server.rooms import PATIENT
from tests.waiting import LIMIT_S


@pytest.fixture(scope="module")
def room() -> Iterator[PanelRoom]:
    with panel_room("box_chase") as room:
        yield room


@pytest.fixture
def page(room: PanelRoom) -> Iterator[PanelPage]:
    with room.page() as page:
        page.part("mission", mission="")
        yield page


def drive(room: PanelRoom, *codes: str, decisions: int = 20) -> None:
    """Have keys held for some decisions; each holds them again, since they are let go by time."""
    sim = room.runner.sim

    def decide() -> None:
        sim.agents[0].keyboard.hold(codes)
        sim.step()

    for _ in range(decisions):
        room.runner.submit(decide).result(LIMIT_S)


def test_a_number_is_read_before_the_first_decision(room: PanelRoom, page: PanelPage) -> None:
    room.runner.reset(1).result(LIMIT_S)
    number = float(room.runner.latest.agents[0].percept["orientation"][1])
    page.done("mission_open", mission="sense-1", step=3)
    page.part("mission", step=3, is_done=False)
    page.done("mission_answer", answer=f"{number:.2f}")
    page.part("mission", is_done=True)


def test_keys_do_a_step(room: PanelRoom, page: PanelPage) -> None:
    room.runner.reset(1).result(LIMIT_S)
    page.done("mission_open", mission="drive-1")
    page.part("mission", mission="drive-1", step=0, is_done=False)
    drive(room, "KeyW", decisions=4)
    page.part("mission", lambda part: part["words"] > "0.0 of 3 m")
    drive(room, "KeyW", decisions=20)
    part = page.part("mission", is_done=True)
    assert "*body*" in part["done"]
    page.done("mission_open", mission="drive-1", step=1)
    page.part("mission", step=1, is_done=False)


def test_an_unknown_mission_is_refused_with_a_suggestion(page: PanelPage) -> None:
    assert "did you mean 'drive-1'?" in page.failed("mission_open", mission="drive-11")["text"]
    assert "no mission is open" in page.failed("mission_answer", answer="1")["text"]


def test_the_first_part_says_that_the_world_has_another_scene(page: PanelPage) -> None:
    page.done("mission_open", mission="teach-3")
    part = page.part("mission", mission="teach-3")
    assert (part["is_here"], part["scene"]) == (False, "box_chase_ai4u")


def test_a_tab_and_a_number_are_seen(room: PanelRoom, page: PanelPage) -> None:
    room.runner.reset(1).result(LIMIT_S)
    page.done("mission_open", mission="code-1")
    page.done("mission_see", tab="code")
    page.done("mission_see", tab="code", way="python")
    page.part("mission", mission="code-1", is_done=True)
    page.done("mission_open", mission="sense-1", step=3)
    page.part("mission", mission="sense-1", step=3)
    drive(room, decisions=1)
    page.done("mission_answer", answer="7")
    page.part("mission", words="Not 7. Look at the number again.")
    distance = float(room.runner.sim.agents[0].percept["orientation"][1])
    page.done("mission_answer", answer=f"{distance:.2f}")
    page.part("mission", is_done=True)


def test_a_function_is_judged_by_what_the_page_says_it_returned(page: PanelPage) -> None:
    page.done("mission_open", mission="code-9")
    part = page.part("mission", mission="code-9")
    assert part["exercise"] == {
        "id": "01.1",
        "function": "speed_for",
        "text": "def speed_for(distance, seconds):\n    return 0",
    }
    assert "no function is being checked" in page.failed("mission_returned", value="1")["text"]
    answer = page.done("mission_judge", source="a")
    assert answer["arguments"] == "[6, 3]"
    answer = page.done("mission_returned", value='{"shown": "<set>"}')
    assert (answer["passed"], answer["text"]) == (False, "Expected a number, got `<set>`.")
    page.part("mission", words="Expected a number, got `<set>`.")

    answer = page.done("mission_judge", source="a")
    while "arguments" in answer:
        distance, seconds = json.loads(answer["arguments"])
        answer = page.done("mission_returned", value=json.dumps(distance / seconds))
    assert answer["passed"]
    page.part("mission", is_done=True)
    page.done("mission_open", mission="drive-1")
    page.part("mission", mission="drive-1", exercise=None)
    assert "no function to check" in page.failed("mission_judge", source="a")["text"]


def test_a_robot_is_judged_as_it_is_built() -> None:
    with panel_room("box_chase") as room, room.page() as page:
        page.done("mission_open", mission="build-7")
        part = page.part("mission", mission="build-7", scene_title="A robot with legs")
        assert part["exercise"] == {"id": "03.1", "function": "", "text": ""}
        scene = load_by_name("lesson_03_legs")
        assert scene is not None
        room.editor.open(scene).result(LIMIT_S)
        page.part("mission", is_here=True)
        answer = page.done("mission_judge", source="")
        assert not answer["passed"]
        assert "In one second the robot drove" in answer["text"]
        values = {"move_amount": 2, "turn_amount": 3}
        page.done("change_block", path=["actuators", 0], values=values)
        assert page.done("mission_judge", source="")["passed"]
        page.part("mission", is_done=True)


def test_only_the_page_that_drives_goes_on(room: PanelRoom, page: PanelPage) -> None:
    room.runner.reset(1).result(LIMIT_S)
    with room.page() as other:
        for each in (page, other):
            each.done("mission_open", mission="drive-1")
            each.part("mission", mission="drive-1")
        other.done("mission_see", tab="", is_watching=True)
        drive(room, "KeyW")
        page.part("mission", is_done=True)
        assert not other.parts["mission"]["is_done"]
        assert other.parts["mission"]["words"] == "0.0 of 3 m"


def test_another_scene_is_told_and_the_mission_goes_on_there() -> None:
    with panel_room("box_chase") as room, room.page() as page:
        page.done("mission_open", mission="sense-2")
        page.part("mission", mission="sense-2", is_here=False, scene_title="Maze")
        room.editor.open(Scene.load("maze")).result(LIMIT_S)
        page.part("mission", is_here=True)
        room.runner.reset(2).result(LIMIT_S)
        drive(room, "KeyW", decisions=3)
        page.part("mission", lambda part: part["words"] != "0.0 of 2 m")


def test_a_closed_mission_listens_to_nothing() -> None:
    with panel_room("box_chase") as room, room.page() as page:
        agent = room.runner.sim.agents[0]
        before = len(agent.percept_ready.handlers)
        page.done("mission_open", mission="drive-1")
        page.done("mission_see", tab="")  # the mission is known in the world's thread by then
        assert len(agent.percept_ready.handlers) == before + 1
        page.done("mission_close")
        page.part("mission", mission="")
        drive(room, decisions=2)
        assert len(agent.percept_ready.handlers) == before


def test_a_teachers_mission_changes_when_it_is_saved(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text(TEXT)
    scene = Scene.load("maze")
    runner = Runner(scene.build(), seed=1)
    editor = SceneEditor(runner, scene)
    editor.missions_folder = tmp_path
    runner.paused = True
    runner.start()
    with (
        serve_world(runner, editor=editor, timeouts=PATIENT) as world,
        PanelPage(world.url + "ws/panel") as page,
    ):
        page.done("mission_open", mission="mine")
        page.part("mission", title="Test", island="My class", is_here=True)
        file.write_text(TEXT.replace("title: Test", "title: Saved again"))
        page.part("mission", title="Saved again")
        file.unlink()
        page.part("mission", title="Saved again")  # it can be done to its end
    runner.stop(LIMIT_S)


def test_a_world_without_an_editor_has_no_missions() -> None:
    with panel_room("box_chase", can_edit=False) as room, room.page() as page:
        page.part("run")
        assert "no command is called" in page.failed("mission_open", mission="drive-1")["text"]
        assert "mission" not in page.parts


def test_a_question_is_asked_and_answered_in_the_language_of_its_page() -> None:
    name, mission, step, check = next(
        (name, mission, number, each.check)
        for name, mission in library_missions().by_name.items()
        for number, each in enumerate(mission.steps)
        if isinstance(each.check, Chooses) and mission.scene in Scene.names()
    )
    accented = Catalogue(PSEUDO, LIBRARY)
    header = {"Accept-Language": "en-XA"}
    with (
        panel_room(mission.scene) as room,
        PanelPage(room.url + "ws/panel", additional_headers=header) as page,
    ):
        page.done("mission_open", mission=name, step=step)
        shown = page.part("mission", lambda part: part["mission"] == name)
        assert shown["say"] == accented.message(mission.steps[step].say)
        assert shown["question"]["options"] == [accented.message(each) for each in check.options]
        wrong = next(each for each in check.options if each != check.right)
        page.done("mission_answer", answer=accented.message(wrong))
        told = page.part("mission", lambda part: part["words"])["words"]
        assert accented.message(wrong) in told
        assert "Try it" not in told
        page.done("mission_answer", answer=accented.message(check.right))
        page.part("mission", lambda part: part["is_done"])
