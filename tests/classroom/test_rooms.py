"""Rooms behind a class: who may enter, what goes through, and what is there after a bad day."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path

import httpx
import psutil
import pytest
from websockets.exceptions import ConnectionClosed

from ai4u_edu.page.server.proxy import MAX_UPWARD_BYTES
from ai4u_edu.remote import RemoteError, connect
from tests.classroom.served_class import CODE, ServedClass, served_class
from tests.classroom.student_page import open_picture, python_lines, script_address
from tests.page.server import http_client
from tests.page.server.rooms import Page, open_socket
from tests.processes import is_server, ports_of
from tests.waiting import LIMIT_S, Deadline, until

pytestmark = pytest.mark.slow


IMPORTS_OF_A_ROOM = """
import importlib, sys
from pathlib import Path
from ai4u_edu.classroom.local_rooms import PRELOAD
for name in PRELOAD:
    importlib.import_module(name)
shared = set(sys.modules)
from ai4u_edu.room import Room, RoomSettings
folder = Path(sys.argv[1])
settings = RoomSettings(scene="box_chase", learns_in_class=True, class_folder=folder, work=folder)
with Room(settings):
    print([each for each in sorted(sys.modules.keys() - shared) if each.startswith("ai4u_edu")])
"""


connect_script = partial(connect, patience=LIMIT_S)


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served


def test_a_room_answers_its_student_and_the_driver_moves_there(served: ServedClass) -> None:
    ada, ben = served.joined(), served.joined()
    assert ada.room != ben.room
    assert ada.get("healthz").json()["status"] == "ok"
    with Page(ada.address + "ws/input", additional_headers=ada.cookies) as page:
        page.receive("hello")
        with page.holding("KeyW"):
            until(lambda: ada.get("api/snapshot").json()["tick"] > 10)
    assert ben.get("api/snapshot").json()["tick"] == 0


def test_rooms_import_nothing_of_ours_that_they_could_share(tmp_path: Path) -> None:
    command = [sys.executable, "-c", IMPORTS_OF_A_ROOM, str(tmp_path)]
    told = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT_S, check=True)
    assert told.stdout == "[]\n"


def test_nobody_enters_the_room_of_another(served: ServedClass) -> None:
    ada, ben, stranger = served.joined(), served.joined(), served.student()
    assert ada.get("api/snapshot").status_code == 200
    for other in (ben, stranger):
        for path in (
            "api/snapshot",
            "web/page/main.js",
            "../../" + ada.room.strip("/") + "/api/scene",
        ):
            assert other.client.get(ada.room + path).status_code == 403
        to_page = other.client.get(ada.room, headers={"Accept": "text/html"})
        assert (to_page.status_code, to_page.headers["Location"]) == (303, "/")
        for path in ("", "ws/input", "ws/panel"):
            with open_socket(ada.address + path, additional_headers=other.cookies) as socket:
                with pytest.raises(ConnectionClosed) as closed:
                    socket.recv(LIMIT_S)
                assert closed.value.rcvd is not None
                assert closed.value.rcvd.code == 1008


def test_the_room_can_not_be_entered_beside_the_class(served: ServedClass) -> None:
    ada = served.joined()
    ada.get("healthz")
    room = ada.room.split("/")[2]
    children = psutil.Process(served.process.pid).children(recursive=True)
    ports = {port for process in children for port in ports_of(process)}
    assert ports
    for port in ports:
        try:
            answer = http_client.get(f"http://127.0.0.1:{port}/r/{room}/api/snapshot")
        except httpx.HTTPError:
            continue
        assert answer.status_code != 200


@pytest.mark.parametrize(
    ("frame", "code"), [(b"\xc1", 1003), ("text", 1003), (b"\x00" * 2 * MAX_UPWARD_BYTES, 1009)]
)
def test_malformed_picture_frames_close_the_socket(
    served: ServedClass, frame: bytes | str, code: int
) -> None:
    ada = served.joined()
    with open_picture(ada) as picture:
        picture.recv(LIMIT_S)
        picture.send(frame)
        deadline = Deadline()
        with suppress(ConnectionClosed):
            while True:
                picture.recv(deadline.left())
        assert picture.close_code == code


def test_no_secret_reaches_a_browser(served: ServedClass) -> None:
    ada = served.joined()
    answer = ada.client.get(ada.room)
    assert answer.status_code == 200
    assert "ai4u_edu_seat" not in answer.text
    assert "authorization" not in answer.headers
    (cookie,) = [each for each in ada.client.cookies.jar if each.value == ada.token]
    assert cookie.has_nonstandard_attr("HttpOnly")


def test_a_script_drives_with_the_address_that_the_page_shows(served: ServedClass) -> None:
    ada, ben = served.joined(), served.joined()
    address = script_address(ada)
    assert address.startswith(ada.address)
    with connect_script(address) as robot:
        for _ in range(5):
            robot.sense()
            robot.act(move=[1.0, 0.0, 0.0, 0.0])
    key = address.partition("?token=")[2]
    assert key not in python_lines(ben)
    for wrong in (f"{ben.address}?token={key}", ada.address, f"{ada.address}?token=wrong"):
        with pytest.raises(RemoteError, match="answer 403 expected the key"):
            connect_script(wrong)
    for other in (ben, ada):  # no key for the pages of others, and none for anything else
        assert other.client.get(f"{ada.room}?token={key}").status_code != 401
    headers = {"Authorization": f"Bearer {key}"}
    stranger = http_client.get(f"{ada.address}api/snapshot", headers=headers)
    assert stranger.status_code == 403


@pytest.mark.parametrize("rooms", ["each", pytest.param("one", marks=pytest.mark.nightly)])
def test_lockstep_is_allowed_in_rooms_of_one_student_only(tmp_path: Path, rooms: str) -> None:
    with served_class(tmp_path, "sumo", "--rooms", rooms) as school:
        address = script_address(school.joined())
        if rooms == "each":
            with connect_script(address, agent="blue", mode="lockstep") as robot:
                assert robot.reset(seed=5).episode
            return
        with pytest.raises(RemoteError, match="expected mode='realtime'"):
            connect_script(address, agent="blue", mode="lockstep")


def test_the_teachers_page_needs_its_secret(served: ServedClass) -> None:
    for path in ("teacher", "teacher/state"):
        assert http_client.get(served.url + path).status_code == 401
        assert http_client.get(f"{served.url}{path}?token=wrong-wrong").status_code == 401
    command = f"{served.url}teacher/command"
    assert http_client.post(command, json={"do": "close"}).status_code == 401
    assert served.state()["open"]


def test_other_sites_can_not_join_or_command(served: ServedClass) -> None:
    evil = {"Origin": "http://evil.example"}
    for path in ("api/join", "teacher/command", "teacher/state"):
        assert http_client.post(served.url + path, headers=evil, json={}).status_code == 403
    assert http_client.get(served.url, headers={"Host": "evil.example"}).status_code == 403


def test_a_wrong_code_is_said_and_many_do_not_lock_the_class_out(served: ServedClass) -> None:
    student = served.student()
    name = student.client.get("api/names").json()["names"][0]
    statuses = [student.join("XXXXX", name).status_code for _ in range(65)]
    assert statuses[:60] == [403] * 60
    assert student.join(name=name).status_code == 200


def test_kick_closes_the_page_at_once(served: ServedClass) -> None:
    ada = served.joined(request="a" * 20)
    number = max(each["number"] for each in served.state()["seats"])
    with Page(ada.address + "ws/input", additional_headers=ada.cookies) as page:
        page.receive("hello")
        assert served.command("kick", seat=number).status_code == 200
        assert page.end() == (1008, "your teacher has sent you out; ask before you join again")
    assert ada.get("api/snapshot").status_code == 403
    before = ada.room
    assert ada.join(request="a" * 20).status_code == 200
    assert ada.room == before
    assert ada.get("api/snapshot").status_code == 200


def test_a_student_is_told_while_the_teacher_looks_in(served: ServedClass) -> None:
    ada, teacher = served.joined(), served.student()
    teacher.client.get("teacher", params={"token": served.token})  # which sets a cookie
    teacher.room = ada.room
    with Page(ada.address + "ws/input", additional_headers=ada.cookies) as page:
        page.receive("class", has_teacher=False)
        with Page(teacher.address + "ws/input", additional_headers=teacher.cookies) as look:
            look.receive("class", role="teacher")
            page.receive("class", has_teacher=True)
        page.receive("class", has_teacher=False)


def test_counts_of_a_room_survive_a_restart(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    with served_class(folder) as served:
        ada = served.joined()
        counts = folder / "rooms" / ada.room.split("/")[2] / "counts.json"
        with Page(ada.address + "ws/input", additional_headers=ada.cookies) as page:
            page.receive("hello")
            until(counts.exists)
            for episodes in (2, 3):
                page.do("new_start")
                until(lambda: served.state()["rooms"][0]["episodes"] == episodes)  # noqa: B023
            until(lambda: json.loads(counts.read_text())["episodes"] == 3)
        os.kill(served.process.pid, signal.SIGKILL)
    with served_class(folder) as served:
        (room,) = served.state()["rooms"]
        assert (room["status"], room["episodes"], room["scene"]) == ("asleep", 3, "Box chase")


def test_a_command_that_can_not_be_done_is_a_sentence(served: ServedClass) -> None:
    answer = served.command("kick", seat=10**6)
    assert (answer.status_code, answer.json()) == (400, {"problem": "there is no seat 1000000"})
    answer = served.command("explode")
    assert answer.status_code == 400
    assert "explode" in answer.json()["problem"]


def test_a_room_that_is_killed_comes_back_and_the_others_notice_nothing(
    served: ServedClass,
) -> None:
    ben = served.joined()
    assert ben.get("healthz").status_code == 200
    others = set(_room_processes(served))
    ada = served.joined()
    assert ada.get("healthz").status_code == 200
    (hers,) = set(_room_processes(served)) - others
    with Page(ben.address + "ws/input", additional_headers=ben.cookies) as page:
        page.receive("hello")
        hers.kill()
        until(lambda: ada.get("healthz").status_code == 200)
        with page.holding("KeyW"):
            until(lambda: ben.get("api/snapshot").json()["tick"] > 10)


def test_scene_survives_a_kill_of_the_class(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        ada = served.joined()
        assert ada.client.post(ada.room + "api/scene", json={"name": "maze"}).status_code == 200
        file = tmp_path / "rooms" / ada.room.split("/")[2] / "scene.yaml"
        until(lambda: file.exists() and "title: Maze" in file.read_text())
        rooms = _room_processes(served)
        token = dict(ada.client.cookies)
        os.kill(served.process.pid, signal.SIGKILL)
        _, alive = psutil.wait_procs(rooms, timeout=LIMIT_S)
        assert alive == []
    with served_class(tmp_path) as served:
        again = served.student()
        again.client.cookies.update(token)
        again.room = ada.room
        assert again.get("api/scene").json()["title"] == "Maze"
        assert served.state()["code"] == CODE


def test_rooms_know_the_teachers_blocks(tmp_path: Path) -> None:
    blocks, scene = tmp_path / "own.py", tmp_path / "own.yaml"
    blocks.write_text(
        "from ai4u_edu import Sensor\n"
        "from gymnasium.spaces import Box\n\n\n"
        "class Luck(Sensor):\n"
        '    """A number."""\n\n'
        "    def space(self):\n        return Box(0, 1, (1,))\n\n"
        "    def read(self, body, view):\n        return 0.5\n"
    )
    scene.write_text(
        "name: own\nbodies: [{name: robot, shape: {type: circle}}]\n"
        "agents: [{body: robot, sensors: [{type: Luck, perception_key: luck}],\n"
        "  actuators: [{type: RBMoveActuator}],\n"
        "  brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]}]\n"
    )
    with served_class(tmp_path / "class", "--blocks", str(blocks), str(scene)) as served:
        agent = served.joined().get("api/snapshot").json()["agents"][0]
        assert agent["percept"]["luck"] == [0.5]


def _room_processes(served: ServedClass) -> list[psutil.Process]:
    """Return the processes that serve a port, without the class itself."""
    children = psutil.Process(served.process.pid).children(recursive=True)
    return [each for each in children if is_server(each)]
