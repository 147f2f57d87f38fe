"""Scenes that a class gives to a room: opened once, and what a student made is never lost."""

import json
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from ai4u_edu import Scene
from ai4u_edu.member import ClassMember
from ai4u_edu.member.assigned_scenes import MEMORY
from ai4u_edu.page.editing.scene_store import SceneStore
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire.class_link import Applied, Assignment
from tests.builders import small_sim
from tests.member.fake_link import FakeLink, Joined, joined
from tests.waiting import LIMIT_S, until

MAZE = Assignment("a1", "Maze", "maze", 7)
YAML = Scene.load("parking").dumps().replace("title: ", "title: Our ", 1)
PROGRAM = "def decide(percept):\n    return {}\n"


def applied(room: Joined, name: str) -> str:
    """Wait until an assignment was answered; return the problem."""
    return room.next(Applied, lambda answer: answer.assignment == name).problem


def edit(room: Joined) -> None:
    room.editor.change_settings({"title": "A world of mine"}).result(LIMIT_S)


def test_a_scene_is_opened_with_its_seed_and_only_once(tmp_path: Path) -> None:
    with joined(folder=tmp_path) as room:
        room.tell(MAZE)
        assert applied(room, "a1") == ""
        assert (room.editor.state.description.name, room.runner.latest.seed) == ("maze", 7)
        edit(room)
        version = room.editor.version
        room.link.sent.clear()
        room.tell(MAZE)  # after a reconnect, say
        assert applied(room, "a1") == ""
        assert room.editor.version == version
        room.clock.now += 2
        until(lambda: json.loads((tmp_path / MEMORY).read_text())["assignment"] == "a1")
    with joined("maze", tmp_path) as room:  # the room's process was started again
        version = room.editor.version
        room.tell(MAZE)
        assert applied(room, "a1") == ""
        assert room.editor.version == version


def test_a_lesson_is_told_on_the_page_and_may_leave_the_world_as_it_is() -> None:
    with joined() as room:
        before = room.editor.state.description.name
        room.tell(Assignment("b1", "Two wires", "", None, "05 Two wires"))
        assert applied(room, "b1") == ""
        assert room.editor.state.description.name == before
        until(lambda: (room.member.view.event("student", 0) or {})["lesson"] == "05 Two wires")
        room.tell(Assignment("b2", "Maze", "maze", 7, "08 The maze"))
        assert applied(room, "b2") == ""
        assert room.editor.state.description.name == "maze"
        room.tell(Assignment("b3", "Tag", "tag", None))
        assert applied(room, "b3") == ""
        until(lambda: (room.member.view.event("student", 0) or {})["lesson"] == "")


def test_a_program_is_offered_for_the_scene_that_it_came_with() -> None:
    def offered(room: Joined) -> Any:
        return (room.member.view.event("student", 0) or {})["program"]

    with joined() as room:
        room.tell(replace(MAZE, program=PROGRAM))
        assert applied(room, "a1") == ""
        until(lambda: offered(room) == {"scene": "maze", "source": PROGRAM})
        room.tell(Assignment("b", "Ours", YAML, None, "", PROGRAM))
        assert applied(room, "b") == ""
        name = room.editor.state.description.name
        until(lambda: offered(room) == {"scene": name, "source": PROGRAM})
        room.tell(Assignment("c", "Two wires", "", None, "05 Two wires", PROGRAM))
        until(lambda: offered(room) == {"scene": "", "source": PROGRAM})
        room.tell(MAZE)
        until(lambda: offered(room) is None)


def test_pages_open_the_mission_of_an_assignment() -> None:
    def shown(room: Joined) -> Any:
        return (room.member.view.event("student", 0) or {})["mission"]

    with joined() as room:
        room.tell(replace(MAZE, mission="sense-1"))
        assert applied(room, "a1") == ""
        until(lambda: shown(room) == {"mission": "sense-1", "assignment": "a1"})
        room.tell(Assignment("b", "Empty", "my_scene", None, mission="build-1"))
        assert applied(room, "b") == ""
        assert room.editor.state.description.name == "my_scene"
        until(lambda: shown(room) == {"mission": "build-1", "assignment": "b"})
        room.tell(Assignment("c", "Tag", "tag", None))
        until(lambda: shown(room) == {"mission": "", "assignment": "c"})


