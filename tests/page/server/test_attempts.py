"""Rate limit of wrong tokens; a client with the right token is not locked out."""

import asyncio
from collections.abc import Iterator

import pytest
from websockets.exceptions import InvalidStatus

from ai4u_edu.page.server import Rules
from ai4u_edu.page.server.limits import attempts
from ai4u_edu.page.server.limits.attempts import (
    MAX_WAITING,
    MAX_WRONG,
    AttemptResult,
    Attempts,
)
from ai4u_edu.page.server.limits.rate_limit import MAX_KEYS
from ai4u_edu.wire import native
from tests.page.server import http_client
from tests.page.server.rooms import Page, Room, served

TOKEN = "sesame sesame"


class Time:
    """A clock, and who sleeps by it."""

    def __init__(self) -> None:
        self.now = 0.0
        self.slept: list[float] = []

    def clock(self) -> float:
        return self.now

    async def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        await asyncio.sleep(0)


@pytest.fixture
def time() -> Time:
    return Time()


@pytest.fixture
def tries(time: Time) -> Attempts:
    return Attempts(time.clock, time.sleep)


def look(tries: Attempts, address: str, token: str) -> AttemptResult:
    return asyncio.run(tries.check(address, lambda: token == TOKEN))


def flood(tries: Attempts, address: str, count: int = MAX_WRONG) -> list[AttemptResult]:
    async def guess() -> list[AttemptResult]:
        return [await tries.check(address, lambda: False) for _ in range(count)]

    return asyncio.run(guess())


def test_too_many_wrong_ones_wait_and_the_right_one_gets_in(tries: Attempts, time: Time) -> None:
    assert set(flood(tries, "a")) == {AttemptResult.WRONG}
    assert time.slept == []
    assert look(tries, "a", "guess") is AttemptResult.TOO_MANY
    assert tries.retry_after("a") == 2
    assert time.slept == [attempts.DELAY_S]
    assert look(tries, "b", TOKEN) is AttemptResult.RIGHT
    assert look(tries, "a", TOKEN) is AttemptResult.RIGHT  # after the same while as a wrong one
    assert len(time.slept) == 2
    assert look(tries, "a", TOKEN) is AttemptResult.RIGHT
    assert len(time.slept) == 2, "its address is known now"
    assert look(tries, "a", "guess") is AttemptResult.TOO_MANY


def test_wrong_ones_are_forgotten(tries: Attempts, time: Time) -> None:
    flood(tries, "a", 1000)
    time.now += 11
    assert tries.retry_after("a") == 0
    assert look(tries, "a", "guess") is AttemptResult.WRONG


def test_of_many_at_once_most_are_not_even_looked_at(tries: Attempts) -> None:
    flood(tries, "a")
    looked = 0

    def is_right() -> bool:
        nonlocal looked
        looked += 1
        return False

    async def all_at_once() -> list[AttemptResult]:
        return await asyncio.gather(*[tries.check("a", is_right) for _ in range(500)])

    assert set(asyncio.run(all_at_once())) == {AttemptResult.TOO_MANY}
    assert looked == MAX_WAITING


def test_memory_is_bounded(tries: Attempts) -> None:
    async def come() -> None:
        for number in range(3 * MAX_KEYS):
            await tries.check(str(number), lambda: False)
            await tries.check(str(number), lambda: True)

    asyncio.run(come())
    assert len(tries._wrong) == len(tries._known) == MAX_KEYS
    assert tries._waiting == {}


@pytest.fixture
def room(monkeypatch: pytest.MonkeyPatch) -> Iterator[Room]:
    monkeypatch.setattr(attempts, "MAX_WRONG", 3)
    monkeypatch.setattr(attempts, "FORGOTTEN_PER_S", 0.001)
    monkeypatch.setattr(attempts, "DELAY_S", 0.01)
    with served(rules=Rules(token=TOKEN)) as room:
        yield room


@pytest.mark.parametrize(
    "guess",
    [
        {"params": {"token": "guess"}},
        {"headers": {"Authorization": "Bearer guess"}},
        {"headers": {"Cookie": "{cookie}=guess"}},
    ],
)
def test_guesses_get_429_on_every_way_in(room: Room, guess: dict[str, dict[str, str]]) -> None:
    (cookie,) = http_client.get(room.url, params={"token": TOKEN}).cookies
    given = {
        kind: {name: value.format(cookie=cookie) for name, value in values.items()}
        for kind, values in guess.items()
    }
    paths = ("", "healthz", "api/past/1.gif", "web/page/main.js")
    for path in paths[:3]:
        assert http_client.get(room.url + path, **given).status_code == 401  # type: ignore[arg-type]
    for path in paths:
        answer = http_client.get(room.url + path, **given)  # type: ignore[arg-type]
        assert answer.status_code == 429
        assert answer.text.startswith("token: too many wrong tokens from this address; try again")
        assert int(answer.headers["Retry-After"]) > 0
    assert http_client.get(room.url + "healthz", params={"token": TOKEN}).status_code == 200
    assert http_client.get(room.url + "healthz").status_code == 401, (
        "who says nothing, guesses nothing"
    )


def test_a_page_is_told_to_come_again_later(room: Room) -> None:
    for code in (1008, 1008, 1008, 1013):
        with Page(room.url + "ws/input?token=guess") as page:
            assert page.end()[0] == code
    with Page(room.url + "ws/input?token=sesame%20sesame") as page:
        page.receive("hello")


def test_scripts_that_guess_are_slowed_down_too(
    room: Room, monkeypatch: pytest.MonkeyPatch
) -> None:
    guess = native.encode(native.Hello(native.VERSION, "", "guess", "lockstep", (), "", "x" * 16))
    for _ in range(3):
        with _script(room) as script:
            script.socket.send(guess)
            assert script.end()[0] == native.PROBLEMS["bad_token"]
    monkeypatch.setattr(attempts, "MAX_WAITING", 0)
    with pytest.raises(InvalidStatus, match="429"):
        _script(room)
    monkeypatch.undo()
    assert http_client.get(room.url, params={"token": TOKEN}).status_code in (200, 303)
    with _script(room):
        pass


def _script(room: Room) -> Page:
    return Page(room.url + "ws/remote", subprotocols=[native.SUBPROTOCOL])
