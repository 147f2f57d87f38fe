"""Invalid frames: the answer states what was expected; large ones and floods close the socket."""

import asyncio
import json
import re
from contextlib import suppress
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from starlette.types import Receive, Scope, Send
from uvicorn.protocols.utils import ClientDisconnected
from uvicorn.server import ServerState
from websockets.exceptions import ConnectionClosed
from websockets.protocol import State

from ai4u_edu.page.server import ServerThread, messages
from ai4u_edu.page.server import input as input_socket
from ai4u_edu.page.server.input import MAX_MESSAGE_BYTES, MAX_MESSAGES_PER_S
from ai4u_edu.page.server.limits.frames import FramesProtocol
from ai4u_edu.page.server.limits.requests import ServerConfig
from ai4u_edu.page.server.page_receiver import MAX_MISTAKES
from ai4u_edu.page.server.serve import MAX_MESSAGE_BYTES as MAX_FRAME_BYTES
from tests.page.server.rooms import PATIENT, open_socket, served
from tests.waiting import until

MALFORMED = [
    ("", "expected JSON, got ''"),
    ("W", "expected JSON, got 'W'"),
    ("[]", "expected"),
    ("null", "expected"),
    ('{"held": []}', "needs a 'type'"),
    ('{"type": "kyes", "held": []}', "unknown type 'kyes'; did you mean 'keys'?"),
    ('{"type": "keys"}', "held: is missing"),
    ('{"type": "keys", "held": "KeyW"}', "held: expected a list, got 'KeyW'"),
    ('{"type": "keys", "held": [1]}', "held[0]: expected text, got 1"),
    ('{"type": "keys", "held": ["Key W"]}', "Key W"),
    ('{"type": "keys", "held": [""]}', "got ''"),
    ('{"type": "keys", "held": ["' + "W" * 25 + '"]}', "WWW"),
    (json.dumps({"type": "keys", "held": ["KeyW"] * 17}), "at most 16 entries"),
    ('{"type": "keys", "held": [], "extra": 1}', "known are 'held', 'stick', 'type'"),
    ('{"type": "keys", "held": [], "stick": {"turn": 2}}', "stick.turn: expected at most 1"),
    ('{"type": "keys", "held": [], "stick": {"forward": NaN}}', "stick.forward"),
    ('{"type": "take", "by": "force"}', "unknown parameter"),
    ('{"type": "command", "name": "explode"}', "expected 'reset', 'try_again', 'new_start'"),
    ('{"type": "command", "name": "reset", "seed": -1}', "seed: expected at least 0, got -1"),
    ('{"type": "command", "name": "reset", "seed": 1.5}', "expected a whole number, got 1.5"),
    ('{"type": "command", "name": "reset", "seed": NaN}', "expected"),
    ('{"type": "command", "name": "reset", "seed": ' + "9" * 30 + "}", "less than"),
]


@pytest.mark.parametrize(("text", "explained"), MALFORMED)
def test_a_malformed_message_is_explained(text: str, explained: str) -> None:
    with pytest.raises(ValueError, match=re.escape(explained)):
        messages.read(text)


@given(st.text() | st.binary())
def test_whatever_comes_is_a_message_or_a_value_error(said: str | bytes) -> None:
    with suppress(ValueError):
        messages.read(said)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
)


NEARLY = st.fixed_dictionaries(
    {"type": st.sampled_from(["keys", "take", "let_go", "command"]) | JSON},
    optional={
        "held": st.lists(st.from_regex(messages.CODE, fullmatch=True) | JSON) | JSON,
        "name": st.sampled_from(["reset", "pause"]) | JSON,
        "seed": st.integers(min_value=0) | JSON,
        "stick": st.fixed_dictionaries({"forward": st.floats(-1, 1), "turn": st.floats(-1, 1)}),
    },
)


@pytest.mark.slow
@given(NEARLY)
def test_what_is_read_is_what_was_said(said: dict[str, Any]) -> None:
    with suppress(ValueError):
        read = messages.read(json.dumps(said))
        assert said == read.model_dump(exclude_unset=True)


