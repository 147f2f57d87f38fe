"""The echo of the page that checks a device, and its limits."""

from collections.abc import Iterator

import pytest
from starlette.applications import Starlette
from starlette.routing import WebSocketRoute
from websockets.exceptions import ConnectionClosed
from websockets.sync.connection import Connection

from ai4u_edu.classroom.pages import MAX_ECHO_CHARS, MAX_ECHOES, Echo
from ai4u_edu.page.server import ServerThread
from ai4u_edu.page.server.limits.concurrency_limit import ConcurrencyLimit
from tests.page.server.rooms import PATIENT, open_socket
from tests.waiting import LIMIT_S


@pytest.fixture
def socket() -> Iterator[Connection]:
    app = Starlette(routes=[WebSocketRoute("/", Echo(ConcurrencyLimit(50, 0.2)))])
    with (
        ServerThread(app, timeouts=PATIENT) as server,
        open_socket(server.url) as socket,
    ):
        yield socket


def test_texts_come_back_a_number_of_times(socket: Connection) -> None:
    for number in range(MAX_ECHOES):
        socket.send(f"echo {number}")
        assert socket.recv(LIMIT_S) == f"echo {number}"
    with pytest.raises(ConnectionClosed):
        socket.recv(LIMIT_S)


@pytest.mark.parametrize("message", ["x" * (MAX_ECHO_CHARS + 1), b"bytes"])
def test_unexpected_echo_messages_close_the_socket(
    socket: Connection, message: str | bytes
) -> None:
    socket.send(message)
    with pytest.raises(ConnectionClosed):
        socket.recv(LIMIT_S)
