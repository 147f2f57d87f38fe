"""Practices in a class's process: who is next, what ends them, and what a student sees of it."""

import asyncio
import os
import re
import sys
from collections.abc import Awaitable, Callable, Iterator
from itertools import pairwise
from pathlib import Path

import psutil
import pytest

from ai4u_edu import Scene
from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.practice_queue import (
    CPU_FILE,
    MAX_CPU_S,
    MAX_OPEN,
    TOO_LONG,
    TOO_MANY,
    PracticeQueue,
)
from ai4u_edu.classroom.room_queue import MISSING, STOPPED_BY_TEACHER
from ai4u_edu.classroom.trainings import FULL
from ai4u_edu.learn.small.ppo import PpoSettings
from ai4u_edu.learn.training.run import Run
from ai4u_edu.teach.learning import DIED, STOPPED
from ai4u_edu.teach.practice import FOLDER as PRACTICES
from ai4u_edu.teach.practice import PracticeFolder, PracticeRequest
from ai4u_edu.wire.class_link import Practise, Practised
from tests.classroom.served_class import ServedClass, served_class
from tests.classroom.test_trainings import folder_of, process_of
from tests.page.panel.rooms import PanelPage
from tests.processes import is_server
from tests.waiting import LIMIT_S, until, until_async

SOON = 256
LATE = 1_000_000
AWAY = {"touch": -1.0}
"""Factors with which a practice never reaches the goal, so that it does not end early."""


class Asking:
    """Rooms that ask a queue with one worker for practices."""

    def __init__(self, store: ClassStore) -> None:
        self.store = store
        self.told: list[str] = []
        self.rounds = 0
        """Times that the queue has looked after all practices, and a few more."""
        self.queue = PracticeQueue(store, 1, self.told.append, self._count)

    def _count(self) -> None:
        self.rounds += 1

    def folder(self, room: str) -> Path:
        return self.store.folder / "rooms" / room / PRACTICES

    async def practise(self, room: str, key: str, steps: int) -> Path:
        """Ask for a practice, and return its folder."""
        folder = self.request(room, steps)
        await self.queue.add(room, Practise(key, folder.name))
        return folder

    def request(self, room: str, steps: int) -> Path:
        """Put the request for a practice into its folder, and return that."""
        scene = Scene.load("box_chase")
        request = PracticeRequest(scene.dumps(), "box_chase", "", "0", steps, 0, AWAY)
        folder, _ = PracticeFolder(self.folder(room)).add("box_chase", request)
        return folder

    def state(self, room: str, key: str) -> Practised:
        (state,) = [state for state in self.queue.of_room(room) if state.key == key]
        return state

    async def has_ended(self, room: str, key: str) -> str:
        """Wait until a practice is over, and return why it ended early."""
        await until_async(lambda: self.state(room, key).is_over)
        return self.state(room, key).problem

    async def is_learning(self, room: str, key: str, folder: Path) -> None:
        """Wait until a practice has made a check."""
        await until_async(
            lambda: not self.state(room, key).place and bool(Run(folder / "run").checks())
        )


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
def test_the_shortest_practice_learns_first_and_takes_the_place_of_a_longer_one(
    tmp_path: Path,
) -> None:
    async def task(asking: Asking) -> None:
        folder = await asking.practise("a", "long", LATE)
        assert asking.state("a", "long").place == 1
        await asking.is_learning("a", "long", folder)
        await asking.practise("b", "longer", LATE + 1)
        await asking.practise("c", "short", SOON)
        assert asking.state("c", "short").place == 1
        assert asking.state("b", "longer").place == 2
        assert await asking.has_ended("c", "short") == ""
        run = Run(asking.folder("c") / "box_chase-1.practice" / "run")
        assert run.best_network.is_file()
        await asking.queue.add("c", Practise("again", "box_chase-1.practice"))
        assert await asking.has_ended("c", "again") == ""  # as if its end was not noted
        assert not asking.state("a", "long").is_over  # it goes on from where it was
        await until_async(lambda: not asking.state("a", "long").place)
        assert asking.state("b", "longer").place == 1
        assert float((folder / CPU_FILE).read_text()) > 0.0
        assert "% done, goal " in asking.queue.sentence("a")
        assert asking.queue.sentence("b") == "waits to practise, place 1"
        assert {"a", "b", "c"} <= {*asking.told}
        assert await asking.queue.stop("a", "long")
        assert asking.state("a", "long").problem == STOPPED
        assert asking.queue.sentence("a") == ""
        assert not await asking.queue.stop("a", "long")
        assert not await asking.queue.stop("c", "long")

    with_queue(tmp_path, task)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="a folder has no named pipes")
