"""Seats: joining, coming back, and what a teacher does with them."""

import collections
from collections.abc import Iterator
from pathlib import Path

import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.classroom import ClassStore, RoomRule, Seats
from ai4u_edu.classroom.errors import JoinError, NameTakenError, StoreError, WrongCodeError
from ai4u_edu.classroom.names import CODE_LENGTH, CODE_LETTERS, LANGUAGES, is_name, words_of
from ai4u_edu.classroom.seats import MAX_SEATS, SeatState, digest_of
from ai4u_edu.classroom.store import SeatRow


@pytest.fixture
def store(tmp_path: Path) -> Iterator[ClassStore]:
    with ClassStore(tmp_path) as store:
        yield store


@pytest.fixture
def seats(store: ClassStore) -> Seats:
    return Seats(store, "box_chase", RoomRule())


def joined(seats: Seats, request: str, name: str = "") -> tuple[SeatRow, str]:
    return seats.join(seats.code, name or seats.offered_names()[0], request)


def rooms_of(store: ClassStore, rule: str, count: int) -> list[int]:
    """Return which room each of several seats gets, as numbers in the order of their making."""
    seats = Seats(store, "box_chase", RoomRule.parse(rule))
    rooms = [joined(seats, f"r{number}")[0].room for number in range(count)]
    return [list(dict.fromkeys(rooms)).index(room) for room in rooms]


def test_a_code_has_no_letters_that_look_alike(seats: Seats) -> None:
    assert len(seats.code) == CODE_LENGTH
    assert set(seats.code) <= set(CODE_LETTERS)
    assert not set(CODE_LETTERS) & set("AEIOUY01LQ")


def test_three_names_are_offered_and_no_other_is_taken(seats: Seats) -> None:
    names = seats.offered_names()
    assert len(set(names)) == 3
    assert all(map(is_name, names))
    with pytest.raises(JoinError, match="offered"):
        joined(seats, "a", "Ada Lovelace")


def test_a_seat_is_found_by_its_token_and_by_no_other(store: ClassStore, seats: Seats) -> None:
    seat, token = joined(seats, "a")
    assert seats.by_token(token) == seat
    assert seats.by_token(token[:-1] + ("A" if token[-1] != "A" else "B")) is None
    (device,) = store.tokens()
    assert token.encode() not in device.hash


def test_a_code_may_be_typed_carelessly_but_not_wrongly(seats: Seats) -> None:
    code = seats.code.lower()
    seats.join(f" {code[:2]}-{code[2:]} ", seats.offered_names()[0], "a")
    with pytest.raises(WrongCodeError):
        seats.join(code[:-1], seats.offered_names()[0], "b")
    assert len(seats) == 1


def test_a_repeated_request_gets_the_same_seat(seats: Seats) -> None:
    first, lost = joined(seats, "a", "Blue Otter")
    again, token = joined(seats, "a", "Blue Otter")
    assert (first.number, first.room) == (again.number, again.room)
    assert len(seats) == 1
    assert seats.by_token(token) is not None
    assert seats.by_token(lost) is None


def test_a_name_belongs_to_one_seat(seats: Seats) -> None:
    joined(seats, "a", "Blue Otter")
    with pytest.raises(NameTakenError, match="Blue Otter"):
        joined(seats, "b", "Blue Otter")


def test_everything_is_there_after_a_restart(store: ClassStore, tmp_path: Path) -> None:
    seats = Seats(store, "box_chase", RoomRule())
    seat, token = joined(seats, "a")
    seats.set_open(False)
    store.close()
    with ClassStore(tmp_path) as again:
        later = Seats(again, "maze", RoomRule())
        assert later.code == seats.code
        assert later.by_token(token) == seat
        assert later.scenes() == {seat.room: "box_chase"}
        assert not later.is_open


@pytest.mark.parametrize(
    ("rule", "rooms"),
    [
        ("each", [0, 1, 2, 3, 4]),
        ("pairs", [0, 0, 1, 1, 2]),
        ("teams:2", [0, 1, 0, 1, 0]),
        ("one", [0, 0, 0, 0, 0]),
    ],
)
def test_rooms_are_shared_as_the_rule_says(store: ClassStore, rule: str, rooms: list[int]) -> None:
    assert rooms_of(store, rule, 5) == rooms


@pytest.mark.parametrize("text", ["", "two", "teams", "teams:0", "teams:x", "each:3"])
def test_a_rule_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(SetupError, match="each, pairs, teams:N or one"):
        RoomRule.parse(text)


def test_kicked_student_may_rejoin_and_banned_may_not(seats: Seats) -> None:
    kicked, token = joined(seats, "a")
    seats.set_state(kicked.number, SeatState.KICKED)
    assert seats.by_token(token) is None
    again, token = joined(seats, "a")
    assert (again.number, again.room) == (kicked.number, kicked.room)
    seats.set_state(again.number, SeatState.BANNED)
    for request, held in (("a", ""), ("another", token)):
        with pytest.raises(JoinError, match="may not join"):
            seats.join(seats.code, "Wise Owl", request, held)


