"""Invalid frames: the answer states what was expected; large ones and floods close the socket."""

import asyncio
import json
import re
from contextlib import suppress
from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from starlette.types import Receive, Scope, Send
from uvicorn.protocols.utils import ClientDisconnected
from uvicorn.server import ServerState
from websockets.exceptions import ConnectionClosed
from websockets.protocol import State

from ai4u_edu.page.server import ServerThread
from ai4u_edu.page.server import input as input_socket
from ai4u_edu.page.server.input import MAX_MESSAGE_BYTES, MAX_MESSAGES_PER_S
from ai4u_edu.page.server.input_messages import CODE, INPUT_READER, Keys
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
    ('{"held": []}', "missing required field type"),
    ('{"type": "kyes", "held": []}', "unknown type 'kyes'; did you mean 'keys'?"),
    ('{"type": "keys"}', "missing required field held"),
    ('{"type": "keys", "held": "KeyW"}', "held: expected array, got str"),
    ('{"type": "keys", "held": [1]}', "held[0]: expected str, got int"),
    ('{"type": "keys", "held": ["Key W"]}', "held[0]: expected str matching"),
    ('{"type": "keys", "held": [""]}', "held[0]: expected str matching"),
    ('{"type": "keys", "held": ["' + "W" * 25 + '"]}', "held[0]: expected str matching"),
    (json.dumps({"type": "keys", "held": ["KeyW"] * 17}), "held: expected array of length <= 16"),
    ('{"type": "keys", "held": [], "extra": 1}', "contains unknown field extra"),
    ('{"type": "keys", "held": [], "stick": {"turn": 2}}', "stick.turn: expected float <= 1"),
    ('{"type": "keys", "held": [], "stick": {"forward": NaN}}', "expected JSON"),
    ('{"type": "take", "by": "force"}', "contains unknown field by"),
    ('{"type": "do", "id": 0, "command": "explode"}', "no command is called 'explode'; known are"),
    ('{"type": "do", "command": "pause"}', "missing required field id"),
    ('{"type": "do", "id": 0, "command": "tick"}', "no command is called 'tick'"),
    ('{"type": "do", "id": 0, "command": "seed", "seed": "-1"}', "seed: expected str matching"),
    ('{"type": "do", "id": 0, "command": "seed", "seed": 7}', "seed: expected str, got int"),
]


@pytest.mark.parametrize(("text", "explained"), MALFORMED)
def test_a_malformed_message_is_explained(text: str, explained: str) -> None:
    with pytest.raises(ValueError, match=re.escape(explained)):
        INPUT_READER.read(text)


@given(st.text() | st.binary())
def test_any_input_frame_is_read_or_raises_value_error(said: str | bytes) -> None:
    with suppress(ValueError):
        INPUT_READER.read(said)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
)


NEARLY = st.fixed_dictionaries(
    {"type": st.sampled_from(["keys", "take", "let_go", "do"]) | JSON},
    optional={
        "held": st.lists(st.from_regex(CODE, fullmatch=True) | JSON) | JSON,
        "id": st.integers(min_value=0) | JSON,
        "command": st.sampled_from(["reset", "pause", "seed"]) | JSON,
        "seed": st.from_regex(r"[0-9]{1,40}", fullmatch=True) | JSON,
        "stick": st.fixed_dictionaries({"forward": st.floats(-1, 1), "turn": st.floats(-1, 1)}),
    },
)


@pytest.mark.slow
@given(NEARLY)
def test_fields_of_an_input_frame_keep_their_values(said: dict[str, Any]) -> None:
    with suppress(ValueError):
        read = msgspec.to_builtins(INPUT_READER.read(json.dumps(said)))
        assert said == {key: read[key] for key in said}


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
    assert INPUT_READER.read(text) == Keys(held=["A" * 24] * 16)


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
