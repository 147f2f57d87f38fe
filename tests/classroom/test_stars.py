"""Stars that a class keeps: told by students' pages, shown to the teacher, exported, forgotten."""

import csv
import io
import os
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.programs import Stars
from ai4u_edu.classroom.store import RoomRow, SeatRow, TokenRow
from ai4u_edu.classroom.work_routes import MAX_REQUESTS_AT_ONCE
from tests.classroom.served_class import Student, served_class
from tests.classroom.test_export import zip_of
from tests.classroom.test_programs import NONE_FORGOTTEN


@pytest.fixture
def store(tmp_path: Path) -> Iterator[ClassStore]:
    with ClassStore(tmp_path) as store:
        seat = SeatRow(1, "Fox 1", "#ffffff", "a", "in")
        store.add_seat(seat, TokenRow(b"1", 1, "request 1"), RoomRow("a", "maze"))
        yield store


def test_stars_never_become_fewer(store: ClassStore) -> None:
    stars = Stars(store)
    for count in (2, 1):
        stars.save(1, "maze", count)
        stars.note(1, "maze", count)
    assert stars.by_seat() == Stars(store).by_seat() == {"1": {"maze": 2}}
    assert stars.of_seat(2) == {}
    assert stars.by_seat() == {"1": {"maze": 2}}


@pytest.mark.parametrize(("scene", "count"), [("nowhere", 1), ("forage", 3), ("maze", 0)])
def test_only_stars_that_there_are_are_kept(store: ClassStore, scene: str, count: int) -> None:
    with pytest.raises(ValueError, match="expected 1 to"):
        Stars(store).save(1, scene, count)
    assert Stars(store).by_seat() == {}


def put(student: Student, **body: Any) -> httpx.Response:
    return student.client.put("api/stars", json={"scene": "maze", "stars": 2} | body)


@pytest.mark.slow
def test_the_teacher_sees_them_and_they_outlast_a_crash(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    with served_class(folder) as served:
        ada, ben = served.joined(name="Red Fox"), served.joined(name="Blue Otter")
        cookies = dict(ada.client.cookies)
        assert put(ada).json() == {"stars": {"maze": 2}}
        assert put(ada, scene="box_chase", stars=3).status_code == 200
        assert ben.client.get("api/stars").json() == {"stars": {}}
        assert served.student().client.get("api/stars").status_code == 403
        expected = {"1": {"maze": 2, "box_chase": 3}}
        assert served.state()["stars"] == expected
        os.kill(served.process.pid, signal.SIGKILL)
    with served_class(folder, replaced=NONE_FORGOTTEN) as served:
        ada = served.student()
        ada.client.cookies.update(cookies)
        assert ada.client.get("api/stars").json() == {"stars": expected["1"]}
        assert served.state()["stars"] == expected
        bad_input_is_refused(ada)
        files = zip_of(served.export())
        rows = list(csv.DictReader(io.StringIO(files["stars.csv"].decode())))
        assert rows[1] == {"name": "Red Fox", "scene": "maze", "stars": "2"}
        assert "<td>box_chase</td><td>3</td>" in files["results.html"].decode()
        assert served.command("forget").status_code == 200
        assert served.state()["stars"] == {}


def bad_input_is_refused(student: Student) -> None:
    bad: list[dict[str, Any]] = [{"stars": 4}, {"stars": "2"}, {"scene": ""}, {"more": 1}]
    for body in [*bad, {"scene": "<script>"}, {"scene": "forage", "stars": 3}]:
        answer = put(student, **body)
        assert answer.status_code == 422, answer.text
        assert answer.json()["problem"]
    codes = [put(student).status_code for _ in range(MAX_REQUESTS_AT_ONCE)]
    taken = codes.index(429)
    assert taken > 0
    assert codes == [200] * taken + [429] * (MAX_REQUESTS_AT_ONCE - taken)
