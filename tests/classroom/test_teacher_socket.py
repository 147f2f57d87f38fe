"""The teacher's commands and pages in a real class: assignments, attention, looking in."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed

from ai4u_edu import Scene
from ai4u_edu.wire.class_link import (
    VERSION,
    Applied,
    Assignment,
    Attention,
    ClassSettings,
    LinkHello,
    Switches,
    Work,
)
from tests.classroom.link_client import RawLink, TeacherSocket, state
from tests.classroom.served_class import ServedClass, served_class
from tests.page.server import http_client
from tests.page.server.rooms import Page, open_socket
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.slow
SWITCHES = ", ".join(Switches.__struct_fields__)
OWN = Scene.load("box_chase").source.replace("title: Box chase", "title: <b>Mine</b>")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("class")


@pytest.fixture(scope="module")
def served(folder: Path) -> Iterator[ServedClass]:
    with served_class(folder) as served:
        served.joined()  # seat 1
        yield served


def id_of(served: ServedClass) -> str:
    return f"seat-{max(each['number'] for each in served.state()['seats'])}"


def test_pages_of_the_teacher_need_the_secret(served: ServedClass) -> None:
    for path in ("teacher/socket", "projector/socket"):
        with open_socket(served.url + path) as socket, pytest.raises(ConnectionClosed):
            socket.recv(LIMIT_S)
    assert http_client.get(served.url + "projector").status_code == 401


def test_the_first_event_of_a_new_class_has_everything(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        served.joined(name="Red Fox")
        with TeacherSocket(served) as wall:
            event = wall.next("class")
        (maze,) = [each for each in event["scenes"] if each["name"] == "maze"]
        assert http_client.get(served.url + maze["picture"]).content.startswith(b"\x89PNG")
    assert event["qr"].startswith("data:image/svg+xml,")
    assert event["address"] == served.url
    titles = {each["name"]: each["title"] for each in event["scenes"]}
    assert titles == {name: Scene.load(name).description.title for name in Scene.names()}
    lesson = next(each for each in event["exercises"] if each["lesson"] == "04")
    assert "04.2" in lesson["ids"]
    (about,) = [each for each in event["lessons"] if each["number"] == "04"]
    assert about["title"] == "Sensors: what can it know?"
    assert about["scene"] in titles
    assert event["shown"] == {"kind": "join", "room": "", "game": 0}
    assert event["attention"] == {"kind": "", "message": "", "ends_in": 0}
    (seat,) = [each for each in event["seats"] if each["name"] == "Red Fox"]
    (room,) = [each for each in event["rooms"] if seat["number"] in each["seats"]]
    assert (room["status"], room["is_running"], room["kind"]) == ("asleep", False, "local")


def test_everybody_sees_no_progress_and_nobody_who_needs_help(served: ServedClass) -> None:
    with TeacherSocket(served, "projector") as projector:
        event = projector.next("class")
    assert not {"progress", "misconceptions"} & event.keys()
    assert all("help" not in each and "why" not in each for each in event["rooms"])


def has_told_all(room: dict[str, Any]) -> bool:
    """Return True once its error is there and what was sent last, its state."""
    return "not</i>" in room["error"] and room["status"] == "driving"


def test_scenes_are_assigned_to_one_or_all(served: ServedClass) -> None:
    ada, ben = served.joined(), served.joined()
    with RawLink(served, ada) as one:
        name = id_of(served).replace("seat-", "")
        first = f"seat-{int(name) - 1}"
        with RawLink(served, ben) as two:
            body: dict[str, Any] = {"rooms": [first], "scene": "maze", "seed": 7}
            assert served.command("assign", **body).status_code == 200
            given = one.next(Assignment, lambda message: message.seed == 7)
            assert (given.title, given.scene) == ("Maze", "maze")
            one.send(Applied(given.id, "it did <i>not</i> work"))
            one.send(Work("Mine", OWN))
            one.send(state())
            with TeacherSocket(served) as wall:
                wall.next("class", lambda e: any(has_told_all(r) for r in e["rooms"]))
            source = {"room": first}
            answer = served.command("assign", rooms="all", scene=source, same_seed=True)
            assert answer.status_code == 200, answer.text
            given = two.next(Assignment, lambda message: message.scene == OWN)
            assert given.title == "<b>Mine</b>"
            assert given.seed is not None
            assert one.next(Assignment, lambda message: message.id == given.id) == given
    with RawLink(served, served.joined()) as late:
        assert late.next(Assignment).id == given.id


@pytest.mark.parametrize(
    ("number", "title", "scene"),
    [
        ("04", "04 Sensors: what can it know?", "sample_scene"),
        ("05", "05 A vehicle with two wires", ""),
    ],
)
def test_a_lesson_is_assigned_with_the_scene_that_it_begins_with(
    served: ServedClass, number: str, title: str, scene: str
) -> None:
    with RawLink(served, served.joined()) as link:
        answer = served.command("assign", rooms="all", scene={"lesson": number})
        assert answer.status_code == 200, answer.text
        given = link.next(Assignment, lambda message: message.lesson == title)
        assert given.scene == scene


def test_attention_holds_for_whoever_connects_and_ends_by_itself(served: ServedClass) -> None:
    assert served.command("attention", kind="blank", message="Look <here>").status_code == 200
    with RawLink(served, served.joined()) as link, TeacherSocket(served) as wall:
        assert link.next(Attention) == Attention("blank", "Look <here>", 0)
        assert wall.next("class")["attention"]["kind"] == "blank"
        assert served.command("attention", kind="pause", message="", seconds=900).status_code == 200
        told = link.next(Attention)
        assert (told.kind, 0 < told.ends_in_s <= 900) == ("pause", True)
        # so short a one may be over before a link is told of it
        assert served.command("attention", kind="pause", message="", seconds=0.3).status_code == 200
        assert link.next(Attention, lambda each: each.kind == "") == Attention("", "", 0)
        wall.next("class", lambda e: e["attention"]["kind"] == "")


@pytest.mark.parametrize("name", Switches.__struct_fields__)
def test_a_switch_is_told_to_rooms_and_wall_and_to_whoever_comes_later(
    served: ServedClass, name: str
) -> None:
    with RawLink(served, served.joined()) as link, TeacherSocket(served) as wall:
        assert link.next(ClassSettings) == ClassSettings(Switches())
        assert served.command("switch", name=name, on=True).status_code == 200
        assert getattr(link.next(ClassSettings).switches, name) is True
        wall.next("class", lambda event: event["switches"][name])
    with RawLink(served, served.joined()) as late:
        assert getattr(late.next(ClassSettings).switches, name) is True
        assert served.command("switch", name=name, on=False).status_code == 200
        assert late.next(ClassSettings) == ClassSettings(Switches())


@pytest.mark.parametrize(
    ("do", "body", "problem"),
    [
        ("switch", {"name": "souns", "on": True}, f"expected one of {SWITCHES}, got 'souns'"),
        ("switch", {"name": "__class__", "on": True}, f"expected one of {SWITCHES}"),
        ("switch", {"name": "sound", "on": 7}, "on"),
        ("assign", {"rooms": ["nowhere"], "scene": "maze"}, "no room 'nowhere'"),
        ("assign", {"rooms": "all", "scene": "../x"}, "scene of the library"),
        ("assign", {"rooms": "all", "scene": {"lesson": "99"}}, "expected a number from 00 to 21"),
        ("assign", {"rooms": "all", "scene": {"yaml": "<script>"}}, "scene: "),
        ("assign", {"rooms": "some", "scene": "maze"}, "rooms"),
        ("attention", {"kind": "loud"}, "kind"),
        ("attention", {"kind": "", "message": "x" * 201}, "200"),
        ("attention", {"kind": "pause", "seconds": -1}, "seconds"),
        ("show", {"kind": "room", "room": "nowhere"}, "no room"),
        ("sleep", {"room": "../.."}, "no room"),
        ("rename", {"seat": 1, "name": "<b>"}, "name of the lists"),
        ("kick", {"seat": "x"}, "seat"),
    ],
)
def test_a_command_that_is_wrong_is_a_sentence(
    served: ServedClass, do: str, body: dict[str, Any], problem: str
) -> None:
    answer = served.command(do, **body)
    assert answer.status_code == 400
    assert problem in answer.json()["problem"]
    assert "Traceback" not in answer.text


def test_the_teacher_looks_in_and_a_student_does_not(served: ServedClass) -> None:
    ada, ben = served.joined(), served.joined()
    teacher = served.student()
    teacher.client.get("teacher", params={"token": served.token}, follow_redirects=True)
    assert teacher.client.get(ada.room + "api/snapshot").status_code == 200
    assert teacher.client.get("/r/ffffffffffff/api/snapshot").status_code == 403
    forged = {"x-ai4u-role": "teacher", "x-ai4u-seat": "0"}
    assert ben.client.get(ada.room + "api/snapshot", headers=forged).status_code == 403
    for student, role in ((teacher, "teacher"), (ada, "student")):
        with Page(ada.address + "ws/input", additional_headers=student.cookies | forged) as page:
            assert page.receive("class")["role"] == role
    number = max(each["number"] for each in served.state()["seats"])
    with Page(ben.address + "ws/input", additional_headers=ben.cookies) as page:
        page.receive("hello")
        with TeacherSocket(served) as wall:
            wall.next("class", lambda e: _is_here(e, number))
            served.command("show", kind="room", room=ben.room.split("/")[2])
            seen = wall.next("class", lambda e: e["shown"]["kind"] == "room")
            assert seen["shown"]["room"] == ben.room.split("/")[2]
    with TeacherSocket(served) as wall:
        wall.next("class", lambda e: not _is_here(e, number))


def test_a_room_that_sleeps_is_shown_so(served: ServedClass) -> None:
    ada = served.joined()
    assert ada.get("healthz").status_code == 200
    room = ada.room.split("/")[2]
    with TeacherSocket(served) as wall:
        wall.next("class", lambda e: _room(e, room)["is_running"])
        assert served.command("sleep", room=room).status_code == 200
        wall.next("class", lambda e: _room(e, room)["status"] == "asleep")


def test_a_rooms_link_needs_its_own_secret(served: ServedClass) -> None:
    ada = served.joined()
    ada.get("healthz")
    with RawLink(served, "", hello=LinkHello(VERSION, ada.room.split("/")[2], "room")) as link:
        _, problem = link.end()
        assert problem is not None
        assert problem.code == "secret"


def _is_here(event: dict[str, Any], number: int) -> bool:
    return any(each["is_here"] for each in event["seats"] if each["number"] == number)


def _room(event: dict[str, Any], room: str) -> dict[str, Any]:
    found: dict[str, Any] = next(each for each in event["rooms"] if each["id"] == room)
    return found
