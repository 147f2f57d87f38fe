"""Missions in a class: progress that it keeps, who is stuck, and the teacher's own missions."""

import csv
import io
import json
import os
import signal
import sqlite3
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from ai4u_edu import Scene
from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.assignments import AssignedScene, Assignments
from ai4u_edu.classroom.missions import ClassMissions, MissionPlace, Reached
from ai4u_edu.classroom.programs import Stars
from ai4u_edu.classroom.store import FILE
from ai4u_edu.missions.mission import library_missions
from tests.classroom.link_client import TeacherSocket
from tests.classroom.served_class import Student, served_class
from tests.classroom.test_export import zip_of
from tests.classroom.test_programs import NONE_FORGOTTEN
from tests.classroom.two_seats import two_seats
from tests.missions.test_run import TEXT
from tests.page.server.rooms import open_socket
from tests.waiting import until

FELL = "It fell off the edge. Press *Try again*, and let go of the key earlier."
"""Hint of the first step of "First drive"."""
NOWHERE = MissionPlace("")


class Clock:
    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def store(tmp_path: Path) -> Iterator[ClassStore]:
    with two_seats(tmp_path) as store:
        yield store


def told(
    missions: ClassMissions,
    reached: dict[str, Reached] | None = None,
    place: MissionPlace | None = None,
    seat: int = 1,
) -> bool:
    return missions.note(seat, *missions.save(seat, reached or {}, place))


def test_progress_never_becomes_less(store: ClassStore) -> None:
    missions = ClassMissions(store)
    assert told(missions, {"drive-1": Reached(3, 0)})
    assert told(missions, {"drive-1": Reached(1, 2)})
    assert not told(missions, {"drive-1": Reached(2, 1)})
    assert missions.of_seat(1) == {"drive-1": Reached(3, 2)}
    assert ClassMissions(store).by_seat() == missions.by_seat() == {"1": {"drive-1": [3, 2]}}
    assert missions.of_seat(2) == {}


def test_no_more_is_kept_than_a_mission_has(store: ClassStore) -> None:
    missions = ClassMissions(store)
    told(missions, {"drive-1": Reached(99, 99), "nowhere": Reached(1, 1), "drive-2": Reached()})
    assert missions.of_seat(1) == {"drive-1": Reached(4, 3)}


def test_a_place_is_kept_until_the_mission_is_closed(store: ClassStore) -> None:
    missions = ClassMissions(store)
    told(missions, place=MissionPlace("drive-1", 99, hint=FELL, hints=2))
    for known in (missions, ClassMissions(store)):
        (place,) = known.places().values()
        assert (place["title"], place["step"], place["steps"]) == ("First drive", 3, 4)
    told(missions, {"drive-1": Reached(1, 0)})
    assert missions.places()
    told(missions, place=NOWHERE)
    assert missions.places() == ClassMissions(store).places() == {}
    told(missions, place=MissionPlace("nowhere"))
    assert missions.places() == {}


def test_a_page_puts_no_words_of_its_own_on_the_wall(store: ClassStore) -> None:
    missions = ClassMissions(store)
    told(missions, place=MissionPlace("drive-1", hint="<b>Buy this</b>", hints=9))
    assert missions.places()["1"]["hint"] == ""
    told(missions, place=MissionPlace("drive-1", hint=FELL))
    assert missions.places()["1"]["hint"].startswith("It fell off the edge. Press Try again")


def test_who_is_stuck_and_why(store: ClassStore) -> None:
    clock = Clock()
    missions = ClassMissions(store, clock=clock)
    told(missions, place=MissionPlace("drive-1"))
    assert missions.stuck(1) == (0, "")
    clock.now += 5 * 60
    assert missions.stuck(1) == (45, "step 1 of “First drive” for 5 minutes")
    told(missions, place=MissionPlace("drive-1", hint=FELL, hints=6))
    score, why = missions.stuck(1)
    assert score == 70
    assert why.startswith("It fell off the edge. Press Try again, ")
    assert why.endswith(" (step 1 of “First drive” for 5 minutes)")
    assert missions.counts([1, 2]) == [{"title": "First drive", "count": 1, "stuck": 1}]
    assert missions.counts([2]) == []
    missions.arrived(1)
    told(missions, place=MissionPlace("drive-1", hints=2))
    assert missions.stuck(1) == (0, "")
    clock.now += 99 * 60
    told(missions, place=MissionPlace("drive-1", is_done=True))
    clock.now += 99 * 60
    assert missions.stuck(1) == (0, "")
    told(missions, place=MissionPlace("drive-1", 1))
    assert missions.stuck(1) == missions.stuck(2) == (0, "")


def test_a_class_of_the_version_before_keeps_its_work(tmp_path: Path) -> None:
    with two_seats(tmp_path) as store:
        Stars(store).save(1, "maze", 2)
        Assignments(store).assign(AssignedScene("Maze", "maze", program="pass"), None, 7)
        before = Assignments(store).of("a")
    with sqlite3.connect(tmp_path / FILE) as database:
        for change in (
            "drop table missions",
            "drop table mission_places",
            "alter table assignments drop column mission",
            "pragma user_version = 12",
        ):
            database.execute(change)
    database.close()
    with ClassStore(tmp_path) as store:
        assert Stars(store).of_seat(1) == {"maze": 2}
        assert Assignments(store).of("a") == before
        told(ClassMissions(store), {"drive-1": Reached(1, 0)})
    with ClassStore(tmp_path) as store:
        assert ClassMissions(store).by_seat() == {"1": {"drive-1": [1, 0]}}