def test_a_closed_class_lets_nobody_in_and_keeps_who_is_there(seats: Seats) -> None:
    _, token = joined(seats, "a")
    seats.set_open(False)
    with pytest.raises(JoinError, match="Nobody else"):
        joined(seats, "b")
    assert seats.by_token(token) is not None
    joined(seats, "a")  # whose answer got lost


def test_a_new_code_makes_the_old_one_void(seats: Seats) -> None:
    before = seats.code
    assert seats.change_code() == seats.code != before
    with pytest.raises(WrongCodeError):
        seats.join(before, seats.offered_names()[0], "a")


def test_a_seat_gets_another_name(seats: Seats) -> None:
    seat, token = joined(seats, "a", "Blue Otter")
    other, _ = joined(seats, "b", "Red Fox")
    seats.rename(seat.number, "Calm Crane")
    renamed = seats.by_token(token)
    assert renamed is not None
    assert renamed.name == "Calm Crane"
    with pytest.raises(NameTakenError):
        seats.rename(other.number, "Calm Crane")
    with pytest.raises(JoinError, match="no seat"):
        seats.rename(99, "Wise Owl")


def test_a_full_class_says_so(seats: Seats) -> None:
    for number in range(MAX_SEATS):
        seat, _ = joined(seats, f"{number}")
        seats.note_opened(seat.number)
    with pytest.raises(JoinError, match="full"):
        joined(seats, "one more")


def test_a_file_of_another_version_is_not_touched(tmp_path: Path) -> None:
    with ClassStore(tmp_path) as store:
        store._database.execute("pragma user_version = 99")
    with pytest.raises(SetupError, match="another version"):
        ClassStore(tmp_path)


def test_a_file_that_is_no_database_is_said(tmp_path: Path) -> None:
    (tmp_path / "class.sqlite3").write_text("hello " * 1000)
    with pytest.raises(SetupError, match="couldn't use it"):
        ClassStore(tmp_path)


def test_a_move_code_lets_another_device_in_once(seats: Seats) -> None:
    seat, token = joined(seats, "a")
    assert not seats.has_move_code(seat.number)
    code = seats.new_move_code(seat.number)
    assert seats.has_move_code(seat.number)
    moved, second = seats.join(code.lower(), "", "b")
    assert not seats.has_move_code(seat.number)
    assert moved == seat
    assert seats.by_token(token) == seats.by_token(second) == seat
    again, _ = seats.join(code, "", "b")  # whose answer got lost
    assert again == seat
    assert seats.by_token(second) is None
    with pytest.raises(WrongCodeError):
        seats.join(code, "", "c")
    assert len(seats) == 1


def test_the_fourth_device_takes_the_place_of_the_oldest(store: ClassStore, seats: Seats) -> None:
    seat, first = joined(seats, "a")
    tokens = [
        seats.join(seats.new_move_code(seat.number), "", request)[1] for request in ("b", "c", "d")
    ]
    assert seats.by_token(first) is None
    assert all(seats.by_token(token) == seat for token in tokens)
    assert [each.request for each in store.tokens()] == [digest_of(each) for each in "bcd"]


def test_a_device_that_moves_to_another_seat_leaves_its_own(seats: Seats) -> None:
    _, held = joined(seats, "a")
    other, _ = joined(seats, "b")
    moved, token = seats.join(seats.new_move_code(other.number), "", "a", held)
    assert moved == other
    assert seats.by_token(held) is None
    assert seats.by_token(token) == other


def test_rejoin_after_a_kick_invalidates_other_devices(seats: Seats) -> None:
    seat, held = joined(seats, "a")
    _, second = seats.join(seats.new_move_code(seat.number), "", "b")
    seats.set_state(seat.number, SeatState.KICKED)
    _, token = seats.join(seats.code, "", "a", held)
    assert seats.by_token(token) is not None
    assert seats.by_token(second) is None


def test_a_disk_that_is_full_is_said_and_nothing_is_half_there(
    store: ClassStore, seats: Seats
) -> None:
    joined(seats, "a")
    pages = store.query("pragma page_count")[0][0]
    store.query(f"pragma max_page_count = {pages}")
    with pytest.raises(StoreError, match="The disk is full"):
        collections.deque(joined(seats, f"{number}") for number in range(MAX_SEATS))
    assert [each.number for each in store.seats()] == [each.number for each in seats.all()]
    store.query("pragma max_page_count = 100000")
    joined(seats, "later")


@pytest.mark.parametrize("language", LANGUAGES)
def test_names_come_in_the_classs_language(store: ClassStore, language: str) -> None:
    seats = Seats(store, "box_chase", RoomRule(), language=language)
    first, second = words_of(language)
    assert len({*first}) * len({*second}) > 1000
    for name in seats.offered_names():
        assert name.split(" ")[0] in first
        assert seats.join(seats.code, name, f"language {name}")[0].name == name


def test_a_language_without_names_is_said(store: ClassStore) -> None:
    with pytest.raises(SetupError, match="expected one of de, en, es, fr, ko, pt_BR, got 'xx'"):
        Seats(store, "box_chase", RoomRule(), language="xx")
