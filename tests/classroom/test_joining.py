"""Joining of a class by a program."""

import stat
from collections.abc import Iterator
from pathlib import Path

import pytest

from ai4u_edu.member import NotJoinedError, SeatFile, UnreachableError, join
from ai4u_edu.member.joining import ANSWER_TIMEOUT_S, class_address, is_seat_valid
from ai4u_edu.page.server.limits.attempts import MAX_CODE_WAIT_S
from tests.classroom.reserved_port import reserved_port
from tests.classroom.served_class import CODE, ServedClass, served_class
from tests.page.server import http_client
from tests.page.server.rooms import served


@pytest.fixture(scope="module")
def there(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as there:
        yield there


def _seats(there: ServedClass) -> dict[str, int]:
    return {each["name"]: each["number"] for each in there.state()["seats"]}


def test_a_program_gets_a_seat_with_a_name_and_a_colour(there: ServedClass) -> None:
    seat = join(there.url, CODE.lower())
    assert seat.url == there.url
    assert seat.name in _seats(there)
    assert seat.colour.startswith("#")
    assert is_seat_valid(seat)


def test_the_same_request_and_the_same_program_get_the_same_seat(there: ServedClass) -> None:
    first = join(there.url, CODE, request="a-request-of-this-test")
    again = join(there.url, CODE, request="a-request-of-this-test")
    held = join(there.url, CODE, 2, held=again.token)
    assert first.name == again.name == held.name
    assert is_seat_valid(held)


def test_a_name_that_is_taken_meanwhile_is_left_to_the_other(
    there: ServedClass, monkeypatch: pytest.MonkeyPatch
) -> None:
    taken = join(there.url, CODE).name
    (free, *_) = http_client.get(f"{there.url}api/names").json()["names"]
    names = iter([[taken], [taken, free]])
    monkeypatch.setattr("ai4u_edu.member.joining._names", lambda client: next(names))
    assert join(there.url, CODE).name == free


def test_a_seat_file_gives_the_same_seat_and_tells_nothing_else(
    there: ServedClass, tmp_path: Path
) -> None:
    file = SeatFile(tmp_path / "new" / "class.json")
    seat = file.take(there.url.removeprefix("http://"), CODE, 3)
    count = len(_seats(there))
    assert SeatFile(file.path).take(there.url, "forgotten") == seat
    assert len(_seats(there)) == count
    assert CODE not in file.path.read_text(encoding="utf-8")
    assert stat.S_IMODE(file.path.stat().st_mode) == 0o600

    there.command("kick", seat=_seats(there)[seat.name])
    assert not is_seat_valid(seat)
    back = file.take(there.url, CODE)
    assert (back.name, back.token != seat.token) == (seat.name, True)
    assert file.folder(back) != file.folder(seat)

    file.path.write_text('{"seats": [{"url": 3}]}', encoding="utf-8")
    assert file.take(there.url, CODE).token


def test_mistakes_are_sentences(there: ServedClass) -> None:
    with pytest.raises(NotJoinedError, match=r"This code is not right. Look at the board again."):
        join(there.url, "WRONG")
    there.command("close")
    with pytest.raises(NotJoinedError, match="Nobody else can join at present"):
        join(there.url, CODE)
    there.command("open")
    with pytest.raises(NotJoinedError, match="name choice: expected a number from 1 on, got 0"):
        join(there.url, CODE, 0)
    for text in ("", "ftp://teacher", "http://", "http://[", "teacher:port", "http://a b"):
        with pytest.raises(NotJoinedError, match="expected the address of the class"):
            join(text, CODE)


def test_an_address_without_a_class_is_told_from_one_without_a_server(tmp_path: Path) -> None:
    with reserved_port() as port:
        nowhere = f"http://127.0.0.1:{port}"
        with pytest.raises(UnreachableError, match=r"can't be reached \(.+Is the address right"):
            join(nowhere, CODE)
        with pytest.raises(UnreachableError):
            SeatFile(tmp_path / "class.json").take(nowhere, CODE)
    with served() as room, pytest.raises(NotJoinedError, match=r"There is no class at .*404"):
        join(room.url, CODE)


def test_an_unreachable_class_leaves_a_program_its_seat(
    there: ServedClass, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = SeatFile(tmp_path / "class.json")
    seat = file.take(there.url, CODE)

    def unreachable(seat: object) -> bool:
        raise UnreachableError("gone")

    monkeypatch.setattr("ai4u_edu.member.joining.is_seat_valid", unreachable)
    assert file.take(there.url, CODE) == seat


def test_an_address_may_be_copied_from_the_page() -> None:
    assert class_address(" http://teacher:8080/r/a1b2 ") == "http://teacher:8080/"
    assert class_address("https://hub/services/class/?code=KVBTM") == "https://hub/services/class/"


def test_a_program_waits_longer_for_an_answer_than_the_class_lets_its_code_wait() -> None:
    assert ANSWER_TIMEOUT_S > MAX_CODE_WAIT_S
