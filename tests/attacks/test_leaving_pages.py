"""Pages that leave at an odd moment, or send what is no text: no traceback, and others go on."""

import threading
from collections.abc import Iterator
from urllib.parse import urlsplit

import pytest
from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket
from websockets.exceptions import ConnectionClosed
from websockets.sync.connection import Connection
from websockets.typing import Subprotocol

from ai4u_edu.page.server import ServerThread
from ai4u_edu.page.server.limits.frames import EXTENSION
from ai4u_edu.wire.native import SUBPROTOCOL
from tests.attacks.raw_http import SOCKET_HEADERS
from tests.page.server import http_client
from tests.page.server.rooms import PATIENT, Room, open_socket, raw_request, served
from tests.waiting import LIMIT_S


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with served() as room:
        yield room


def test_a_page_that_leaves_during_its_handshake_is_no_error(
    caplog: pytest.LogCaptureFixture,
) -> None:
    over = threading.Event()

    async def app(scope: Scope, receive: Receive, send: Send) -> None:
        page = WebSocket(scope, receive, send)
        # as if the page's close came just now; the connection is lost in the loop's next turn
        scope["extensions"][EXTENSION].transport.close()
        try:
            await page.accept()
            await page.send_text("too late")
        finally:
            over.set()

    with ServerThread(app, timeouts=PATIENT) as server:
        head = [f"{name}: {value}" for name, value in SOCKET_HEADERS.items()]
        with raw_request(server.url, f"Host: {urlsplit(server.url).netloc}", *head) as connection:
            assert over.wait(LIMIT_S)
            while connection.recv(4096):
                pass
    assert not [each for each in caplog.records if each.exc_info or each.levelname == "ERROR"]


@pytest.mark.parametrize(
    ("path", "protocols"), [("ws/input", None), ("ws/remote", [Subprotocol(SUBPROTOCOL)])]
)
def test_a_text_that_is_no_utf_8_ends_its_socket_alone(
    room: Room, caplog: pytest.LogCaptureFixture, path: str, protocols: list[Subprotocol] | None
) -> None:
    with open_socket(room.url + path, subprotocols=protocols) as page:
        page.send(b"\xff\xfe", text=True)
        with pytest.raises(ConnectionClosed) as closed:
            _read_on(page)
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == 1007
    assert http_client.get(room.url + "healthz").status_code == 200
    assert not [each for each in caplog.records if each.exc_info]


def _read_on(page: Connection) -> None:
    while True:
        page.recv(LIMIT_S)
