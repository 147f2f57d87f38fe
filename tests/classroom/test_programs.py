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
from ai4u_edu.classroom.work_routes import MAX_REQUESTS_AT_ONCE
from ai4u_edu.member.my_work import open_my_work
from ai4u_edu.wire.class_link import MAX_STARTING_PROGRAM_CHARS, Assignment
from tests.classroom.link_client import RawLink, state
from tests.classroom.served_class import ServedClass, Student, served_class
from tests.classroom.test_export import found_in, zip_of
from tests.classroom.two_seats import two_seats
from tests.page.server import http_client

MARKUP = "# <img src=x onerror=alert(1)>\n"
NONE_FORGOTTEN = {"ai4u_edu.classroom.work_routes.REQUESTS_PER_S": 0.0}
"""A class whose limit of requests does not depend on their speed."""
RUNS = "open('ran.txt', 'w').write('it ran')\nraise SystemExit\n"
"""A program that would leave a trace if the server ran it."""


@pytest.fixture
def store(tmp_path: Path) -> Iterator[ClassStore]:
    with two_seats(tmp_path) as store:
        yield store


def test_the_program_that_was_saved_last_is_kept_whatever_the_clock_says(
    store: ClassStore,
) -> None:
    now = 1e9
    programs = Programs(store, lambda: now)

    def save(source: str, device: str, base: int, scene: str = "Maze") -> int:
        return programs.save(1, scene, "robot", source, base=base, device=device)

    first = save("first", "a", 0)
    now -= 3600  # the clock is set back
    second = save("second", "a", first)
    assert save("second, whose answer was lost", "a", first) > second
    with pytest.raises(NewerProgramError, match="newer"):
        save("of a device that has not seen it", "b", 0)
    known = programs.find(1, "Maze", "robot")
    assert known is not None
    assert known.source == "second, whose answer was lost"
    assert programs.age_of(known) == 0
    save("third", "b", known.version)
    with pytest.raises(NewerProgramError, match="newer"):
        save("of the first device", "a", known.version)
    now -= 3600
    save("of another scene", "a", 0, "Tag")
    now += 10
    programs = Programs(store, lambda: now)
    found = programs.find(1, "Maze", "robot")
    assert found is not None
    assert found.source == "third"
    assert programs.find(1, "Maze", "other") is None
    assert programs.find(2, "Maze", "robot") is None
    latest = programs.latest_of(1)
    assert latest is not None
    assert (latest.source, programs.age_of(latest)) == ("of another scene", 10.0)
    assert [each.scene for each in programs.of_seat(1)] == ["Tag", "Maze"]


def test_a_seat_has_a_limit_of_programs_and_loses_none(store: ClassStore) -> None:
    programs = Programs(store)

    def save(seat: int, scene: str) -> None:
        programs.save(seat, scene, "robot", "pass", base=0, device="a")

    for number in range(MAX_PROGRAMS):
        save(1, f"Scene {number}")
    with pytest.raises(ProgramNotKeptError, match="at most 50"):
        save(1, "One more")
    save(1, "Scene 3")
    save(2, "One more")
    assert len(programs.of_seat(1)) == MAX_PROGRAMS


def test_a_seat_has_several_programs_in_a_scene_but_not_those_that_it_deleted(
    store: ClassStore,
) -> None:
    programs = Programs(store)

    def save(scene: str, agent: str, source: str) -> None:
        programs.save(1, scene, agent, source, base=0, device="a")

    save("Maze", "robot", "first")
    save("Maze", "robot/Wall", "second")
    save("Tag", "robot", "of another scene")
    save("Maze", "robot/Box", "third")
    save("Maze", "robot/Box", "")
    assert programs.agents_of(1, "Maze") == ["robot/Wall", "robot"]
    assert programs.agents_of(2, "Maze") == []
    latest, (of_all,) = programs.latest_of(1), programs.latest_of_all()
    assert latest is not None
    assert latest.source == of_all.source == "of another scene"