def put(student: Student, **body: Any) -> httpx.Response:
    return student.client.put("api/mission-progress", json=body)


def kept(student: Student) -> Any:
    answer = student.client.get("api/mission-progress")
    assert answer.status_code == 200, answer.text
    return answer.json()["missions"]


@pytest.mark.slow
def test_progress_outlasts_a_crash_and_is_there_on_another_device(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    with served_class(folder) as served:
        ada, ben = served.joined(name="Red Fox"), served.joined(name="Blue Otter")
        cookies = dict(ada.client.cookies)
        reached = {"drive-1": {"steps": 4, "stars": 2}}
        assert put(ada, missions=reached).json() == {"missions": reached}
        assert put(ada, place={"mission": "drive-2", "step": 1}).status_code == 200
        assert kept(ben) == {}
        state = served.state()
        assert state["mission_progress"] == {"1": {"drive-1": [4, 2]}}
        assert state["mission_places"]["1"]["title"] == "Round the ring"
        assert served.student().client.get("api/mission-progress").status_code == 403
        os.kill(served.process.pid, signal.SIGKILL)
    with served_class(folder, replaced=NONE_FORGOTTEN) as served:
        ada = served.student()
        ada.client.cookies.update(cookies)
        assert kept(ada) == reached
        bad_input_is_refused(ada)
        assert kept(ada) == reached
        assert served.state()["mission_places"]["1"]["step"] == 1
        files = zip_of(served.export())
        rows = list(csv.DictReader(io.StringIO(files["missions.csv"].decode())))
        first = {"name": "Red Fox", "mission": "drive-1", "title": "First drive", "steps": "4"}
        assert rows[0] == {**first, "of": "4", "stars": "2"}
        assert "<td>First drive</td><td>4</td>" in files["results.html"].decode()
        own = zip_of(ada.client.get("api/my-work").content)["missions.json"].decode()
        assert json.loads(own) == {"version": 1, "missions": reached}
        assert "Fox" not in own
        assert served.command("forget").status_code == 200
        with sqlite3.connect(folder / FILE) as database:
            assert database.execute("select * from missions").fetchall() == []
        database.close()


@pytest.mark.slow
def test_a_mission_is_assigned_with_its_scene(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        ada, ben = served.joined(), served.joined()
        for student in (ada, ben):
            assert student.get("healthz").status_code == 200
        room = served.state()["rooms"][0]["id"]
        assert served.command("assign", rooms=[room], scene={"mission": "no"}).status_code == 400
        answer = served.command("assign", rooms=[room], scene={"mission": "sense-1"})
        assert answer.status_code == 200, answer.text
        scene = library_missions().get("sense-1").scene
        title = Scene.load(scene).description.title

        def scenes() -> list[str]:
            return [each["scene"] for each in served.state()["rooms"] if each["id"] == room]

        until(lambda: scenes() == [title])


@pytest.mark.slow
def test_the_projector_counts_and_names_nobody(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        ada = served.joined(name="Red Fox")
        with open_socket(ada.address + "ws/input", additional_headers=ada.cookies):
            put(ada, place={"mission": "drive-1", "hint": FELL, "hints": 3})
            with TeacherSocket(served) as wall, TeacherSocket(served, "projector") as projector:
                event = wall.next("class", lambda event: bool(event["mission_places"]))
                (room,) = event["rooms"]
                assert (room["help"], room["why"][:20]) == (40, "It fell off the edge")
                shown = projector.next("class", lambda event: bool(event["mission_counts"]))
        assert shown["mission_counts"] == [{"title": "First drive", "count": 1, "stuck": 1}]
        assert not {"missions", "mission_progress", "mission_places"} & shown.keys()


def bad_input_is_refused(student: Student) -> None:
    bad: list[dict[str, Any]] = [
        {"missions": {"drive-1": {"steps": -1}}},
        {"missions": {"drive-1": {"steps": "2"}}},
        {"missions": {"drive-1": {"more": 2}}},
        {"missions": {"": {"steps": 1}}},
        {"missions": {f"{number}": {} for number in range(301)}},
        {"place": {"mission": "drive-1", "hint": "x" * 401}},
        {"place": {"step": 1}},
        {"more": 1},
    ]
    for body in bad:
        answer = put(student, **body)
        assert answer.status_code == 422, (body, answer.text)
        assert answer.json()["problem"]


@pytest.mark.slow
def test_rooms_have_the_teachers_missions_and_read_them_again(tmp_path: Path) -> None:
    missions = tmp_path / "mine"
    missions.mkdir()
    (missions / "mine.yaml").write_text(TEXT)
    (missions / "bad.yaml").write_text("title: Bad")
    with served_class(tmp_path / "class", "--missions", str(missions)) as served:
        assert any("bad.yaml, line 1" in line for line in served.told)
        ada = served.joined()

        def listed() -> dict[str, str]:
            return {
                each["name"]: each["title"] for each in ada.get("api/missions").json()["missions"]
            }

        assert listed()["mine"] == "Test"
        assert "drive-1" in listed()
        assert put(ada, missions={"mine": {"steps": 2}}).status_code == 200
        assert kept(ada) == {"mine": {"steps": 2, "stars": 0}}
        (missions / "mine.yaml").write_text(TEXT.replace("title: Test", "title: Another"))
        until(lambda: listed()["mine"] == "Another")
