"""Programs that the class keeps: in its file, over HTTP, in ZIP files, and after "forget"."""

import io
import os
import signal
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.errors import NewerProgramError, ProgramNotKeptError
from ai4u_edu.classroom.programs import MAX_PROGRAM_CHARS, MAX_PROGRAMS, Programs
from ai4u_edu.classroom.seat_rate import MAX_REQUESTS_AT_ONCE
from ai4u_edu.room.my_work import open_my_work
from ai4u_edu.wire.class_link import MAX_STARTING_PROGRAM_CHARS, Assignment
from tests.classroom.link_client import RawLink, state
from tests.classroom.served_class import ServedClass, Student, served_class
from tests.classroom.test_export import found_in, zip_of
from tests.classroom.two_seats import two_seats
from tests.server import http_client

MARKUP = "# <img src=x onerror=alert(1)>\n"
NONE_FORGOTTEN = {"ai4u_edu.classroom.seat_rate.REQUESTS_PER_S": 0.0}
"""A class whose limit of requests does not depend on their speed."""
RUNS = "open('ran.txt', 'w').write('it ran')\nraise SystemExit\n"
"""A program that would leave a trace if the server ran it."""


@pytest.fixture
def store(tmp_path: Path) -> Iterator[ClassStore]:
    with two_seats(tmp_path) as store:
        yield store


def test_the_program_that_was_changed_last_is_kept(store: ClassStore) -> None:
    now = 1000.0
    programs = Programs(store, lambda: now)
    programs.save(1, "Maze", "robot", "first", 5.0)
    programs.save(1, "Maze", "robot", "second", 0.0)
    now += 10
    with pytest.raises(NewerProgramError, match="newer"):
        programs.save(1, "Maze", "robot", "of a device without network", 11.0)
    found = Programs(store, lambda: now).find(1, "Maze", "robot")
    assert found is not None
    assert (found.source, programs.age_of(found)) == ("second", 10.0)
    assert programs.find(1, "Maze", "other") is None
    assert programs.find(2, "Maze", "robot") is None
    programs.save(1, "Tag", "robot", "of another scene", 9.0)
    latest = programs.latest_of(1)
    assert latest is not None
    assert latest.source == "of another scene"
    assert [each.scene for each in programs.of_seat(1)] == ["Tag", "Maze"]


def test_a_seat_has_a_limit_of_programs_and_loses_none(store: ClassStore) -> None:
    programs = Programs(store)
    for number in range(MAX_PROGRAMS):
        programs.save(1, f"Scene {number}", "robot", "pass", 0.0)
    with pytest.raises(ProgramNotKeptError, match="at most 50"):
        programs.save(1, "One more", "robot", "pass", 0.0)
    programs.save(1, "Scene 3", "robot", "changed", 0.0)
    programs.save(2, "One more", "robot", "pass", 0.0)
    assert len(programs.of_seat(1)) == MAX_PROGRAMS


def put(student: Student, **changes: Any) -> httpx.Response:
    body = {"scene": "Maze", "agent": "robot", "source": "pass", "age": 0} | changes
    return student.client.put("api/program", json=body)


def found(student: Student, scene: str = "Maze", agent: str = "robot") -> Any:
    answer = student.client.get("api/program", params={"scene": scene, "agent": agent})
    assert answer.status_code == 200, answer.text
    return answer.json()


def of_room(served: ServedClass, room: str, token: str) -> httpx.Response:
    auth = {"Authorization": f"Bearer {token}"}
    return http_client.get(f"{served.url}teacher/programs", params={"room": room}, headers=auth)


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class"), replaced=NONE_FORGOTTEN) as served:
        yield served


@pytest.mark.slow
def test_only_the_own_browser_and_the_teacher_read_a_program(served: ServedClass) -> None:
    ada, ben = served.joined(name="Red Fox"), served.joined(name="Blue Otter")
    source = f"{MARKUP}{RUNS}# \u00e9\u0000\U0001f600"
    assert put(ada, source=source, age=100).status_code == 200
    answer = found(ada)
    assert (answer["source"], answer["scene"], answer["agent"]) == (source, "Maze", "robot")
    assert 100 <= answer["age"] < 1000  # it has the seconds since then, too
    assert found(ben) == {"source": None}
    stranger = served.student()
    assert put(stranger).status_code == 403
    assert stranger.client.get("api/program?scene=Maze&agent=robot").status_code == 403

    room = ada.room.split("/")[2]
    answer = of_room(served, room, served.token).json()["programs"]
    assert [(each["name"], each["source"]) for each in answer] == [("Red Fox", source)]
    assert of_room(served, room, "wrong").status_code == 401
    assert ada.client.get(f"teacher/programs?room={room}").status_code == 401
    assert of_room(served, "none", served.token).status_code == 404
    (other,) = of_room(served, ben.room.split("/")[2], served.token).json()["programs"]
    assert (other["name"], other["source"]) == ("Blue Otter", None)
    assert other["seat"] != answer[0]["seat"]
    evil = ada.client.put(
        "api/program",
        json={"scene": "Maze", "agent": "robot", "source": "evil", "age": 0},
        headers={"Origin": "http://evil.example"},
    )
    assert evil.status_code == 403
    assert found(ada)["source"] == source