def test_a_message_of_bytes_is_read_like_text() -> None:
    with served() as room, room.page() as page:
        page.socket.send(b'{"type": "keys", "held": ["KeyW"]}')
        until(lambda: room.held == ["KeyW"])


def test_single_mistakes_are_forgiven_but_not_five_in_a_row() -> None:
    with served() as room, room.page() as page:
        for _ in range(MAX_MISTAKES - 1):
            page.send("kyes")
            assert page.receive("error")["text"] == "unknown type 'kyes'; did you mean 'keys'?"
        page.hold("KeyW")
        until(lambda: room.held == ["KeyW"])
        for _ in range(MAX_MISTAKES):
            page.send("kyes")
        assert page.end() == (1008, "5 malformed messages in a row")
        until(lambda: room.held == [])


def test_a_message_that_is_too_large_ends_the_connection() -> None:
    with served() as room, room.page() as page:
        page.socket.send("x" * (MAX_MESSAGE_BYTES + 1))
        assert page.receive("error")["text"] == "expected at most 4096 bytes, got 4097"
        code, reason = page.end()
        assert code == 1009
        assert "4096" in reason


def test_the_largest_message_of_keys_fits() -> None:
    text = json.dumps({"type": "keys", "held": ["A" * 24] * 16})
    assert len(text) < MAX_MESSAGE_BYTES
    assert messages.read(text) == messages.Keys(type="keys", held=["A" * 24] * 16)


def test_a_flood_ends_the_connection_and_leaves_others_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(input_socket, "MAX_MESSAGES_PER_S", 2)  # a busy machine sends few
    with served() as room, room.page() as driver, room.page() as flooder:
        driver.hold("KeyW")
        with suppress(ConnectionClosed):
            for _ in range(400):
                flooder.socket.send('{"type": "keys", "held": []}')
        assert flooder.end() == (1008, "expected at most 2 messages a second")
        driver.hold("KeyD")
        until(lambda: room.held == ["KeyD"])


def test_a_busy_driver_is_no_flood() -> None:
    with served() as room, room.page() as page:
        for index in range(MAX_MESSAGES_PER_S - 20):
            page.hold("KeyW") if index % 2 else page.hold("KeyA")
        page.hold("KeyS")
        until(lambda: room.held == ["KeyS"])


class Transport:
    """The end of a connection that has not taken yet what was written."""

    is_closed = False

    def is_closing(self) -> bool:
        return self.is_closed

    def write(self, data: bytes) -> None:
        pass

    def close(self) -> None:
        self.is_closed = True


def connected(state: State) -> FramesProtocol:
    """Return the protocol of a page whose handshake is over; needs an event loop."""
    protocol = FramesProtocol(
        ServerConfig(lambda: None, ws="none", lifespan="off"), ServerState(), {}
    )
    transport: Any = Transport()
    protocol.transport, protocol.handshake_complete = transport, True
    protocol.conn.state = state
    return protocol


def test_a_server_ends_while_a_page_is_leaving() -> None:
    async def end() -> bool:
        protocol = connected(State.CLOSING)
        protocol.shutdown()
        return protocol.transport.is_closing()

    assert asyncio.run(end())


def test_an_app_hears_that_the_page_has_left_once_the_protocol_closed() -> None:
    raised: list[type[BaseException]] = []

    async def app(scope: Scope, receive: Receive, send: Send) -> None:
        await receive()
        await send({"type": "websocket.accept"})
        while (await receive())["type"] != "websocket.disconnect":
            pass
        try:
            await send({"type": "websocket.send", "text": "too late"})
        except Exception as error:
            raised.append(type(error))

    with (
        ServerThread(app, timeouts=PATIENT) as server,
        open_socket(server.url) as page,
    ):
        page.send("x" * (MAX_FRAME_BYTES + 1))
        until(lambda: raised)
    assert issubclass(raised[0], OSError)


def test_an_app_hears_that_a_page_has_left_that_answers_no_ping() -> None:
    async def send() -> None:
        protocol = connected(State.OPEN)
        protocol.keepalive_timeout()
        await protocol.send({"type": "websocket.send", "text": "too late"})

    with pytest.raises(ClientDisconnected):
        asyncio.run(send())
