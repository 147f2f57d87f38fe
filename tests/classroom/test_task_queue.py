"""Tasks in a class's process: whose turn it is, what ends them, and what a student sees of it."""

import asyncio
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path

import msgspec
import psutil
import pytest

from ai4u_edu import Scene
from ai4u_edu.blocks.brains import zoo
from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.room_queue import MISSING
from ai4u_edu.classroom.task_queue import TOO_MANY, TaskQueue
from ai4u_edu.classroom.trainings import FULL
from ai4u_edu.learn.training.varying import with_driver
from ai4u_edu.teach import tries
from ai4u_edu.teach.learning import STOPPED
from ai4u_edu.teach.tasks import FOLDER, NOTES, REQUEST
from ai4u_edu.teach.tries import TryRequest
from ai4u_edu.wire.class_link import Task, TaskState
from tests.classroom.served_class import ServedClass, served_class
from tests.classroom.test_practice_queue import learning_of, page_of
from tests.classroom.test_trainings import folder_of, process_of
from tests.page.panel.rooms import PanelPage
from tests.processes import children_that_run
from tests.waiting import LIMIT_S, until, until_async

SPEED = "0.move.move_amount"
MANY = {"parameter": SPEED, "values": "5, 0", "starts": 200}
"""Values that take some time: with the second one the robot stands still."""


class Asking:
    """Rooms that ask a queue for tasks."""

    def __init__(self, store: ClassStore) -> None:
        self.store = store
        self.told: list[str] = []
        self.queue = TaskQueue(store, self.told.append, lambda: None)
        scene, _ = with_driver(Scene.load("box_chase"), "zoo")
        self._scene = scene.dumps()

    def folder(self, room: str, key: str) -> Path:
        return self.store.folder / "rooms" / room / FOLDER / key

    async def try_values(self, room: str, key: str, values: list[float], starts: int = 1) -> None:
        request = TryRequest(self._scene, "", "0", SPEED, values, starts, "box_chase", "speed")
        folder = self.folder(room, key)
        folder.mkdir(parents=True)
        (folder / REQUEST).write_bytes(msgspec.json.encode(request))
        await self.queue.add(room, Task(key, "try"))

    def state(self, room: str, key: str) -> TaskState:
        (state,) = [state for state in self.queue.of_room(room) if state.key == key]
        return state

    async def has_ended(self, room: str, key: str) -> str:
        """Wait until a task is over, and return why it ended early."""
        await until_async(lambda: self.state(room, key).is_over)
        return self.state(room, key).problem

    def tried(self, room: str, key: str) -> list[float]:
        """Return the values that are done."""
        lines = (self.folder(room, key) / NOTES).read_bytes().splitlines()
        notes = [msgspec.json.decode(line, type=tries.TryNote) for line in lines]
        assert [note.problem for note in notes if note.problem] == []
        return [note.row.value for note in notes if note.row is not None]


def with_queue(folder: Path, task: Callable[[Asking], Awaitable[None]], **limits: float) -> None:
    """Run a task with a queue, which is ended afterwards."""

    async def run(store: ClassStore) -> None:
        asking = Asking(store)
        try:
            await task(asking)
        finally:
            await asking.queue.end()

    with ClassStore(folder, **limits) as store:
        asyncio.run(run(store))


@pytest.mark.slow
def test_the_tries_with_the_fewest_episodes_come_first(tmp_path: Path) -> None:
    async def task(asking: Asking) -> None:
        await asking.try_values("a", "try-first", [5.0, 4.0])
        await until_async(lambda: not asking.state("a", "try-first").place)
        (first,) = children_that_run("ai4u_edu.teach.try_process")
        first.suspend()  # until the others wait
        await asking.try_values("b", "try-long", [5.0], 50)
        await asking.try_values("c", "try-short", [5.0], 2)
        await asking.try_values("c", "try-again", [5.0])
        assert asking.state("c", "try-again").problem == TOO_MANY
        first.resume()
        assert await asking.has_ended("a", "try-first") == ""
        assert asking.tried("a", "try-first") == [5.0, 4.0]
        assert await asking.has_ended("c", "try-short") == ""
        assert not asking.state("b", "try-long").is_over
        await until_async(lambda: asking.queue.sentence("b").endswith("of 50 episodes"))
        assert await asking.queue.stop("b", "try-long")
        assert asking.state("b", "try-long").problem == STOPPED
        assert not await asking.queue.stop("b", "try-long")
        assert {"a", "b", "c"} <= {*asking.told}

    with_queue(tmp_path, task)


@pytest.mark.slow
def test_values_that_are_done_are_not_tried_again_after_a_restart(tmp_path: Path) -> None:
    async def begin(asking: Asking) -> None:
        await asking.try_values("a", "try-first", [5.0, 0.0, 4.0], 4)
        await until_async(lambda: asking.folder("a", "try-first").joinpath(NOTES).is_file())
        await until_async(lambda: bool(asking.tried("a", "try-first")))

    async def go_on(asking: Asking) -> None:
        notes = (asking.folder("a", "try-first") / NOTES).read_bytes()
        await asking.queue.add("a", Task("try-first", "try"))
        assert await asking.has_ended("a", "try-first") == ""
        assert asking.tried("a", "try-first") == [5.0, 0.0, 4.0]
        first = next(line for line in notes.splitlines() if b'"row"' in line)
        assert (asking.folder("a", "try-first") / NOTES).read_bytes().startswith(first)

    with_queue(tmp_path, begin)
    with_queue(tmp_path, go_on)


