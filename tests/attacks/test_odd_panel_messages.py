"""Odd messages to the panel's socket: they end their own connection at most."""

import json
from collections.abc import Iterator
from contextlib import suppress
from threading import Event
from typing import Any, get_args

import msgspec
import pytest
from websockets.exceptions import ConnectionClosed

from ai4u_edu.explain.page import page_option
from ai4u_edu.page.messages import MAX_NAME_CHARS
from ai4u_edu.page.panel import socket
from ai4u_edu.page.panel.socket import MAX_PENDING_COMMANDS as MAX_PENDING
from ai4u_edu.page.panel.upload import MAX_PART_BYTES
from ai4u_edu.page.server import page_receiver
from ai4u_edu.recording.episode import MAX_RECORDING_BYTES
from tests.attacks.arguments import EXPLAIN_COMMANDS, NAMES, OWN_COMMANDS
from tests.attacks.test_odd_input_messages import ODD
from tests.page.panel.rooms import PanelPage, PanelRoom, panel_room
from tests.waiting import LIMIT_S

OTHERS: tuple[str | bytes, ...] = (
    *("", " ", "{", "[]", "null", "1", "{}", '{"type": 1}', '{"type": "do"}', '{"type": "shwo"}'),
    *('{"type": "do", "id": -1, "command": "pause"}', '{"type": "do", "id": 1, "command": ["x"]}'),
    *('{"type": "show", "agent": "0", "tabs": ["agent", "agent", "agent", "agent", "agent"]}',),
    *("[" * 60_000, '{"a":' * 10_000, b"\xff\xfe", b'{"type": "\xff"}', "\0"),
)


@pytest.fixture(scope="module")
def room() -> Iterator[PanelRoom]:
    with panel_room() as room:
        yield room


@pytest.fixture
def unlimited(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page_receiver, "MAX_MISTAKES", 10**6)
    monkeypatch.setattr(socket, "MAX_PENDING_COMMANDS", 10**6)
    monkeypatch.setattr(socket, "LIMITS", socket.LIMITS._replace(messages_per_s=10**6))


def spoilt() -> Iterator[str]:
    """Every command with an odd value in each of its places."""
    for name, kind in NAMES.items():
        fields = [each.encode_name for each in msgspec.structs.fields(kind)]
        for place in fields:
            for odd in ODD:
                whole: dict[str, Any] = {each: f"%{each}%" for each in fields}
                whole |= {"command": name, "type": "do", "id": 1}
                text = json.dumps(whole | {place: "%odd%"})
                yield text.replace('"%odd%"', odd)


def test_odd_messages_are_refused_and_the_world_goes_on(room: PanelRoom, unlimited: None) -> None:
    with PanelPage(room.url + "ws/panel", max_queue=None) as page:
        for text in (*spoilt(), *OTHERS):
            page.socket.send(text)
        page._id = 10**6
        page.done("pause")
    assert not room.runner.error


def test_every_answer_is_for_the_page_that_asked(room: PanelRoom) -> None:
    with room.page() as page, room.page() as other:
        page.send({"type": "do", "id": 77, "command": "speed", "speed": "fast"})
        failed = page.receive(lambda m: m["type"] == "failed")
        assert failed["id"] == 77
        assert failed["text"].startswith("speed: ")
        other.done("pause")
        assert not [m for m in other.others if m.get("id") == 77]


def test_mistakes_in_a_row_close_the_connection(room: PanelRoom) -> None:
    with room.page() as page:
        for _ in range(page_receiver.MAX_MISTAKES):
            page.socket.send("{")
        assert page.end() == (1008, f"{page_receiver.MAX_MISTAKES} malformed messages in a row")


def test_a_flood_closes_the_connection(room: PanelRoom, monkeypatch: pytest.MonkeyPatch) -> None:
    few = socket.LIMITS._replace(messages_per_s=2)  # a busy machine sends few
    monkeypatch.setattr(socket, "LIMITS", few)
    with room.page() as page:
        with suppress(ConnectionClosed):
            for _ in range(400):
                page.show("0")
        assert page.end()[0] == 1008
    with room.page() as page:
        page.done("pause")


def test_a_large_message_closes_the_connection(room: PanelRoom) -> None:
    with room.page() as page:
        page.socket.send(" " * (socket.LIMITS.message_bytes + 1))
        assert page.end()[0] == 1009


def test_a_large_part_of_a_file_closes_the_connection(room: PanelRoom) -> None:
    with room.page() as page:
        page.socket.send(bytes(MAX_PART_BYTES + 1))
        assert page.end()[0] == 1009


def test_a_file_that_never_ends_is_dropped(room: PanelRoom) -> None:
    with room.page() as page:
        for _ in range(MAX_RECORDING_BYTES // MAX_PART_BYTES + 1):
            page.socket.send(bytes(MAX_PART_BYTES))
        note = page.receive(lambda m: m["type"] == "note")
        assert note["text"] == "expected a file of at most 16 MB"
        assert "got 0" in page.failed("open_recording", name="x", size=MAX_RECORDING_BYTES)["text"]


def test_commands_that_wait_are_bounded(room: PanelRoom) -> None:
    may_go_on = Event()
    room.runner.submit(lambda: may_go_on.wait(LIMIT_S))  # so that all commands wait
    with room.page() as page:
        for number in range(60):
            page.send({"type": "do", "id": number, "command": "decision"})
        refused = [page.receive(lambda m: m["type"] == "failed") for _ in range(60 - MAX_PENDING)]
        may_go_on.set()
        for _ in range(MAX_PENDING):
            page.receive(lambda m: m["type"] == "done")
    assert all("expected fewer commands" in each["text"] for each in refused)


def test_names_are_bounded(room: PanelRoom) -> None:
    name: Any = "x" * (MAX_NAME_CHARS + 1)
    with room.page() as page:
        assert "length <=" in page.failed("sensor", key=name, on=True)["text"]


def test_each_command_has_a_handler(room: PanelRoom) -> None:
    assert set(socket.HANDLERS) == set(OWN_COMMANDS)
    option = page_option(room.runner, room.context.player)
    assert set(option.commands) == set(EXPLAIN_COMMANDS)
    assert all(get_args(kind) == () for kind in NAMES.values())
