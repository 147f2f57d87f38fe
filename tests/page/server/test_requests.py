"""Time limits and sizes of requests."""

import asyncio
import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace

import psutil
import pytest
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Receive, Scope, Send

from ai4u_edu.page.server import ServerThread, Timeouts
from tests.page.server import http_client
from tests.page.server.rooms import PATIENT, UPGRADE, Room, connected, served
from tests.waiting import Deadline, until

QUICK = replace(PATIENT, request=0.2)
"""Time limits of which that of requests is over soon."""


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with served() as room:
        yield room


@contextmanager
def said_to(said: bytes, timeouts: Timeouts, app: ASGIApp) -> Iterator[socket.socket]:
    """Connect with a server and send something before the server accepts the connection.

    So the server has it in the first turn of its loop, before any time limit has passed, however
    long this thread stands still.
    """
    server = ServerThread(app, timeouts=timeouts)
    with connected(server.url) as connection:
        connection.sendall(said)
        with server:
            yield connection


async def fine(scope: Scope, receive: Receive, send: Send) -> None:
    await PlainTextResponse("fine")(scope, receive, send)


def heard(connection: socket.socket) -> bytes:
    """All that comes until the other side closes."""
    said = b""
    with suppress(ConnectionResetError):
        while part := connection.recv(65536):
            said += part
    return said


def test_a_connection_that_says_nothing_ends() -> None:
    with said_to(b"", QUICK, fine) as connection:
        assert heard(connection) == b""


@pytest.mark.parametrize(
    "said",
    [
        b"GE",
        b"GET / HTTP/1.1\r\nHost: localhost\r\n",
        b"GET / HTTP/1.1\r\nHost: localhost\r\nX: ",
    ],
)
def test_half_a_head_is_answered_with_408(said: bytes) -> None:
    with said_to(said, QUICK, fine) as connection:
        answer = heard(connection).decode()
    assert answer.startswith("HTTP/1.1 408 Request Timeout\r\n")
    assert answer.endswith("expected the whole request within 0.2 s\n")


def test_a_byte_now_and_then_does_not_prolong_it() -> None:
    head = b"GET / HTTP/1.1\r\nHost: localhost\r\nX: "
    with said_to(head, QUICK, fine) as connection:
        # real time: pause between two bytes; after a longer one the limit is reached all the same
        connection.settimeout(0.02)
        answer, deadline = b"", Deadline()
        while not answer and deadline.left():
            connection.sendall(b"x")
            with suppress(TimeoutError):
                answer = connection.recv(1000)
        assert answer.startswith(b"HTTP/1.1 408 ")


def test_a_slow_body_ends_after_its_answer() -> None:
    said = b"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 999999\r\n\r\nx"
    with said_to(said, QUICK, fine) as connection:
        # real time: pause between two bytes; after a longer one the limit is reached all the same
        connection.settimeout(0.02)
        answer, deadline = b"", Deadline()
        with suppress(ConnectionError):  # it is aborted
            while deadline.left():
                with suppress(TimeoutError):
                    part = connection.recv(1000)
                    answer += part
                    if not part:
                        break
                connection.sendall(b"x")
        assert answer.startswith(b"HTTP/1.1 200 OK\r\n")


ASK = b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"


@pytest.mark.parametrize("rest", [b"", b"GE"])
def test_a_connection_that_is_kept_ends_when_nothing_more_is_asked(rest: bytes) -> None:
    with said_to(3 * ASK + rest, QUICK, fine) as connection:
        answers = heard(connection)
    assert answers.count(b"HTTP/1.1 200 OK\r\n") == 3
    assert answers.count(b"HTTP/1.1 408 ") == bool(rest)