@pytest.mark.slow
def test_bad_input_gets_a_sentence_and_many_requests_are_refused(served: ServedClass) -> None:
    eve = served.joined(name="Calm Owl")
    answer = put(eve, source="x" * (MAX_PROGRAM_CHARS + 1))
    assert (answer.status_code, "100000 characters" in answer.json()["problem"]) == (422, True)
    assert "body of at most" in put(eve, source="x" * 10**6).json()["problem"]
    bad: list[dict[str, Any]] = [{"age": -1}, {"age": "nan"}, {"scene": ""}, {"agent": "x" * 101}]
    for changes in [*bad, {"source": None}, {"more": 1}]:
        answer = put(eve, **changes)
        assert answer.status_code == 422, changes
        assert answer.json()["problem"].startswith(next(iter(changes)))
    text = '{"scene": "Maze", "agent": "robot", "source": "\\ud800", "age": 0}'
    json = {"Content-Type": "application/json"}
    answer = eve.client.put("api/program", content=text, headers=json)
    assert answer.status_code == 422, answer.text
    assert eve.client.put("api/program", content=text).status_code == 415
    assert put(eve, age=0).status_code == 200
    assert put(eve, age=50).status_code == 409
    codes = [put(eve).status_code for _ in range(MAX_REQUESTS_AT_ONCE)]
    taken = codes.index(429)
    assert taken > 0
    assert codes == [200] * taken + [429] * (MAX_REQUESTS_AT_ONCE - taken)
    assert put(served.joined()).status_code == 200


@pytest.mark.slow
def test_programs_outlast_a_crash_are_in_the_zip_files_and_forgotten(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    secret = "# the secret of Ada's program\n"
    with served_class(folder) as served:
        ada = served.joined(name="Red Fox")
        cookies = dict(ada.client.cookies)
        assert put(ada, source=secret + RUNS).status_code == 200
        os.kill(served.process.pid, signal.SIGKILL)
    with served_class(folder) as served:
        ada = served.student()
        ada.client.cookies.update(cookies)
        assert found(ada)["source"] == secret + RUNS
        for agent in ("../../evil", "....evil", "con"):
            assert put(ada, scene="a/b", agent=agent, source=MARKUP).status_code == 200

        own = ada.client.get("api/my-work").content
        names = {"Maze-robot", "ab-evil", "ab-evil-2", "ab-con"}
        programs = {name for name in zip_of(own) if name.endswith(".py")}
        assert programs == {f"programs/{name}.py" for name in names}
        (tmp_path / "my-work.zip").write_bytes(own)
        work = open_my_work(tmp_path / "my-work.zip")
        assert {each.stem for each in (work.folder / "programs").iterdir()} == names
        assert (work.folder / "programs/Maze-robot.py").read_text() == secret + RUNS
        exported = zip_of(served.export())
        assert exported["programs/Red Fox 1/Maze-robot.py"].decode() == secret + RUNS

        assert found_in(folder, ["the secret of"]) != []
        assert served.command("forget").status_code == 200
        assert found_in(folder, ["the secret of", "onerror", "ran.txt"]) == []
        code = served.state()["code"]
        late = served.joined(code=code, name="Red Fox")
        assert found(late) == {"source": None}
    assert not Path("ran.txt").exists()


@pytest.mark.slow
def test_a_starting_program_comes_with_an_assignment(served: ServedClass) -> None:
    gus = served.joined(name="Swift Crab")
    source = f"{MARKUP}{RUNS}"
    with RawLink(served, gus) as link:
        link.send(state())
        answer = served.command("assign", rooms="all", scene="maze", program=source)
        assert answer.status_code == 200, answer.text
        found = link.next(Assignment, lambda message: message.id != "")
        assert (found.scene, found.program) == ("maze", source)
        too_long = "x" * (MAX_STARTING_PROGRAM_CHARS + 1)
        answer = served.command("assign", rooms="all", scene="maze", program=too_long)
        assert (answer.status_code, "20000 characters" in answer.text) == (400, True)
        assert served.command("assign", rooms="all", scene="tag").status_code == 200
        assert link.next(Assignment, lambda message: message.scene == "tag").program == ""
    assert not Path("ran.txt").exists()


def test_strange_programs_in_my_work_are_ignored_or_refused(tmp_path: Path) -> None:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        archive.writestr("scene.yaml", "title: Mine\nbodies: []\n")
        for name in ("good.py", "../evil.py", "con.py", ".hidden.py", "x.pyc", "deep/x.py"):
            archive.writestr(f"programs/{name}", "pass")
    (tmp_path / "mine.zip").write_bytes(data.getvalue())
    work = open_my_work(tmp_path / "mine.zip")
    assert [each.name for each in (work.folder / "programs").rglob("*")] == ["good.py"]
