"""A notebook that joins a class: what is sent, and what happens if the class is not there."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from ai4u_edu.lessons import check, hint, join_class, leave_class, show, stop
from ai4u_edu.lessons.class_membership import current_connection
from ai4u_edu.lessons.progress_file import FOLDER
from ai4u_edu.member.notebook import NO_WORLD
from ai4u_edu.wire.class_link import (
    Applied,
    Assignment,
    Attention,
    Drawing,
    ExerciseResult,
    FromClass,
    LinkProblem,
    LinkWelcome,
    Poses,
    State,
    Work,
)
from tests.lessons.class_with_a_seat import class_with_a_seat, connected
from tests.lessons.test_checking import go, stay
from tests.member.messages import drawing
from tests.member.tiny_class import TinyClass
from tests.page.server.rooms import NOWHERE
from tests.waiting import until

WITHOUT_A_CLASS = """
import sys
opened = []
sys.addaudithook(lambda name, args: name.startswith("socket.") and opened.append(name))
from ai4u_edu.lessons import check, hint, join_class, leave_class
check("00.1", lambda percept: {"move": [0, 0, 0, 0]})
hint("00.1")
leave_class()
print(opened, sorted({"websockets", "httpx"} & set(sys.modules)))
"""


def is_all_delivered() -> bool:
    connection = current_connection()
    return connection is not None and not len(connection.client.outbox)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    leave_class()


@pytest.fixture
def there(monkeypatch: pytest.MonkeyPatch) -> Iterator[TinyClass]:
    with class_with_a_seat(monkeypatch) as there:
        yield there


def _events(there: TinyClass) -> list[tuple[str, str, str]]:
    found = there.of(ExerciseResult)
    return [(e.exercise, e.event, e.diagnosis) for e in found if isinstance(e, ExerciseResult)]


def test_without_a_class_no_socket_is_opened(folder: Path) -> None:
    run = subprocess.run(
        [sys.executable, "-c", WITHOUT_A_CLASS], capture_output=True, text=True, check=True
    )
    assert run.stdout.splitlines()[-2:] == ["You are in no class.", "[] []"]
    assert not (folder / FOLDER / "class.json").exists()
    assert not (folder / FOLDER / "outbox").exists()


def test_checks_and_hints_are_reported(
    there: TinyClass, capsys: pytest.CaptureFixture[str]
) -> None:
    there.start()
    join_class(there.url, "BCDFG")
    assert "Joined. You are Red Fox. Your teacher sees" in capsys.readouterr().out
    check("00.1", stay)
    check("00.1", ...)
    hint("00.1")
    check("00.1", go)
    until(lambda: len(there.results) == 4)
    events = _events(there)
    assert [each[:2] for each in events] == [
        ("00.1", "wrong"),
        ("00.1", "wrong"),
        ("00.1", "hint"),
        ("00.1", "right"),
    ]
    assert [each[2] for each in events[1:]] == ["any/unfinished", "any/unfinished", ""]
    assert events[0][2].startswith("00.1/")
    assert there.hellos[0].kind == "notebook"
    assert "can't be reached" not in capsys.readouterr().out
    leave_class()
    check("00.1", go)
    assert "You have left the class. Nothing is sent any more." in capsys.readouterr().out
    join_class(there.url, "BCDFG")
    hint("00.1")
    until(lambda: len(there.results) > 4)
    assert [each[1] for each in _events(there)[4:]] == ["hint"]


def test_what_a_class_that_is_away_missed_is_delivered_later_once(
    there: TinyClass, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    join_class(there.url, "BCDFG")
    check("00.1", stay)
    connection = current_connection()
    assert connection is not None
    until(lambda: connection.client.problem)
    check("00.1", go)
    told = capsys.readouterr().out
    assert "Right. Your robot drives forward." in told
    assert "The class can't be reached (" in told
    assert "Results are kept and sent later." in told
    leave_class()  # and so the kernel might have been restarted
    there.start()
    join_class(there.url, "BCDFG")
    until(lambda: len(there.results) == 2)
    until(is_all_delivered)  # what is not acknowledged is sent again
    join_class(there.url, "BCDFG")
    hint("00.1")
    until(lambda: len(there.results) == 3)
    assert [each[1] for each in _events(there)] == ["wrong", "right", "hint"]


def test_the_notebook_that_checks_gets_the_seat_back_from_another_one(there: TinyClass) -> None:
    there.start()
    join_class(there.url, "BCDFG")
    connection = connected()
    there.send(LinkProblem("over", "Another program has taken this place."))
    until(lambda: connection.client.is_over)
    check("00.1", go)
    until(lambda: there.results)
    assert len(there.hellos) == 2


def test_not_joined_is_a_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    join_class(f"http://127.0.0.1:{NOWHERE}", "BCDFG")
    told = capsys.readouterr().out
    assert told.startswith("Not joined. The class at http://127.0.0.1:")
    assert "Your checks work without a class, too." in told
    check("00.1", go)
    assert "class" not in capsys.readouterr().out


def test_the_shown_world_appears_and_the_teacher_can_stop_it(there: TinyClass) -> None:
    there.start()
    live = show("box_chase", brain=lambda percept: {"move": [1, 0, 0, 0]})
    try:
        assert not live.runner.is_held
        join_class(there.url, "BCDFG")
        until(lambda: there.of(Poses) and there.of(State) and there.of(Work))
        there.send(Attention("pause", "Look here", 0.0))
        until(lambda: live.runner.is_held)
        leave_class()
        until(lambda: not live.runner.is_held)
        count = len(there.got)
        join_class(there.url, "BCDFG")
        until(lambda: there.of(Drawing)[1:])
        stop()
        until(lambda: there.states[-1].status == "over")
        ended = len(there.of(State))
        check("00.1", go)
        until(lambda: there.results)
        assert len(there.of(State)) == ended
        assert count < len(there.got)
        again = show("donut")
        until(lambda: any("onut" in each.scene for each in there.states))
        assert again.running
    finally:
        stop()


def test_a_world_uses_the_link_while_it_is_shown(there: TinyClass) -> None:
    there.start()
    join_class(there.url, "BCDFG")
    connection = connected()
    there.send(Attention("pause", "Look here", 0.0))
    there.send(Assignment("a1", "Maze", "maze", None))
    until(lambda: there.of(Applied))
    assert there.of(Applied) == [Applied("a1", NO_WORLD)]

    heard: list[FromClass] = []
    world = connection.link_for_world(heard.append)
    world.send(drawing(1))  # not started
    world.start()
    assert world.is_connected
    assert [type(each) for each in heard] == [LinkWelcome, Attention]
    world.send(drawing(2))
    until(lambda: there.of(Drawing))
    there.send(Assignment("a1", "Maze", "maze", None))  # as after a reconnect
    there.send(Assignment("a2", "Maze", "maze", None))
    until(lambda: len(heard) == 3)
    assert heard[2] == Assignment("a2", "Maze", "maze", None)
    there.send(Assignment("a3", "Drive", "sample_scene", 3, "02 Drive"))
    until(lambda: len(heard) == 4)
    drive = Assignment("a3", "Drive", "", None, "02 Drive")
    assert heard[3] == drive, "a lesson's notebook shows its worlds by itself"
    world.stop()
    there.drop()
    until(lambda: len(there.hellos) == 2 and connection.client.is_connected)
    check("00.1", go)
    until(lambda: there.results)
    assert there.of(Drawing) == [drawing(2)]
    assert len(heard) == 4
    later: list[FromClass] = []
    connection.link_for_world(later.append).start()
    assert drive in later