def test_a_practice_waits_until_its_length_is_known(tmp_path: Path) -> None:
    """The disk is slow: a practice is asked for, and its request is not read yet."""

    async def task(asking: Asking) -> None:
        learning = await asking.practise("a", "long", LATE)
        await asking.is_learning("a", "long", learning)
        folder = asking.request("b", LATE + 1)
        text = (folder / "request.json").read_bytes()
        (folder / "request.json").unlink()
        os.mkfifo(folder / "request.json")
        asked = asyncio.create_task(asking.queue.add("b", Practise("longer", folder.name)))
        try:
            rounds = asking.rounds
            await until_async(lambda: asking.rounds > rounds + 3)
            assert asking.state("a", "long").place == 0
        finally:
            pipe = await asyncio.to_thread((folder / "request.json").open, "wb")
            (folder / "request.json").unlink()
            (folder / "request.json").write_bytes(text)
            with pipe:
                pipe.write(text)
        await asked
        assert asking.state("b", "longer").place == 1

    with_queue(tmp_path, task)


@pytest.mark.slow
def test_a_practice_that_has_used_its_time_is_ended(tmp_path: Path) -> None:
    async def task(asking: Asking) -> None:
        folder = await asking.practise("a", "first", LATE)
        await asking.is_learning("a", "first", folder)
        await asking.queue.stop("a")
        (folder / CPU_FILE).write_text(str(MAX_CPU_S))
        await asking.queue.add("a", Practise("again", folder.name))
        assert await asking.has_ended("a", "again") == TOO_LONG

    with_queue(tmp_path, task)


@pytest.mark.slow
def test_practices_go_on_in_the_next_process_of_a_class(tmp_path: Path) -> None:
    sentences: list[str] = []

    async def begin(asking: Asking) -> None:
        folder = await asking.practise("a", "first", 8192)
        await asking.is_learning("a", "first", folder)
        # as if the class's process was killed: its queue is not told of an end

    async def go_on(asking: Asking) -> None:
        asking.queue.tick()
        assert await asking.has_ended("a", "first") == ""
        sentences.append(asking.queue.sentence("a"))

    async def look(asking: Asking) -> None:
        sentences.append(asking.queue.sentence("a"))

    with_queue(tmp_path, begin)
    with_queue(tmp_path, go_on)
    with_queue(tmp_path, look)
    first, second = sentences
    assert first.startswith("practised, goal ")
    assert second == first


def test_a_room_waits_with_a_few_practices_only(tmp_path: Path) -> None:
    async def task(asking: Asking) -> None:
        keys = [f"key-{number}" for number in range(MAX_OPEN + 1)]
        for key in keys:
            await asking.practise("a", key, LATE)
        states = [asking.state("a", key) for key in keys]
        assert [state.problem for state in states] == [*[""] * MAX_OPEN, TOO_MANY]
        await asking.queue.add("a", Practise("key-0", "box_chase-1.practice"))
        assert len(asking.queue.of_room("a")) == MAX_OPEN + 1

    with_queue(tmp_path, task)


def test_nothing_is_said_of_a_practice_that_a_teacher_stopped_at_once(tmp_path: Path) -> None:
    async def task(asking: Asking) -> None:
        await asking.practise("a", "first", LATE)
        assert await asking.queue.stop("a", problem=STOPPED_BY_TEACHER)
        assert asking.queue.sentence("a") == ""

    with_queue(tmp_path, task)


@pytest.mark.parametrize(
    "name", ["box_chase-9.practice", "../../b/practices/x", "/etc", "..", ".", "", "a/b", "\0"]
)
def test_only_practices_of_the_room_itself_are_run(tmp_path: Path, name: str) -> None:
    async def task(asking: Asking) -> None:
        await asking.queue.add("a", Practise("key", name))
        assert await asking.has_ended("a", "key") == MISSING
        assert asking.queue.sentence("a") == "could not practise"

    with_queue(tmp_path, task)


