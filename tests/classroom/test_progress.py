"""Progress: what results count for, in memory and after a SIGKILL."""

import os
import signal
import sqlite3
from collections.abc import Iterator
from contextlib import closing, suppress
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.course_index import known_exercises
from ai4u_edu.classroom.progress import MAX_GAP_S, Progress, SeatProgress
from ai4u_edu.classroom.store import FILE
from ai4u_edu.lessons.exercise import find
from ai4u_edu.wire.class_link import VERSION, Ack, ExerciseResult, LinkHello, LinkWelcome
from tests.classroom.link_client import RawLink, check
from tests.classroom.served_class import ServedClass, served_class
from tests.waiting import LIMIT_S


@pytest.fixture
def store(tmp_path: Path) -> Iterator[ClassStore]:
    with ClassStore(tmp_path) as store:
        yield store


def note(store: ClassStore, progress: Progress, *results: tuple[int, ExerciseResult]) -> None:
    with store.transaction() as database:
        staged = progress.stage(
            database, [(seat, progress.seconds_since(seat), each) for seat, each in results]
        )
    progress.apply(staged)


def test_entries_are_the_same_after_they_were_read_again(store: ClassStore) -> None:
    progress = Progress(store)
    note(store, progress, (1, check("wrong", "04.2/narrow")), (1, check("wrong", "04.2/narrow")))
    note(store, progress, (1, check("hint")), (2, check("wrong", "any/error")))
    note(store, progress, (1, check("right")), (1, check("wrong", "04.2/narrow")))
    assert progress.entries[1, "04.2"].state == "solved"
    assert (progress.entries[1, "04.2"].tries, progress.entries[1, "04.2"].hints) == (3, 1)
    assert progress.mistakes[1, "04.2/narrow", "04.2"] == 2  # none after it was solved
    again = Progress(store)
    assert (again.entries, again.mistakes) == (progress.entries, progress.mistakes)


def test_time_counts_from_arrival_or_the_result_before_and_not_a_break(store: ClassStore) -> None:
    now = 0.0
    progress = Progress(store, clock=lambda: now)
    progress.begin(1)
    now = 60.0
    note(store, progress, (1, check("wrong")))
    now += 10 * MAX_GAP_S
    note(store, progress, (1, check("right")))
    assert progress.entries[1, "04.2"] == SeatProgress("solved", 2, 0, 60 + MAX_GAP_S)
    assert progress.by_seat() == {"1": {"04.2": {"state": "solved", "tries": 2, "minutes": 16.0}}}


def test_a_change_that_is_not_stored_does_not_count(store: ClassStore) -> None:
    progress = Progress(store)
    note(store, progress, (1, check("wrong")))
    with suppress(RuntimeError), store.transaction() as database:
        progress.stage(database, [(1, 0.0, check("right"))])
        raise RuntimeError
    assert Progress(store).entries == progress.entries


@pytest.mark.slow
def test_acknowledged_results_survive_sigkill_and_count_once(tmp_path: Path) -> None:
    exercise = next(each for each in sorted(known_exercises()) if each == "04.2")
    name = next(iter(find(exercise).hints))
    sent = [check("wrong", f"{exercise}/{name}") for _ in range(3)]
    with served_class(tmp_path) as served:
        ada = served.joined(name="Red Fox")
        with RawLink(served, ada) as link:
            for each in sent:
                link.send(each)
                assert link.next(Ack).key == each.key
            os.kill(served.process.pid, signal.SIGKILL)
            served.process.wait(LIMIT_S)
        token = ada.token
    with served_class(tmp_path) as served:
        with RawLink(served, token, hello=LinkHello(VERSION, token, "notebook")) as link:
            link.next(LinkWelcome)
            whys = [room["why"] for room in served.state()["rooms"]]
            assert "the same wrong answer 3 times in 04.2" in whys
            for each in [*sent, check("wrong", "04.2/<script>"), check("hint")]:
                link.send(each)
                link.next(Ack)
        told = served.state()
    entry = told["progress"]["1"]["04.2"]
    assert (told["progress"].keys(), entry["state"], entry["tries"]) == ({"1"}, "hint", 4)
    mistakes = {each["diagnosis"]: each for each in told["misconceptions"]}
    assert {key: each["count"] for key, each in mistakes.items()} == {
        f"04.2/{name}": 3,
        "any/unknown": 1,
    }
    known: dict[str, Any] = mistakes[f"04.2/{name}"]
    assert known["sentence"] == find(exercise).hints[name]
    assert "In 04.2 asking for a cosine of 1" in known["guide"]
    assert known["seats"] == [1]


@pytest.mark.slow
def test_a_result_that_can_not_be_stored_is_not_acknowledged(served: ServedClass) -> None:
    """The class's file is held by another program for longer than SQLite waits."""
    ada = served.joined()
    with RawLink(served, ada) as link:
        link.send(check("right"))
        link.next(Ack)
        with closing(sqlite3.connect(served.folder / FILE, isolation_level=None)) as other:
            other.execute("begin immediate")
            unsaved = check("wrong", exercise="04.3")
            link.send(unsaved)
            code, _ = link.end()
            assert code == 1013
            assert Ack(unsaved.key) not in link.received
            assert "can't save" in served.state()["problem"]
    with RawLink(served, ada) as link:
        link.send(unsaved)
        link.next(Ack)
    assert served.state()["problem"] == ""


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served
