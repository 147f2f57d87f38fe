"""Export of a class, a student's own work, and what is left after "forget": nothing."""

import csv
import io
import json
import os
import zipfile
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

import pytest

from ai4u_edu import Scene
from ai4u_edu.blocks.brains import zoo
from ai4u_edu.lessons.progress_file import read_entries
from ai4u_edu.member.assigned_scenes import MEMORY
from ai4u_edu.member.my_work import open_my_work
from ai4u_edu.recording import Episode
from ai4u_edu.recording.episode import decode
from ai4u_edu.wire.class_link import Ack, CurrentRace, Work
from tests.classroom.link_client import RawLink, TeacherSocket, check, state, wait_for_verdicts
from tests.classroom.served_class import CODE, ServedClass, Student, served_class
from tests.classroom.test_race import SEED, driven, result
from tests.waiting import until

pytestmark = pytest.mark.slow
TITLE = "<script>alert(1)</script>"
NETWORK = zoo.network_of("box_chase").read_bytes()


def zip_of(content: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def work(served: ServedClass, ada: Student) -> None:
    """Do something of everything that a class keeps."""
    scene = Scene.load("box_chase").source.replace("title: Box chase", f"title: {TITLE}")
    with RawLink(served, ada) as link, TeacherSocket(served) as wall:
        link.send(state())
        link.send(Work(TITLE, scene))
        link.send(check("wrong", "04.2/narrow"))
        link.next(Ack)
        answer = served.command("race", scene={"room": "seat-1"}, seed=SEED, countdown=0)
        assert answer.status_code == 200, answer.text
        race = link.next(CurrentRace, lambda message: message.id != "")
        link.send(result(race.id, driven(1.0)))
        link.next(Ack)
        wall.next("class", lambda e: e["race"] and e["race"]["board"])
    hand_in(served, ada)
    memory = served.folder / "rooms" / ada.room.split("/")[2] / MEMORY
    assert ada.get("healthz").status_code == 200
    # the room has begun, and opens the race's scene; it would open it over the next one
    until(lambda: memory.is_file() and json.loads(memory.read_text())["race"] == race.id)
    assert ada.client.post(ada.room + "api/scene", json={"name": "maze"}).status_code == 200


def hand_in(served: ServedClass, student: Student) -> None:
    """Hand a network in, and wait until it has played against itself."""
    place = {"scene": "box_chase", "part": "", "file": "secret name.onnx"}
    octets = {"Content-Type": "application/octet-stream"}
    put = student.client.put("api/network", params=place, content=NETWORK, headers=octets)
    assert put.status_code == 200, put.text
    wait_for_verdicts(served, student)
    (told,) = student.client.get("api/network").json()["networks"]
    assert told["verdict"] == "right"


def test_everything_is_in_the_export_and_nothing_after_forget(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    with served_class(folder) as served:
        ada, ben = served.joined(name="Red Fox"), served.joined(name="Blue Otter")
        work(served, ada)
        room = ada.room.split("/")[2]
        file = folder / "rooms" / room / "scene.yaml"
        until(lambda: "title: Maze" in file.read_text())
        os.utime(file, (0, 0))  # as if the clock had been set back

        files = zip_of(served.export())
        page = files["results.html"].decode()
        assert "Red Fox" in page
        assert "<script" not in page
        assert "&lt;script&gt;" in page
        rows = list(csv.DictReader(io.StringIO(files["progress.csv"].decode())))
        assert (rows[0]["name"], rows[0]["exercise"], rows[0]["checks"]) == ("Red Fox", "04.2", "1")
        assert TITLE in files["rooms/Red Fox seat-1/scene.yaml"].decode()
        assert "title: Maze" in files[f"rooms/Red Fox {room}/scene.yaml"].decode()
        (name,) = [each for each in files if each.endswith(".episode")]
        assert ".." not in name
        assert decode(Episode, files[name], name).seed == SEED
        assert files["networks/Red Fox 1/box_chase.onnx"] == NETWORK

        def own_work() -> dict[str, bytes]:
            return zip_of(ada.client.get("api/my-work").content)

        until(lambda: "title: Maze" in own_work()["scene.yaml"].decode())  # changed last
        own = own_work()
        assert own["networks/box_chase.onnx"] == NETWORK
        assert read_entries(own["progress.json"].decode())["04.2"].tries == 1
        other = ben.client.get("api/my-work")
        (tmp_path / "my-work.zip").write_bytes(other.content)
        unpacked = open_my_work(tmp_path / "my-work.zip")
        assert "title: Box chase" in unpacked.scene.read_text()
        assert zip_of(other.content).keys() == {"scene.yaml", "progress.json", "missions.json"}
        assert served.student().client.get("api/my-work").status_code == 403

        secrets = [*ada.client.cookies.values(), *ben.client.cookies.values()]
        with RawLink(served, ada) as link:
            assert served.command("forget").status_code == 200
            code, problem = link.end()
            assert (code, problem and problem.code) == (1008, "over")
        assert ada.client.get("api/my-work").status_code == 403
        assert ada.get("api/snapshot").status_code == 403
        told = served.state()
        assert (told["seats"], told["rooms"], told["progress"], told["race"]) == ([], [], {}, None)
        assert told["code"] != CODE
        words = [
            *secrets,
            "Red Fox",
            "Blue Otter",
            "127.0.0.1",
            room,
            "narrow",
            TITLE,
            CODE,
            "secret name",
        ]
        assert found_in(folder, words) == []
        assert [each.name for each in folder.iterdir() if each.is_dir()] == []

        late = served.joined(code=told["code"], name="Red Fox")
        assert late.get("healthz").status_code == 200
    with served_class(folder) as served:
        assert len(served.state()["seats"]) == 1  # it goes on where it was, with the same secret


def test_pages_that_come_back_meanwhile_bring_nothing_back(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    with served_class(folder) as served, ThreadPoolExecutor(4) as pool:
        students = [served.joined() for _ in range(4)]
        for each in students:
            assert each.get("healthz").status_code == 200

        def come_back(student: Student) -> None:
            while student.get("healthz").status_code != 403:
                pass

        coming = [pool.submit(come_back, each) for each in students]
        answer = served.command("forget")
        assert answer.status_code == 200, answer.text
        for answered in coming:
            answered.result()
        assert [each.name for each in folder.iterdir() if each.is_dir()] == []


def found_in(folder: Path, words: list[str]) -> list[str]:
    """Return where a word is in the name or content of a file."""
    found = []
    for path in folder.rglob("*"):
        with suppress(FileNotFoundError):  # a room's new file has its last name now
            content = path.read_bytes() if path.is_file() else b""
            found += [
                f"{word} in {path}"
                for word in words
                if word in path.name or word.encode() in content
            ]
    return found