def test_a_full_folder_is_said(tmp_path: Path) -> None:
    async def task(asking: Asking) -> None:
        asking.store.quota.measure()
        await asking.queue.add("a", Practise("key", "box_chase-1.practice"))
        assert asking.state("a", "key").problem == FULL

    with_queue(tmp_path, task, max_gb=0.0)


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served


def page_of(served: ServedClass) -> tuple[PanelPage, str]:
    """Return the page of a student in box_chase, and the id of the room."""
    student = served.joined()
    page = PanelPage(student.address + "ws/panel", additional_headers=student.cookies)
    page.part("teach", lambda part: part["rewards"])
    return page, folder_of(served, student).name


def learning_of(served: ServedClass, room: str) -> str:
    (card,) = [card for card in served.state()["rooms"] if card["id"] == room]
    return str(card["learning"])


def is_awake(served: ServedClass, room: str) -> bool:
    (card,) = [card for card in served.state()["rooms"] if card["id"] == room]
    return bool(card["is_running"])


@pytest.mark.slow
def test_a_student_practises_waits_pauses_and_gets_the_network(served: ServedClass) -> None:
    with page_of(served)[0] as hers, page_of(served)[0] as his:
        hers.done("teach_practise", steps=LATE, weights=AWAY)
        hers.part("teach", lambda p: p["practice"] and p["practice"]["decisions"] > 0)
        process = process_of(served, "practice_process")
        process.suspend()
        his.done("teach_practise", steps=LATE, weights=AWAY)
        waiting = "Your place in the line: 1."
        his.part("teach", lambda p: p["practice"] and p["practice"]["waiting"] == waiting)
        assert hers.done("teach_pause")["text"] == "The practice is paused."
        hers.part("teach", lambda p: p["practice"]["phase"] == "paused")
        his.part("teach", lambda p: p["practice"]["rewards"])
        his.done("teach_stop_practising")
        part = his.part("teach", lambda p: len(p["networks"]) == 1)
        assert part["networks"][0]["how"].startswith("practised for ")
        assert part["practice"]["problem"] == STOPPED
        before = hers.parts["teach"]["practice"]["decisions"]
        hers.done("teach_go_on")
        hers.part("teach", lambda p: p["practice"]["decisions"] > before)
        hers.part("teach", lambda p: p["practice"]["rewards"])
        hers.done("teach_stop_practising")
        part = hers.part("teach", lambda p: p["practice"]["phase"] == "over")
        assert part["practice"]["problem"] == STOPPED
        hers.part("teach", lambda p: len(p["networks"]) == 1)
    assert psutil.wait_procs([process], LIMIT_S)[1] == []


@pytest.mark.slow
def test_a_teacher_sees_who_practises_stops_it_and_hands_the_network_out(
    served: ServedClass,
) -> None:
    (hers, room), (his, other) = page_of(served), page_of(served)
    with hers, his:
        answer = served.command("stop training", room=room)
        assert answer.json()["problem"] == "nothing learns in this room any more"
        hers.done("teach_practise", steps=LATE, weights=AWAY)
        hers.part("teach", lambda p: p["practice"] and p["practice"]["rewards"])
        until(lambda: re.match("practises, [0-9]+% done, goal ", learning_of(served, room)))
        assert served.command("stop training", room=room).status_code == 200
        part = hers.part("teach", lambda p: p["practice"]["phase"] == "over")
        assert part["practice"]["problem"] == "your teacher has stopped it"
        assert learning_of(served, room).startswith("practised, goal ")
        hers.part("teach", lambda p: len(p["networks"]) == 1)
        hers.done("teach_rename", network=1, title="Ada's best")
        (network,) = served.networks(room)
        assert (network["scene"], network["number"]) == ("box_chase", 1)
        assert network["title"] == "Ada's best"
        wanted = {"room": room, "scene": "box_chase"}
        assert "not there any more" in served.command("hand out", **wanted, network=7).text
        assert served.command("hand out", **wanted, network=1).status_code == 200
        part = his.part("teach", lambda p: len(p["networks"]) == 1)
        assert part["networks"][0]["title"] == "From your teacher"
        assert part["networks"][0]["how"] == "handed out by your teacher"
        assert not part["networks"][0]["is_driving"]
    folders = [served.folder / "rooms" / each / "networks" for each in (room, other)]
    one, two = [(folder / "box_chase-1.onnx").read_bytes() for folder in folders]
    assert one == two
    assert "Ada" not in (folders[1] / "box_chase-1.json").read_text()
    until(lambda: not [*(served.folder / "rooms" / other / "handed_out").iterdir()])