def test_yaml_is_opened_too(tmp_path: Path) -> None:
    with joined(folder=tmp_path) as room:
        room.tell(Assignment("", "", "", None), Assignment("b", "Ours", YAML, None))
        assert applied(room, "b") == ""
        assert room.editor.title.startswith("Our ")
        assert [each.assignment for each in room.link.of(Applied)] == ["b"]


def test_what_a_student_changed_is_saved_first_under_a_name_that_is_free(tmp_path: Path) -> None:
    with joined(folder=tmp_path) as room:
        store = room.editor.scene_store
        assert store is not None
        store.save("My A world of mine", Scene.load("donut"))
        edit(room)
        room.tell(MAZE)
        assert applied(room, "a1") == ""
        assert store.names() == ["My A world of mine", "My A world of mine 2"]
        assert store.load("My A world of mine 2").description.title == "A world of mine"
        assert store.load("My A world of mine").description.name == "donut"
        # nothing of the class's own or of the library's is saved, nor the same scene twice
        room.editor.open(store.load("My A world of mine 2")).result(LIMIT_S)
        room.tell(Assignment("a2", "", "parking", None))
        assert applied(room, "a2") == ""
        room.editor.open(Scene.load("donut")).result(LIMIT_S)
        room.tell(Assignment("a3", "", YAML, None), Assignment("a4", "", "maze", None))
        assert applied(room, "a4") == ""
        assert len(store.names()) == 2


def test_a_change_of_an_earlier_process_is_saved_too(tmp_path: Path) -> None:
    with joined(folder=tmp_path) as room:
        edit(room)
        (tmp_path / "scene.yaml").write_text(room.editor.text())
    with joined(str(tmp_path / "scene.yaml"), tmp_path) as room:
        assert room.editor.is_as_opened
        room.tell(MAZE)
        assert applied(room, "a1") == ""
    assert SceneStore(tmp_path / "scenes").names() == ["My A world of mine"]


@pytest.mark.parametrize(
    ("scene", "problem"),
    [
        ("no_such_scene", "the library has no scene"),
        ("/etc/passwd", "the library has no scene"),
        ("name: x\nbodies: 5\n", "bodies"),
        ("name: x\n\t- [", "scene"),
        (YAML.replace("WASDController", "NoSuchController"), "NoSuchController"),
    ],
)
def test_a_scene_that_can_not_be_opened_is_answered_and_the_world_goes_on(
    scene: str, problem: str, tmp_path: Path
) -> None:
    with joined(folder=tmp_path) as room:
        version = room.editor.version
        room.tell(Assignment("bad", "", scene, 3))
        assert problem in applied(room, "bad")
        assert room.editor.version == version
        room.tell(Assignment("bad", "", "maze", 3))  # it was not done, so it is tried again
        until(lambda: room.editor.state.description.name == "maze")


def test_a_scene_that_can_not_be_saved_is_not_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    with joined(folder=tmp_path) as room:
        edit(room)
        monkeypatch.setattr("ai4u_edu.page.editing.scene_store.write_atomically", full)
        room.tell(MAZE)
        assert "the present scene can't be saved" in applied(room, "a1")
        assert room.editor.title == "A world of mine"


def test_a_world_without_an_editor_says_that_it_opens_no_scene() -> None:
    runner = Runner(small_sim())
    member = ClassMember(runner, None, FakeLink, title="By hand")
    assert isinstance(member.link, FakeLink)
    link = member.link
    runner.start()
    member.start()
    link.receive(MAZE)
    until(lambda: link.of(Applied))
    assert "can't open another scene" in link.of(Applied)[0].problem
    until(lambda: runner.recorder is not None)
    member.stop()
    runner.stop(LIMIT_S)
