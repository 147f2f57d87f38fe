"""Networks that learn in a class's process: the line, and what is there after each bad end."""

import asyncio
import os
import re
import signal
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import psutil
import pytest

from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.trainings import FULL, MISSING, TOO_LONG, Trainings
from ai4u_edu.teach.drives import FOLDER as DRIVES
from ai4u_edu.teach.drives import DriveFolder
from ai4u_edu.teach.learning import DIED, LEARNED, STOPPED
from ai4u_edu.wire.class_link import Ack, Learn, LinkProblem, StopTraining
from tests.classroom.link_client import RawLink
from tests.classroom.served_class import ServedClass, Student, served_class
from tests.classroom.test_export import zip_of
from tests.page.panel.rooms import PanelPage
from tests.processes import children_that_run
from tests.teach.driving import SEEDS, drive
from tests.waiting import LIMIT_S, until, until_async

DRIVEN = [drive(seed) for seed in SEEDS[:5]]
KEY = "training-1"


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served


def folder_of(served: ServedClass, student: Student) -> Path:
    return served.folder / "rooms" / student.room.split("/")[2]


def driver(served: ServedClass) -> Student:
    """Return a student who has driven to the box a few times."""
    student = served.joined()
    drives = DriveFolder(folder_of(served, student) / DRIVES)
    for episode in DRIVEN:
        drives.add(episode)
    return student


def page_of(student: Student) -> PanelPage:
    page = PanelPage(student.address + "ws/panel", additional_headers=student.cookies)
    page.part("teach", lambda part: part["drives"])
    return page


def learn(page: PanelPage) -> None:
    page.done("teach_learn", drives=[each["number"] for each in page.parts["teach"]["drives"]])


def process_of(served: ServedClass, module: str) -> psutil.Process:
    """Return the process of the class that runs a module of the tab Teach, once it is there."""
    processes: list[psutil.Process] = []

    def is_there() -> bool:
        parent = psutil.Process(served.process.pid)
        processes[:] = children_that_run(f"ai4u_edu.teach.{module}", parent)
        return bool(processes)

    until(is_there)
    return processes[0]


def learner(served: ServedClass) -> psutil.Process:
    """Return the process that learns, which is halted, so that it does not end by itself."""
    process = process_of(served, "clone_process")
    process.suspend()
    return process


def has_learned(page: PanelPage) -> None:
    """Wait until a network has learned and drives."""
    page.part("teach", lambda part: part["networks"] and part["networks"][0]["is_driving"])
    part = page.part("teach", lambda part: part["learning"] and part["learning"]["is_over"])
    assert part["learning"]["problem"] == ""
    assert part["learning"]["alike"] > 0.0


@pytest.mark.slow
def test_networks_learn_in_the_order_in_which_students_asked(served: ServedClass) -> None:
    ada, ben = driver(served), driver(served)
    with page_of(ada) as hers, page_of(ben) as his:
        learn(hers)
        process = learner(served)
        learn(his)
        his.part(
            "teach",
            lambda p: p["learning"] and p["learning"]["waiting"] == "Your place in the line: 2.",
        )
        assert "learns already" in his.failed("teach_learn", drives=[1])["text"]
        process.resume()
        for page in (hers, his):
            has_learned(page)
        room = folder_of(served, ben).name
        (card,) = [each for each in served.state()["rooms"] if each["id"] == room]
        assert re.fullmatch("learned: [0-9]+% alike", card["learning"])
        assert any(
            name.endswith(f"{room}/networks/box_chase-1.onnx") for name in zip_of(served.export())
        )
        own = zip_of(ben.client.get("api/my-work").content)
        (network,) = his.parts["teach"]["networks"]
        assert network["how"].startswith("learned from 5 drives with ")
        (kept,) = (folder_of(served, ben) / "networks").glob("*.onnx")
        assert own["networks/box_chase-1.onnx"] == kept.read_bytes()
        until(lambda: not [*(folder_of(served, ben) / "learned").iterdir()])


@pytest.mark.slow
def test_a_student_can_stop_waiting_and_learning(served: ServedClass) -> None:
    ada, ben = driver(served), driver(served)
    with page_of(ada) as hers, page_of(ben) as his:
        learn(hers)
        process = learner(served)
        learn(his)
        for page in (his, hers):
            page.part("teach", lambda p: p["learning"] and not p["learning"]["is_over"])
            assert page.done("teach_stop")["text"] == "The learning is stopped."
            page.part("teach", lambda p: p["learning"] and p["learning"]["problem"] == STOPPED)
            assert page.parts["teach"]["networks"] == []
        psutil.wait_procs([process], LIMIT_S)
        learn(his)
        has_learned(his)


@pytest.mark.slow
def test_a_killed_learning_says_so_and_begins_again_on_demand(served: ServedClass) -> None:
    with page_of(driver(served)) as page:
        learn(page)
        learner(served).kill()
        page.part("teach", lambda p: p["learning"] and p["learning"]["problem"] == DIED)
        learn(page)
        has_learned(page)


