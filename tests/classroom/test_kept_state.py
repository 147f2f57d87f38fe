"""Attention, assignments and races after the class was started again."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.assignments import NONE, AssignedScene, Assignments
from ai4u_edu.classroom.attention import SAVE_EVERY_S, AttentionState
from ai4u_edu.classroom.race import RaceResult, Races
from ai4u_edu.wire.class_link import EpisodeResult

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