def test_a_connection_is_kept_for_the_next_request(room: Room) -> None:
    with connected(room.url) as connection:
        for _ in range(3):
            connection.sendall(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n")
            answer = b""
            while not answer.endswith(b"}"):
                part = connection.recv(65536)
                assert part, answer
                answer += part
            assert answer.startswith(b"HTTP/1.1 200 OK\r\n")


def test_a_reader_that_takes_nothing_is_given_up() -> None:
    ask = b"GET /api/openapi.json HTTP/1.1\r\nHost: localhost\r\n\r\n"
    with (
        served(timeouts=replace(PATIENT, stall=0.1)) as room,
        connected(room.url, receive_buffer=4096) as connection,
    ):
        connection.sendall(ask)
        assert connection.recv(1) == b"H"  # else the server may not have its end yet
        # real time: pause between two looks at what has to come some time
        connection.settimeout(0.05)
        unsent = ask * 100

        def ended() -> bool:
            """Return True if the server closed its end, of which the client may learn later."""
            nonlocal unsent
            with suppress(OSError):
                unsent = unsent[connection.send(unsent) :] or ask * 100
            ends = psutil.Process().net_connections("tcp")
            return all(end.raddr != connection.getsockname() for end in ends)

        until(ended)


@pytest.mark.parametrize(
    "said",
    [
        b"GET /" + b"x" * 100_000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n",
        b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + b"x" * 2_000_000,
        b"GET / HTTP/1.1\r\nHost: localhost\r\n" + b"X: x\r\n" * 20_000 + b"\r\n",
        b"GET /?" + b"a=b&" * 20_000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n",
        b"GET / HTTP/1.1\r\nHost: localhost\r\nCookie: " + b"a=b; " * 20_000 + b"\r\n\r\n",
    ],
)
def test_a_head_that_is_too_large_is_refused(room: Room, said: bytes) -> None:
    with connected(room.url) as connection:
        with suppress(ConnectionError):
            connection.sendall(said)
        answer = heard(connection)
    assert answer.startswith(b"HTTP/1.1 431 ")
    assert b"expected" in answer
    assert http_client.get(room.url + "healthz").status_code == 200


@pytest.mark.parametrize(
    "lines",
    [
        [b"Cookie: " + b"x" * 9000],
        [b"Origin: http://" + b"x" * 10_000],
        [b"X-%d: x" % number for number in range(200)],
    ],
)
@pytest.mark.parametrize("path", [b"/", b"/ws/input", b"/ws/remote"])
def test_a_handshake_that_is_too_large_is_refused(
    room: Room, path: bytes, lines: list[bytes]
) -> None:
    head = [b"GET " + path + b" HTTP/1.1", b"Host: localhost", *map(str.encode, UPGRADE), *lines]
    with connected(room.url) as connection:
        connection.sendall(b"\r\n".join([*head, b"", b""]))
        assert heard(connection).startswith(b"HTTP/1.1 431 ")


@pytest.mark.parametrize(
    "line", [b"\x00\xff\r\n\r\n", b"GET /\r\n\r\n", b"G\xc3\xa9T / HTTP/1.1\r\n\r\n"]
)
def test_malformed_request_line_gets_400(room: Room, line: bytes) -> None:
    with connected(room.url) as connection:
        connection.sendall(line)
        assert heard(connection).startswith(b"HTTP/1.1 400 Bad Request\r\n")


@pytest.mark.parametrize(
    "path",
    [
        "web/..%2f..%2fpyproject.toml",
        "web/%00",
        "web/page/main.js%00",
        "web/" + "x" * 4000,
        "web/%ff%fe",
        "web//page/main.js",
        "..%2f",
        "api/past/%00.gif",
        "api/past/" + "9" * 4000 + ".gif",
        "api/past/-1.gif",
        "api/past/1.gif%00",
        "%2e%2e/healthz",
        "//evil.example/%2e%2e",
    ],
)
def test_odd_paths_are_not_there(room: Room, path: str) -> None:
    with connected(room.url) as connection:
        connection.sendall(
            f"GET /{path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode()
        )
        assert heard(connection).startswith(b"HTTP/1.1 404 ")


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "TRACE", "OPTIONS", "X" * 1000])
def test_other_methods_are_not_allowed(room: Room, method: str) -> None:
    with http_client.Client(base_url=room.url) as client:
        for path in ("", "healthz", "web/page/main.js", "api/past/1.gif"):
            assert client.request(method, path).status_code == 405


@pytest.mark.slow
def test_a_socket_whose_app_does_not_answer_ends() -> None:
    async def silent(scope: Scope, receive: Receive, send: Send) -> None:
        await asyncio.Event().wait()

    head = "\r\n".join(["GET / HTTP/1.1", "Host: localhost", *UPGRADE, "", ""])
    with said_to(head.encode(), replace(PATIENT, handshake=0.1), silent) as connection:
        assert heard(connection).startswith(b"HTTP/1.1 500 ")