@pytest.mark.slow
def test_a_killed_practice_says_so_and_keeps_what_it_reached(served: ServedClass) -> None:
    with page_of(served)[0] as page:
        page.done("teach_practise", steps=LATE, weights=AWAY)
        page.part("teach", lambda p: p["practice"] and p["practice"]["rewards"])
        process_of(served, "practice_process").kill()
        part = page.part("teach", lambda p: p["practice"]["phase"] == "over")
        assert part["practice"]["problem"] == DIED
        page.part("teach", lambda p: len(p["networks"]) == 1)


@pytest.mark.slow
@pytest.mark.parametrize("is_over_before", [False, True])
def test_a_practice_goes_on_while_its_room_sleeps(
    served: ServedClass, *, is_over_before: bool
) -> None:
    student = served.joined()
    folder = folder_of(served, student)

    def open_page() -> PanelPage:
        page = PanelPage(student.address + "ws/panel", additional_headers=student.cookies)
        page.part("teach", lambda part: part["rewards"])
        return page

    with open_page() as page:
        page.done("teach_practise", steps=8192 if is_over_before else LATE, weights=AWAY)
        page.part("teach", lambda p: p["practice"] and p["practice"]["decisions"] > 0)
        process = process_of(served, "practice_process")
        process.suspend()  # so that it is not over before its room sleeps
    (run,) = [Run(practice / "run") for practice in (folder / PRACTICES).glob("*.practice")]
    assert served.command("sleep", room=folder.name).status_code == 200
    until(lambda: not is_awake(served, folder.name))
    process.resume()
    until(lambda: len(run.checks()) > 1)
    if is_over_before:
        until(lambda: learning_of(served, folder.name).startswith("practised"))
    with open_page() as page:
        if not is_over_before:
            page.part("teach", lambda p: p["practice"] and p["practice"]["decisions"] > 4096)
            page.done("teach_stop_practising")
        page.part("teach", lambda p: len(p["networks"]) == 1)
    until(lambda: not [*(folder / PRACTICES).iterdir()])


@pytest.mark.slow
def test_nothing_of_a_practice_is_left_after_forget(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        with page_of(served)[0] as page:
            page.done("teach_practise", steps=LATE, weights=AWAY)
            page.part("teach", lambda p: p["practice"] and p["practice"]["decisions"] > 0)
            process = process_of(served, "practice_process")
            assert served.command("forget").status_code == 200
        assert psutil.wait_procs([process], LIMIT_S)[1] == []
        assert not (tmp_path / "rooms").exists()
    with ClassStore(tmp_path) as store:
        assert store.query("select * from practices") == []


@pytest.mark.slow
def test_a_practice_survives_a_kill_of_its_room_and_of_the_class(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        (page, room), class_process = page_of(served), psutil.Process(served.process.pid)
        with page:
            page.done("teach_practise", steps=LATE, weights=AWAY)
            page.part("teach", lambda p: p["practice"] and p["practice"]["rewards"])
            learner = process_of(served, "practice_process")
            folder = tmp_path / "rooms" / room
            (run,) = [Run(practice / "run") for practice in (folder / PRACTICES).glob("*.practice")]
            (room_process,) = filter(is_server, class_process.children(recursive=True))
            room_process.kill()
            count = len(run.checks())
            until(lambda: len(run.checks()) > count)  # the room's end is nothing to it
            assert learner.is_running()
        class_process.kill()
        assert psutil.wait_procs([learner], LIMIT_S)[1] == []  # nobody would stop it otherwise
        before = run.checks()
    with served_class(tmp_path) as served:
        until(lambda: len(run.checks()) > len(before))  # though nobody has come yet
        after = run.checks()
        assert after[: len(before)] == before
        gaps = {later.steps - earlier.steps for earlier, later in pairwise(after)}
        assert gaps == {PpoSettings().check_every}  # nothing is learned twice or left out
        until(lambda: learning_of(served, room).startswith("practises, "))
        assert served.command("stop training", room=room).status_code == 200