@pytest.mark.slow
@pytest.mark.parametrize("is_killed", [False, True])
def test_a_room_that_ends_meanwhile_gets_its_network_later(
    served: ServedClass, is_killed: bool
) -> None:
    ada, school = driver(served), psutil.Process(served.process.pid)
    room, others = ada.room.split("/")[2], {*school.children(recursive=True)}
    with page_of(ada) as page:
        own = {*school.children(recursive=True)} - others
        learn(page)
        process = learner(served)
        if is_killed:
            for each in own:
                each.kill()
        else:
            assert served.command("sleep", room=room).status_code == 200
    process.resume()
    learned = folder_of(served, ada) / "learned"
    until(lambda: learned.is_dir() and [*learned.glob("*.onnx")])
    with page_of(ada) as page:
        has_learned(page)
        assert len(page.parts["teach"]["networks"]) == 1
    assert served.command("sleep", room=room).status_code == 200
    with page_of(ada) as page:  # it is not taken, nor let drive, once more
        part = page.part("teach", lambda p: p["learning"] and p["learning"]["is_over"])
        assert [each["is_driving"] for each in part["networks"]] == [False]


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="no SIGKILL")
def test_learning_begins_again_after_the_class_was_killed(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        ada = driver(served)
        with page_of(ada) as page:
            learn(page)
            process = learner(served)
            os.kill(served.process.pid, signal.SIGKILL)
            with suppress(psutil.NoSuchProcess):
                process.resume()  # halted before it asked to end with the class
            _, alive = psutil.wait_procs([process], LIMIT_S)
            assert alive == []
    with served_class(tmp_path) as served:
        again = served.student()
        again.client.cookies.update(dict(ada.client.cookies))
        again.room = ada.room
        with page_of(again) as page:
            has_learned(page)


@pytest.mark.slow
def test_nothing_of_a_learning_is_left_after_forget(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        ada, ben = driver(served), driver(served)
        with page_of(ada) as hers, page_of(ben) as his:
            learn(hers)
            process = learner(served)
            learn(his)
            his.part("teach", lambda p: p["learning"] and p["learning"]["waiting"])
            assert served.command("forget").status_code == 200
        _, alive = psutil.wait_procs([process], LIMIT_S)
        assert alive == []
        assert not (tmp_path / "rooms").exists()
    with ClassStore(tmp_path) as store:
        assert store.query("select * from trainings") == []


@pytest.mark.slow
def test_a_world_on_a_students_machine_learns_there(served: ServedClass) -> None:
    request = Learn(KEY, "box_chase", "0", ("box_chase-1.episode",))
    with RawLink(served, served.joined()) as link:
        for message in (request, StopTraining("stop-key", KEY)):
            link.send(message)
            problem = link.next(LinkProblem)
            assert "expected a room on the class's machine" in problem.text
            assert link.next(Ack).key == message.key


@pytest.mark.parametrize(
    "file", ["box_chase-9.episode", "../../secret", "/etc/passwd", "..", ".", "", "a/b", "\0"]
)
def test_only_drives_of_the_room_itself_are_learned_from(tmp_path: Path, file: str) -> None:
    (tmp_path / "rooms" / "secret").mkdir(parents=True)
    assert problem_of(tmp_path, file) == MISSING


@pytest.mark.slow
def test_a_learning_that_takes_too_long_is_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ai4u_edu.classroom.trainings.MAX_CPU_S", 0.0)
    DriveFolder(tmp_path / "rooms" / "a" / DRIVES).add(DRIVEN[0])
    assert problem_of(tmp_path, "box_chase-1.episode") == TOO_LONG


@pytest.mark.slow
def test_a_network_that_can_not_be_kept_is_said(tmp_path: Path) -> None:
    DriveFolder(tmp_path / "rooms" / "a" / DRIVES).add(DRIVEN[0])
    (tmp_path / "rooms" / "a" / LEARNED).write_text("in the way")
    assert problem_of(tmp_path, "box_chase-1.episode").startswith("the network could not be kept: ")


def problem_of(folder: Path, file: str) -> str:
    """Have a network learn from a drive of a room, and return why it brought nothing."""

    async def learn_from(store: ClassStore) -> str:
        trainings = Trainings(store, lambda _: None, lambda: None)
        await trainings.add("a", Learn(KEY, "box_chase", "0", (file,)))
        training = trainings.of_room("a")
        assert training is not None
        assert training.place == 1

        def is_over() -> bool:
            latest = trainings.of_room("a")
            return latest is not None and latest.is_over

        await until_async(is_over)
        training = trainings.of_room("a")
        assert training is not None
        await trainings.end()
        return training.problem

    with ClassStore(folder) as store:
        return asyncio.run(learn_from(store))


def test_a_request_counts_once_and_a_full_folder_is_said(tmp_path: Path) -> None:
    async def ask(store: ClassStore) -> None:
        trainings = Trainings(store, lambda _: None, lambda: None)
        for room in ("a", "b"):
            await trainings.add(room, Learn(KEY, "box_chase", "0", ("x.episode",)))
        training = trainings.of_room("a")
        assert training is not None
        assert training.problem == FULL
        assert trainings.of_room("b") is None
        assert Trainings(store, lambda _: None, lambda: None).of_room("a") == training

    with ClassStore(tmp_path, max_gb=0.0) as store:
        store.quota.measure()
        asyncio.run(ask(store))


@pytest.mark.slow
def test_the_mission_about_learning_can_be_finished_in_a_class(served: ServedClass) -> None:
    with page_of(driver(served)) as page:
        page.done("mission_open", mission="teach-1", step=1)
        page.done("mission_see", tab="teach")
        page.part("mission", lambda part: part["step"] == 1 and part["is_done"])
        page.done("mission_open", mission="teach-1", step=2)
        assert not page.part("mission", lambda part: part["step"] == 2)["is_done"]
        learn(page)
        has_learned(page)
        part = page.part("mission", lambda part: part["is_done"])
        assert part["step"] == part["steps"] - 1
        assert part["stars"][0]["is_earned"]
