"""One device that takes seats, or loses them, leaves places for others, and no secrets."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import httpx
import pytest

from ai4u_edu.classroom import ClassStore, RoomRule, Seats
from ai4u_edu.classroom import join as join_routes
from ai4u_edu.classroom.errors import JoinError, NewSeatError
from ai4u_edu.classroom.programs import Programs
from ai4u_edu.classroom.seats import MAX_SEATS, UNOPENED_S, SeatState
from tests.classroom.served_class import ServedClass, Student, served_class
from tests.page.server.rooms import Clock
from tests.waiting import LIMIT_S

SMALL_CLASS = 4


@pytest.fixture
def store(tmp_path: Path) -> Iterator[ClassStore]:
    with ClassStore(tmp_path) as store:
        yield store


@pytest.fixture
def clock() -> Clock:
    return Clock(1000.0)


@pytest.fixture
def seats(store: ClassStore, clock: Clock, monkeypatch: pytest.MonkeyPatch) -> Seats:
    monkeypatch.setattr("ai4u_edu.classroom.seats.MAX_SEATS", SMALL_CLASS)
    return Seats(store, "box_chase", RoomRule(), clock=clock)


def join(seats: Seats, request: str, held: str = "", code: str = "") -> tuple[int, str]:
    seat, token = seats.join(code or seats.code, seats.offered_names()[0], request, held)
    return seat.number, token


def fill(seats: Seats) -> list[tuple[int, str]]:
    return [join(seats, f"flood {number}") for number in range(SMALL_CLASS)]


def test_seats_that_opened_no_room_make_room_in_a_full_class(seats: Seats, clock: Clock) -> None:
    flood = fill(seats)
    with pytest.raises(JoinError, match="full"):
        join(seats, "newcomer")  # the others may be loading their pages
    clock.now += UNOPENED_S
    number, token = join(seats, "newcomer")
    assert number == flood[-1][0] + 1
    assert seats.by_token(token) is not None
    assert seats.by_token(flood[0][1]) is None
    assert len(seats) == SMALL_CLASS


def test_a_seat_that_opened_its_room_or_has_work_keeps_its_place(
    store: ClassStore, seats: Seats, clock: Clock
) -> None:
    opened, *others = fill(seats)
    seats.note_opened(opened[0])
    for number, _ in others:
        Programs(store).save(number, "maze", "red", "x", base=0, device="d")
    clock.now += 10 * UNOPENED_S
    with pytest.raises(JoinError, match="full"):
        join(seats, "newcomer")
    assert seats.by_token(opened[1]) is not None


@pytest.mark.parametrize("state", [SeatState.KICKED, SeatState.BANNED])
def test_a_seat_that_was_sent_out_gives_its_place_back(seats: Seats, state: SeatState) -> None:
    flood = fill(seats)
    for number, _ in flood:
        seats.note_opened(number)
    seats.set_state(flood[0][0], state)
    join(seats, "newcomer")
    with pytest.raises(JoinError, match="full"):
        join(seats, "one more")


def test_a_banned_seat_comes_back_with_its_work_by_the_teachers_code(seats: Seats) -> None:
    number, token = join(seats, "student")
    seats.set_state(number, SeatState.BANNED)
    seats.set_open(False)
    own = seats.new_move_code(number)
    with pytest.raises(JoinError, match="may not join"):
        join(seats, "with a code of the seat's own", code=own)
    code = seats.new_move_code(number, is_teachers=True)
    again, new = join(seats, "another device", code=code)
    assert again == number
    assert seats.by_token(token) is None
    assert seats.by_token(new) is not None


def test_a_lost_cookie_takes_no_new_seat_with_the_teachers_code(seats: Seats) -> None:
    number, _ = join(seats, "student")
    code = seats.new_move_code(number, is_teachers=True)
    assert join(seats, "after all cookies were deleted", code=code)[0] == number
    assert len(seats) == 1


def test_a_device_whose_seat_makes_room_moves_to_another_one(seats: Seats, clock: Clock) -> None:
    banned, _ = join(seats, "student")
    seats.set_state(banned, SeatState.BANNED)
    others = fill(seats)
    clock.now += UNOPENED_S
    code = seats.new_move_code(banned, is_teachers=True)
    again, token = join(seats, "student's new device", others[0][1], code)
    assert again == banned
    assert seats.by_token(token) is not None
    assert seats.by_token(others[0][1]) is None


def test_a_seat_that_is_there_counts_as_no_new_one(seats: Seats) -> None:
    name = seats.offered_names()[0]
    with pytest.raises(NewSeatError):
        seats.join(seats.code, name, "student", may_be_new=False)
    seat, token = seats.join(seats.code, name, "student")
    again, _ = seats.join(seats.code, name, "another", token, may_be_new=False)
    assert again == seat


def test_what_is_stored_of_a_join_gives_nobody_its_seat(store: ClassStore, seats: Seats) -> None:
    join(seats, "0000-the-browsers-request-id")
    (device,) = store.tokens()
    assert "0000-the-browsers-request-id" not in device.request
    number, _ = join(seats, device.request)
    assert number == 2


@pytest.mark.slow
def test_forty_join_at_once_and_a_flood_from_the_same_address_leaves_places(
    tmp_path: Path,
) -> None:
    unlimited = {"ai4u_edu.classroom.join.NEW_SEATS_PER_S": 1e-6}
    with served_class(tmp_path, replaced=unlimited) as served:
        assert join_together(served, 40) == [200] * 40
        answers = join_together(served, MAX_SEATS)
        admitted = answers.count(200)
        # less by those who wanted a name that another one got at the same moment
        assert 0 < admitted <= join_routes.MAX_NEW_SEATS_AT_ONCE - 40
        assert answers.count(429) == MAX_SEATS - admitted
        assert len(served.state()["seats"]) == 40 + admitted


@pytest.mark.slow
def test_a_newcomer_waits_for_a_turn_after_a_flood(tmp_path: Path) -> None:
    quick = {
        "ai4u_edu.classroom.join.MAX_NEW_SEATS_AT_ONCE": 2,
        "ai4u_edu.classroom.join.NEW_SEATS_PER_S": 5.0,
        "ai4u_edu.classroom.join.MAX_NEW_SEAT_WAIT_S": LIMIT_S,
    }
    with served_class(tmp_path, replaced=quick) as served:
        assert join_together(served, 10) == [200] * 10


@pytest.mark.slow
def test_the_teacher_bans_with_a_new_code_and_gives_a_code_back(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        ada = served.joined()
        (seat,) = served.state()["seats"]
        answer = served.command("ban", seat=seat["number"], new_code=True)
        assert answer.status_code == 200, answer.text
        private_window = served.student()
        assert private_window.join().status_code == 403
        assert ada.get("healthz").status_code == 403
        code = served.command("move code", seat=seat["number"]).json()["code"]
        assert ada.join(code=code, name=seat["name"]).status_code == 200
        assert ada.get("healthz").status_code == 200
        assert served.command("move code", seat=99).status_code == 400


@pytest.mark.slow
def test_two_classes_of_a_host_keep_their_seats_in_one_browser(tmp_path: Path) -> None:
    with served_class(tmp_path / "a") as first, served_class(tmp_path / "b") as second:
        ada = first.joined()
        before = dict(ada.client.cookies)
        there = second.student()
        there.client.cookies.update(before)  # a browser sends a host's cookies to all its ports
        assert there.join().status_code == 200
        both = dict(there.client.cookies)
        assert before.items() <= both.items()
        ada.client.cookies.update(both)
        assert ada.get("healthz").status_code == 200
        assert there.get("healthz").status_code == 200


def join_together(served: ServedClass, count: int) -> list[int]:
    """Let devices join side by side; return the statuses of their answers."""
    students = [served.student() for _ in range(count)]
    with ThreadPoolExecutor(20) as pool:
        return [each.status_code for each in pool.map(_join_with_any_name, students)]


def _join_with_any_name(student: Student) -> httpx.Response:
    while (answer := student.join()).status_code == 409:  # another one has taken the name
        pass
    return answer