def put(student: Student, **changes: Any) -> httpx.Response:
    body: dict[str, Any] = {"scene": "Maze", "agent": "robot", "source": "pass"}
    body |= {"base": 0, "device": "a"} | changes
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
    saved = put(ada, source=source)
    assert saved.status_code == 200
    answer = found(ada)
    assert (answer["source"], answer["scene"], answer["agent"]) == (source, "Maze", "robot")
    assert (answer["version"], answer["is_of_device"]) == (saved.json()["version"], False)
    assert found(ben) == {"source": None}
    assert put(ada, agent="robot/Wall").status_code == 200
    assert found(ada, agent="") == {"agents": ["robot/Wall", "robot"]}
    assert put(ada, agent="robot/Wall", source="").status_code == 200
    assert found(ada, agent="") == {"agents": ["robot"]}
    assert found(ben, agent="") == {"agents": []}
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
        json={"scene": "Maze", "agent": "robot", "source": "evil", "base": 9, "device": "a"},
        headers={"Origin": "http://evil.example"},
    )
    assert evil.status_code == 403
    assert found(ada)["source"] == source


@pytest.mark.slow
def test_bad_input_gets_a_sentence_and_many_requests_are_refused(served: ServedClass) -> None:
    eve = served.joined()
    answer = put(eve, source="x" * (MAX_PROGRAM_CHARS + 1))
    assert (answer.status_code, "100000 characters" in answer.json()["problem"]) == (422, True)
    assert "body of at most" in put(eve, source="x" * 10**6).json()["problem"]
    bad: list[dict[str, Any]] = [{"base": -1}, {"base": 0.5}, {"base": 2**60}, {"scene": ""}]
    bad += [{"agent": "x" * 101}, {"device": ""}, {"device": "x" * 65}]
    for changes in [*bad, {"source": None}, {"more": 1}]:
        answer = put(eve, **changes)
        assert answer.status_code == 422, changes
        assert answer.json()["problem"].startswith(next(iter(changes)))
    text = '{"scene": "Maze", "agent": "robot", "source": "\\ud800", "base": 0, "device": "a"}'
    json = {"Content-Type": "application/json"}
    answer = eve.client.put("api/program", content=text, headers=json)
    assert answer.status_code == 422, answer.text
    assert eve.client.put("api/program", content=text).status_code == 415
    assert put(eve).status_code == 200
    assert put(eve, device="b").status_code == 409
    codes = [put(eve).status_code for _ in range(MAX_REQUESTS_AT_ONCE)]
    taken = codes.index(429)
    assert taken > 0
    assert codes == [200] * taken + [429] * (MAX_REQUESTS_AT_ONCE - taken)
    assert put(served.joined()).status_code == 200


def report(student: Student, **run: Any) -> httpx.Response:
    return student.client.put("api/program/run", json=run)


@pytest.mark.slow
def test_a_mistake_in_a_program_is_on_the_wall_first_and_outlasts_a_crash(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    with served_class(folder, replaced=NONE_FORGOTTEN) as served:
        ada, ben = served.joined(name="Red Fox"), served.joined(name="Blue Otter")
        assert put(ada, source="x = speed").status_code == 200
        mistake = {"kind": "unknown-name", "text": "nothing is called 'speed'", "line": 1}
        assert report(ada, state="running").status_code == 200
        assert report(ada, state="mistake", **mistake).status_code == 200
        assert report(ada, state="mistake", **mistake).status_code == 200
        assert report(served.student(), state="running").status_code == 403
        bad: list[dict[str, Any]] = [{"kind": "fun"}, {"line": -1}, {"text": "x" * 701}, {"a": 1}]
        for changes in bad:
            assert report(ben, state="mistake", **changes).status_code == 422, changes
        assert report(ben, state="walks").status_code == 422
        os.kill(served.process.pid, signal.SIGKILL)
    with served_class(folder, replaced=NONE_FORGOTTEN) as served:
        told = served.state()
        first = told["rooms"][0]
        assert (first["seats"], first["help"]) == ([1], 92)
        assert first["why"] == "program stopped: line 1: nothing is called 'speed'"
        (row,) = told["program_mistakes"]
        assert (row["kind"], row["count"], row["seats"]) == ("unknown-name", 2, [1])
        programs = of_room(served, "", served.token).json()["programs"]
        assert [(each["name"], each["source"]) for each in programs] == [("Red Fox", "x = speed")]
        page = zip_of(served.export())["results.html"].decode()
        assert "A name that has no value" in page
        back = served.student()
        back.client.cookies.update(dict(ada.client.cookies))
        assert report(back, state="running").status_code == 200
        told = served.state()
        assert [each["why"] for each in told["rooms"]] == [""] * len(told["rooms"])
        assert told["runs"]["1"]["state"] == "running"


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
    gus = served.joined()
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