def test_a_task_without_its_files_is_said(tmp_path: Path) -> None:
    async def task(asking: Asking) -> None:
        for kind in ("open", "try"):
            await asking.queue.add("a", Task(f"{kind}-first", kind))
            assert await asking.has_ended("a", f"{kind}-first") == MISSING

    with_queue(tmp_path, task)


def test_a_full_folder_is_said(tmp_path: Path) -> None:
    async def task(asking: Asking) -> None:
        asking.store.quota.measure()
        await asking.queue.add("a", Task("try-first", "try"))
        assert asking.state("a", "try-first").problem == FULL

    with_queue(tmp_path, task, max_gb=0.0)


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served


def open_file(page: PanelPage, name: str, data: bytes) -> None:
    page.socket.send(data)
    answer = page.do("teach_open", name=name, size=len(data))
    assert answer["type"] == "done", answer


def let_a_network_drive(page: PanelPage) -> None:
    """Open the scene's network as one of the student's own, and let it drive."""
    open_file(page, "zoo.onnx", zoo.network_of("box_chase").read_bytes())
    page.part("teach", lambda part: part["networks"])
    page.done("teach_drive", network=1)
    page.part("tries", lambda part: not part["problem"] and part["numbers"])


@pytest.mark.slow
def test_a_student_opens_a_file(served: ServedClass) -> None:
    page, room = page_of(served)
    with page:
        open_file(page, "friend.onnx", zoo.network_of("box_chase").read_bytes())
        (network,) = page.part("teach", lambda part: part["networks"])["networks"]
        assert network["how"] == "opened from the file friend.onnx"
        assert "It reaches the goal from all 8 starts." in network["facts"]
        page.part("teach", lambda part: not part["opening"])
        for name, data, problem in (
            ("junk.onnx", b"hello", "junk.onnx can't drive this robot: "),
            ("parking.onnx", zoo.network_of("parking").read_bytes(), "can't drive this robot"),
        ):
            page.socket.send(data)
            text = page.failed("teach_open", name=name, size=len(data))["text"]
            assert problem in text
            assert str(served.folder) not in text
    assert [*(served.folder / "rooms" / room / FOLDER).iterdir()] == []


@pytest.mark.slow
def test_students_try_many_values_one_after_another(served: ServedClass) -> None:
    (hers, room), (his, _) = page_of(served), page_of(served)
    with hers, his:
        for page in (hers, his):
            let_a_network_drive(page)
        hers.done("teach_try", **MANY)
        process = process_of(served, "try_process")
        his.done("teach_try", parameter=SPEED, values="5", starts=2)
        waiting = "Your place in the line: 1."
        his.part("tries", lambda p: p["tries"] and p["tries"]["waiting"] == waiting)
        until(lambda: "tries values, " in learning_of(served, room))
        hers.part("tries", lambda p: p["tries"] and p["tries"]["rows"])
        assert hers.done("teach_stop_trying")["text"] == "The tries are stopped."
        part = hers.part("tries", lambda p: p["tries"] and p["tries"]["is_over"])
        assert part["tries"]["problem"] == STOPPED
        part = his.part("tries", lambda p: p["tries"] and p["tries"]["is_over"])
        assert [(row["value"], row["successes"]) for row in part["tries"]["rows"]] == [(5, 2)]
        assert his.done("teach_download_tried")["name"] == f"box_chase-{SPEED}.csv"
        assert "nothing learns" in served.command("stop training", room=room).json()["problem"]
    assert psutil.wait_procs([process], LIMIT_S)[1] == []


@pytest.mark.slow
def test_tries_go_on_while_their_room_sleeps(served: ServedClass) -> None:
    student = served.joined()
    room = folder_of(served, student).name

    def open_page() -> PanelPage:
        page = PanelPage(student.address + "ws/panel", additional_headers=student.cookies)
        page.part("tries", lambda part: part["numbers"])
        return page

    with open_page() as page:
        let_a_network_drive(page)
        page.done("teach_try", parameter=SPEED, values="5, 0", starts=6)
        page.part("tries", lambda p: p["tries"] and p["tries"]["done"] > 0)
    assert served.command("sleep", room=room).status_code == 200
    until(lambda: not learning_of(served, room))
    with open_page() as page:
        part = page.part("tries", lambda p: p["tries"] and p["tries"]["is_over"])
        assert part["tries"]["problem"] == ""
        assert [row["value"] for row in part["tries"]["rows"]] == [5, 0]


@pytest.mark.slow
@pytest.mark.parametrize("command", ["stop training", "kick"])
def test_a_teacher_ends_tries(served: ServedClass, command: str) -> None:
    page, room = page_of(served)
    with page:
        let_a_network_drive(page)
        page.done("teach_try", **MANY)
        process = process_of(served, "try_process")
        (card,) = [card for card in served.state()["rooms"] if card["id"] == room]
        assert card["is_learning"]
        wanted = {"room": room} if command == "stop training" else {"seat": card["seats"][0]}
        assert served.command(command, **wanted).status_code == 200
        assert psutil.wait_procs([process], LIMIT_S)[1] == []
        if command == "stop training":
            part = page.part("tries", lambda p: p["tries"] and p["tries"]["is_over"])
            assert part["tries"]["problem"] == "your teacher has stopped it"


@pytest.mark.slow
def test_no_process_and_no_file_of_a_task_is_left_after_forget(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        with page_of(served)[0] as page:
            let_a_network_drive(page)
            page.done("teach_try", **MANY)
            process = process_of(served, "try_process")
            assert served.command("forget").status_code == 200
        assert psutil.wait_procs([process], LIMIT_S)[1] == []
        assert not (tmp_path / "rooms").exists()
