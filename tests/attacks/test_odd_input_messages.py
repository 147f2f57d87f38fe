"""Odd messages to the input socket: they end their own connection at most."""

import json
import logging
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed

from ai4u_edu.page.server import input as input_socket
from ai4u_edu.page.server import page_receiver
from ai4u_edu.page.server.input_messages import INPUT_READER, Keys
from ai4u_edu.page.server.run_commands import SetSeed
from tests.builders import small_sim
from tests.page.server.rooms import Page, Room, served
from tests.waiting import LIMIT_S, until

ODD = (
    *("NaN", "Infinity", "-Infinity", "1e400", "-1e400", "1e20", "18446744073709551616", "-1"),
    *("0.5", "null", "true", "false", '""', '"KeyW\\n"', '"\\ud800"', '"\\u0000"', '"Infinity"'),
    *("[]", "[null]", "[[]]", "{}", '{"forward": 0}', '{"__class__": 1}'),
    *('"' + "x" * 2000 + '"', "[" * 1900 + "]" * 1900, "9" * 2000, "[" + "1," * 900 + "1]"),
)
"""Values, as JSON or nearly so."""

MESSAGES: dict[str, dict[str, Any]] = {
    "keys": {"held": ["KeyW"], "stick": {"forward": 0.5, "turn": 0.5}},
    "take": {},
    "let_go": {},
    "do": {"id": 0, "command": "seed", "seed": "7"},
}

OTHERS: tuple[str | bytes, ...] = (
    *("", " ", "{", "[]", "null", "1", "{}", '{"type": 1}', '{"type": null}', '{"type": "kyes"}'),
    *('{"type": "keys"}', '{"type": "keys", "held": ["KeyW"], "more": 1}', "\0", "\x7f" * 100),
    *('{"type": ["keys"]}', '{"type": {"keys": 1}}', '{"type": "take", "type": "nobody"}'),
    *(b"\xff\xfe", b"\x00" * 50, b'{"type": "\xff"}', b'{"type": "take\xed\xa0\x80"}', b""),
)


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with served() as room:
        room.runner.pause().result(LIMIT_S)
        yield room


@pytest.fixture(autouse=True)
def unlimited(monkeypatch: pytest.MonkeyPatch) -> None:
    """Mistakes don't end the connection, nor does their number, so that all are listened to."""
    monkeypatch.setattr(page_receiver, "MAX_MISTAKES", 10**6)
    monkeypatch.setattr(input_socket, "MAX_MESSAGES_PER_S", 10**6)


def opened(room: Room) -> Page:
    """A page that takes what it is told, whether it reads it or not."""
    return Page(room.url + "ws/input", max_queue=None)


def spoilt() -> Iterator[str]:
    """Every message with an odd value in each of its places."""
    for kind, fields in MESSAGES.items():
        places = ["type", *fields, *(f"stick.{name}" for name in fields.get("stick", ())), "more"]
        for place in places:
            for value in ODD:
                message: dict[str, Any] = {"type": kind, **fields}
                inner, _, name = place.rpartition(".")
                if inner:
                    message[inner] = {**message[inner], name: "HERE"}
                else:
                    message[name] = "HERE"
                yield json.dumps(message).replace('"HERE"', value)


def harmless(text: str | bytes) -> bool:
    """Return True if a message is none, or one that a page may say."""
    try:
        said = INPUT_READER.read(text)
    except ValueError as error:
        return 0 < len(str(error)) < 10_000
    if isinstance(said, Keys):
        pushed = said.stick.forward, said.stick.turn
        return all(-1 <= each <= 1 for each in pushed) and len(said.held) <= 16
    return not isinstance(said, SetSeed) or 0 <= int(said.seed) < 10**40


def test_whatever_stands_in_a_field_is_in_range_or_refused() -> None:
    said: list[str | bytes] = [*spoilt(), *OTHERS]
    assert len(said) > 250
    assert [each for each in said if not harmless(each)] == []


def test_odd_messages_leave_the_room_as_it_was(
    room: Room, caplog: pytest.LogCaptureFixture
) -> None:
    runner = room.runner
    seed = runner.latest.seed
    with opened(room) as other, opened(room) as here:
        with other.holding("KeyD"):  # else the page would be forgotten, and the other one drive
            until(lambda: room.held == ["KeyD"])
            messages_said: list[str | bytes] = [*spoilt(), *OTHERS]
            for message in messages_said:
                here.socket.send(message)
            here.do("nobody")
            while "nobody" not in str(here.receive("error")):
                pass
        with other.holding("KeyA"):
            until(lambda: room.held == ["KeyA"])
        other.send("take")
        other.do("resume")
        until(lambda: not runner.latest.paused)
        other.do("pause")
        until(lambda: runner.latest.paused)
    assert runner.latest.seed == seed
    assert [each for each in caplog.records if each.levelno >= logging.WARNING] == []


@pytest.mark.parametrize("agent", ["%00", "%ed%a0%80", "x" * 4000, "%0d%0aSet-Cookie:%20x", "0%00"])
def test_an_odd_agent_is_refused(room: Room, agent: str, caplog: pytest.LogCaptureFixture) -> None:
    with room.page(f"?agent={agent}") as page:
        assert page.end() == (1008, "there is no such agent")
    assert caplog.records == []


@pytest.mark.parametrize("size", [5000, 2 * 2**20])
def test_a_large_message_ends_its_connection_alone(
    room: Room, size: int, caplog: pytest.LogCaptureFixture
) -> None:
    with opened(room) as other:
        for message in ("x" * size, b"x" * size, "ä" * size):
            with opened(room) as page:
                with suppress(ConnectionClosed):  # of a large one not even all is read
                    page.socket.send(message)
                assert page.end()[0] in (1009, 1006)
        other.hold("KeyA")
        until(lambda: room.held == ["KeyA"])
    assert [each for each in caplog.records if each.name != "websockets.client"] == []


def test_junk_and_floods_end_their_connection_alone(
    room: Room, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(page_receiver, "MAX_MISTAKES", 5)
    monkeypatch.setattr(input_socket, "MAX_MESSAGES_PER_S", 2)  # a busy machine sends few
    with opened(room) as other:
        for message in ("junk", '{"type": "take"}', '{"type": "let_go"}', b"\xff"):
            with opened(room) as page:
                with suppress(ConnectionClosed):
                    for _ in range(1000):
                        page.socket.send(message)
                assert page.end()[0] in (1008, 1006)
        other.hold("KeyA")
        until(lambda: room.held == ["KeyA"])
    assert [each for each in caplog.records if each.name != "websockets.client"] == []


def test_a_page_that_floods_a_world_that_goes_is_sent_away_once(
    caplog: pytest.LogCaptureFixture,
) -> None:
    """The world is another one while too much is said: there is one close, and no more."""
    with served() as room:
        pages = [opened(room) for _ in range(8)]
        for page in pages:
            page.receive("hello")
        room.runner.replace_sim(small_sim())
        for page in pages:
            with page:
                with suppress(ConnectionClosed):
                    for _ in range(1000):
                        page.send("take")
                assert page.end()[0] in (1008, 1012, 1006)
    names = [each.name for each in caplog.records if each.exc_info]
    assert "uvicorn.error" not in names
