"""Attention, switches, assignments and races after the class was started again."""

import asyncio
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.assignments import NONE, AssignedScene, Assignments
from ai4u_edu.classroom.attention import SAVE_EVERY_S, AttentionState
from ai4u_edu.classroom.live_class import Shown
from ai4u_edu.classroom.progress import Progress
from ai4u_edu.classroom.race import RaceResult, Races
from ai4u_edu.classroom.result_writer import Received, ResultWriter
from ai4u_edu.wire.class_link import EpisodeResult
from tests.classroom.served_class import served_class

MAZE = AssignedScene("Maze", "maze")


@pytest.fixture
def store(tmp_path: Path) -> Iterator[ClassStore]:
    with ClassStore(tmp_path) as store:
        yield store


def test_attention_has_its_remaining_seconds_by_whatever_clock(store: ClassStore) -> None:
    now = 1000.0
    attention = AttentionState(store, clock=lambda: now)
    attention.set("blank", "Listen", 60)
    now += SAVE_EVERY_S
    attention.save_rest()
    later = AttentionState(store, clock=lambda: 5.0)  # another machine time
    assert (later.kind, later.message) == ("blank", "Listen")
    assert later.ends_in_s == pytest.approx(60 - SAVE_EVERY_S)
    assert not later.is_over()
    later.end()
    assert AttentionState(store).kind == ""


@pytest.mark.slow
def test_a_switch_holds_after_a_restart_but_not_after_forget(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        assert served.command("switch", name="sound", on=True).status_code == 200
    with served_class(tmp_path) as served:
        assert served.state()["switches"] == {"sound": True}
        assert served.command("forget").status_code == 200
        assert served.state()["switches"] == {"sound": False}


def test_a_switch_of_another_version_is_left_out(tmp_path: Path) -> None:
    with ClassStore(tmp_path) as store:
        store.set_setting("switches", '{"of_another_version": true, "sound": true}')
    with served_class(tmp_path) as served:
        assert served.state()["switches"] == {"sound": True}


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "null", '{"kind": 7}', '{"seconds": 1e999, "room": 1}', '{"kind": "x"}'],
)
def test_a_damaged_setting_is_as_if_there_was_none(
    store: ClassStore, text: str, caplog: pytest.LogCaptureFixture
) -> None:
    store.set_setting("attention", text)
    store.set_setting("shown", text)
    attention = AttentionState(store)
    assert (attention.kind, attention.message, attention.ends_in_s) == ("", "", 0.0)
    assert store.setting_as("shown", Shown) == Shown()
    assert caplog.text.count("is damaged") == (2 if text else 0)


def test_of_a_rooms_results_the_latest_are_kept(
    store: ClassStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ai4u_edu.classroom.result_writer.MAX_RESULTS", 3)
    done: list[bool] = []

    async def write(room: str, keys: range) -> None:
        writer = ResultWriter(store, Progress(store), Races(store), str, list)
        for number in keys:
            result = EpisodeResult(f"key{number:05}", "Maze", 1, "goal", 1.0, 1.0, "", "", b"")
            writer.add(Received(room, (), result, done.append))
        await writer.finish()

    asyncio.run(write("a", range(10)))
    asyncio.run(write("b", range(10, 12)))
    asyncio.run(write("a", range(9, 10)))  # it was not acknowledged, say
    kept = store.query("select room, key from results order by rowid")
    assert kept == [
        *[("a", f"key{number:05}") for number in (7, 8, 9)],
        *[("b", f"key{number:05}") for number in (10, 11)],
    ]
    assert done == [True] * 13


def test_rooms_keep_their_assignments(store: ClassStore) -> None:
    assignments = Assignments(store)
    assert assignments.of("a") == NONE
    assignments.assign(replace(MAZE, lesson="08 The maze", program="pass"), None, 3)
    assignments.assign(AssignedScene("Tag", "tag"), ["a"], None)
    again = Assignments(store)
    assert [again.of(room).scene for room in ("a", "b")] == ["tag", "maze"]
    assert again.of("a") == assignments.of("a")
    assert (again.of("b").lesson, again.of("b").program) == ("08 The maze", "pass")
    again.assign(MAZE, None, None)
    assert Assignments(store).of("a").scene == "maze"


def raced(races: Races, store: ClassStore, room: str, seconds: float, number: int) -> RaceResult:
    assert races.now is not None
    result = EpisodeResult(
        f"key{number:05}", "Maze", 1, "goal", seconds, 1.0, "", races.now.id, b"e" * number
    )
    with store.transaction() as database:
        (staged,) = races.stage(database, [(room, result)])
    races.results[staged.key] = staged
    return staged


def test_a_race_goes_on_with_its_results_and_open_ones_are_checked(store: ClassStore) -> None:
    now = 1000.0
    races = Races(store, lambda: now)
    races.start(MAZE, 1, 30.0, hide=True)
    assert not races.start_if_due()
    now += 29.9
    assert not races.start_if_due()
    races = Races(store, lambda: 0.0)
    assert races.start_if_due()  # a countdown that was interrupted is over
    assert races.now is not None
    assert (races.now.phase, races.now.is_board_hidden) == ("running", True)
    slow, fast = raced(races, store, "a", 9.0, 1), raced(races, store, "a", 5.0, 2)
    raced(races, store, "b", 7.0, 3)
    races.judge(fast, "right")

    again = Races(store)
    assert again.best() == {"a": again.results[fast.key]}
    found = again.next_claim()
    assert found is not None
    assert (found[0].room, found[1].episode) == ("b", b"eee")
    again.judge(found[0], "refused", "forged")
    assert again.next_claim() is None  # a's first one is slower than its best
    assert again.results[slow.key].verdict == "none"
    assert again.ghosts() == (b"ee",)
    assert [path.name for path in store.folder.rglob("*.episode")] == [f"{fast.key}.episode"]
    assert again.refused()["b"].reason == "forged"


def test_a_race_that_was_dismissed_stays_so(store: ClassStore) -> None:
    races = Races(store)
    races.start(MAZE, None, 0.0, hide=False)
    races.change(phase="over")
    races.dismiss()
    assert Races(store).now is None
