"""Time limits and sizes of requests."""

import socket
from collections.abc import Iterator
from contextlib import suppress
from urllib.parse import urlsplit

import httpx
import psutil
import pytest

from ai4u_edu.server import frames, requests
from tests.server.rooms import UPGRADE, Room, served
from tests.waiting import LIMIT_S, until


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with served() as room:
        yield room


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Time limits that are over soon."""
    monkeypatch.setattr(requests, "REQUEST_TIMEOUT_S", 0.2)
    monkeypatch.setattr(requests, "LINGER_S", 0.1)


def connected(room: Room) -> socket.socket:
    parts = urlsplit(room.url)
    return socket.create_connection((parts.hostname or "", parts.port or 80), timeout=LIMIT_S)


def heard(connection: socket.socket) -> bytes:
    """All that comes until the other side closes."""
    said = b""
    with suppress(ConnectionResetError):
        while part := connection.recv(65536):
            said += part
    return said


def test_a_connection_that_says_nothing_ends(room: Room, quick: None) -> None:
    with connected(room) as connection:
        assert heard(connection) == b""


@pytest.mark.parametrize(
    "said",
    [
        b"GE",
        b"GET / HTTP/1.1\r\nHost: localhost\r\n",
        b"GET / HTTP/1.1\r\nHost: localhost\r\nX: ",
    ],
)
def test_half_a_head_is_answered_with_408(room: Room, quick: None, said: bytes) -> None:
    with connected(room) as connection:
        connection.sendall(said)
        answer = heard(connection).decode()
    assert answer.startswith("HTTP/1.1 408 Request Timeout\r\n")
    assert answer.endswith("expected the whole request within 0.2 s\n")


def test_a_byte_now_and_then_does_not_prolong_it(room: Room, quick: None) -> None:
    with connected(room) as connection:
        connection.sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\nX: ")
        connection.settimeout(0.02)
        answer = b""
        while not answer:
            connection.sendall(b"x")
            with suppress(TimeoutError):
                answer = connection.recv(1000)
        assert answer.startswith(b"HTTP/1.1 408 ")


def test_a_slow_body_ends_after_its_answer(room: Room, quick: None) -> None:
    with connected(room) as connection:
        connection.sendall(
            b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\n\r\nx"
        )
        assert heard(connection).startswith(b"HTTP/1.1 200 OK\r\n")


def test_a_connection_that_is_kept_ends_when_nothing_more_is_asked(room: Room, quick: None) -> None:
    ask = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
    with connected(room) as connection:
        for _ in range(3):
            connection.sendall(ask)
            answer = b""
            while not answer.endswith(b"}"):
                answer += connection.recv(65536)
            assert answer.startswith(b"HTTP/1.1 200 OK\r\n")
        connection.sendall(ask + ask + b"GET /heal")
        answers = heard(connection)
    assert answers.count(b"HTTP/1.1 200 OK\r\n") == 2
    assert answers.count(b"HTTP/1.1 408 ") == 1


def test_a_reader_that_takes_nothing_is_given_up(
    room: Room, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(requests, "STALL_TIMEOUT_S", 0.1)
    ask = b"GET /api/openapi.json HTTP/1.1\r\nHost: localhost\r\n\r\n"
    with connected(room) as connection:
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
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
    with connected(room) as connection:
        with suppress(ConnectionError):
            connection.sendall(said)
        answer = heard(connection)
    assert answer.startswith(b"HTTP/1.1 431 ")
    assert b"expected" in answer
    assert httpx.get(room.url + "healthz").status_code == 200


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
    with connected(room) as connection:
        connection.sendall(b"\r\n".join([*head, b"", b""]))
        assert heard(connection).startswith(b"HTTP/1.1 431 ")


@pytest.mark.parametrize(
    "line", [b"\x00\xff\r\n\r\n", b"GET /\r\n\r\n", b"G\xc3\xa9T / HTTP/1.1\r\n\r\n"]
)
def test_what_is_no_request_is_refused(room: Room, line: bytes) -> None:
    with connected(room) as connection:
        connection.sendall(line)
        assert heard(connection).startswith(b"HTTP/1.1 400 Bad Request\r\n")


@pytest.mark.parametrize(
    "path",
    [
        "web/..%2f..%2fpyproject.toml",
        "web/%00",
        "web/main.js%00",
        "web/" + "x" * 4000,
        "web/%ff%fe",
        "web//main.js",
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
    with connected(room) as connection:
        connection.sendall(
            f"GET /{path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode()
        )
        assert heard(connection).startswith(b"HTTP/1.1 404 ")


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "TRACE", "OPTIONS", "X" * 1000])
def test_other_methods_are_not_allowed(room: Room, method: str) -> None:
    with httpx.Client(base_url=room.url) as client:
        for path in ("", "healthz", "web/main.js", "api/past/1.gif"):
            assert client.request(method, path).status_code == 405


@pytest.mark.slow
def test_a_socket_whose_app_does_not_answer_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(frames, "HANDSHAKE_TIMEOUT_S", 0.1)
    from ai4u_edu.server import ServerThread

    async def silent(scope: object, receive: object, send: object) -> None:
        import asyncio

        await asyncio.sleep(60)

    with ServerThread(silent) as server:
        parts = urlsplit(server.url)
        place = (parts.hostname or "", parts.port or 80)
        with socket.create_connection(place, timeout=LIMIT_S) as connection:
            head = "\r\n".join(["GET / HTTP/1.1", "Host: localhost", *UPGRADE, "", ""])
            connection.sendall(head.encode())
            assert heard(connection).startswith(b"HTTP/1.1 500 ")
