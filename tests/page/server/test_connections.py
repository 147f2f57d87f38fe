"""Limits of connections: idle ones make room, and nobody takes all of them."""

import errno
import logging
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import pytest
from starlette.responses import PlainTextResponse
from starlette.types import Receive, Scope, Send

from ai4u_edu.page.server import ServerThread
from ai4u_edu.page.server.limits import connections as limits
from ai4u_edu.page.server.limits.connections import (
    MAX_EVICTING,
    MAX_PER_ADDRESS,
    MAX_STARTING,
    Connections,
    max_connections,
)
from tests.page.server import http_client
from tests.page.server.rooms import (
    PATIENT,
    UPGRADE,
    Page,
    Room,
    connected,
    log_intervals,
    raw_request,
    served,
)
from tests.waiting import LIMIT_S, until


class Transport:
    """An asyncio transport, as far as the limits use it."""

    def __init__(self, descriptor: int) -> None:
        self.descriptor = descriptor
        self.is_aborted = False

    def get_extra_info(self, name: str) -> Any:
        return {"socket": self}[name]

    def fileno(self) -> int:
        return self.descriptor

    def abort(self) -> None:
        self.is_aborted = True


def admit(connections: Connections, peer: tuple[str, int]) -> str:
    """Admit a connection whose descriptor is its port."""
    return connections.admit(peer[1], peer)


def connect(connections: Connections, peer: tuple[str, int], *, idle: bool = True) -> Transport:
    assert admit(connections, peer) == ""
    transport = Transport(peer[1])
    connections.set_idle(transport, idle)  # type: ignore[arg-type]
    return transport


def test_connection_limit_counts_each_address_by_itself() -> None:
    connections = Connections(limit=500)
    for port in range(MAX_PER_ADDRESS):
        connect(connections, ("10.0.0.7", port), idle=False)
    assert admit(connections, ("10.0.0.7", 5000)) == (
        "expected at most 120 connections from one address, got another one from 10.0.0.7; close "
        "some pages, or start with --connections N"
    )
    assert admit(connections, ("10.0.0.8", 5000)) == ""
    connections.leave(0)
    assert admit(connections, ("10.0.0.7", 5000)) == ""


def test_this_machine_may_have_as_many_as_there_are() -> None:
    connections = Connections(limit=300)
    for port in range(300):
        connect(connections, ("127.0.0.1", port), idle=False)
    for host in ("127.0.0.1", "10.0.0.8"):
        assert admit(connections, (host, 5000)) == (
            "expected at most 300 connections, got another one; try again later"
        )


def test_the_connection_that_is_idle_for_the_longest_time_makes_room() -> None:
    connections = Connections(limit=500, per_address=3)
    first, busy, later = (connect(connections, ("10.0.0.7", port)) for port in range(3))
    connections.set_idle(busy, False)  # type: ignore[arg-type]
    connections.set_idle(first, True)  # type: ignore[arg-type]
    connect(connections, ("10.0.0.7", 10), idle=False)
    assert (first.is_aborted, busy.is_aborted, later.is_aborted) == (False, False, True)
    connections.leave(later.descriptor)
    connect(connections, ("10.0.0.7", 11), idle=False)
    assert first.is_aborted
    assert admit(connections, ("10.0.0.7", 12)) != ""
    assert not busy.is_aborted


def test_nothing_is_left_of_connections_that_are_closed() -> None:
    connections = Connections(limit=10)
    for port in range(1000):
        connect(connections, ("10.0.0.7", port))
        if connections.evicting == MAX_EVICTING:
            for gone in range(port):
                connections.leave(gone)
    for port in range(1000):
        connections.leave(port)
    assert len(connections) == connections.evicting == 0
    assert connections._by_address == {}
    assert connections._idle == {}


def test_of_those_that_come_at_once_a_few_are_admitted_before_the_loop_has_its_turn() -> None:
    connections = Connections(limit=MAX_STARTING)
    first = connect(connections, ("10.0.0.7", 0))
    for port in range(1, MAX_STARTING):
        assert not connections.are_waiting()
        assert admit(connections, ("10.0.0.7", port)) == ""
    assert admit(connections, ("10.0.0.7", MAX_STARTING)) == ""
    assert first.is_aborted
    assert connections.are_waiting()
    connections.leave(MAX_STARTING)
    assert not connections.are_waiting()


def test_a_connection_from_a_port_that_was_used_before_counts_once() -> None:
    connections = Connections(limit=100, per_address=2)
    for descriptor in range(50):  # the former one was reset; its socket is closed a turn later
        assert connections.admit(descriptor, ("10.0.0.7", 7)) == ""
        connections.set_idle(Transport(descriptor), True)  # type: ignore[arg-type]
        if descriptor:
            connections.leave(descriptor - 1)
    assert len(connections) == 1
    assert connections.evicting == 0


def test_the_limit_leaves_descriptors_for_everything_else(monkeypatch: pytest.MonkeyPatch) -> None:
    resource = pytest.importorskip("resource")
    for soft, expected in ((1024, 298), (256, 42), (10, 16), (10**6, 1000), (-1, 1000)):
        monkeypatch.setattr(resource, "getrlimit", lambda _, soft=soft: (soft, soft))
        assert max_connections() == expected


@contextmanager
def crowd(url: str, count: int) -> Iterator[list[socket.socket]]:
    with ExitStack() as stack:
        yield [stack.enter_context(connected(url)) for _ in range(count)]


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> Iterator[Room]:
    """A room with 20 connections."""
    monkeypatch.setattr(limits, "max_connections", lambda: 20)
    with served() as room:
        yield room


def test_idle_connections_make_room_for_those_who_ask(small: Room) -> None:
    with small.page() as page:
        page.receive("hello")
        with crowd(small.url, 100):
            for _ in range(30):
                assert http_client.get(small.url + "healthz").status_code == 200
            with small.page() as another:
                another.receive("hello")
            page.hold("KeyW")
            page.receive("state", held=["KeyW"])


def test_who_comes_in_the_same_turn_of_the_loop_as_a_crowd_is_answered(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    begun, ended = threading.Event(), threading.Event()

    async def app(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["path"] == "/wait":
            begun.set()
            ended.wait(LIMIT_S)  # and with it the loop, on purpose
        await PlainTextResponse("here")(scope, receive, send)

    monkeypatch.setattr(limits, "max_connections", lambda: 20)
    with ServerThread(app, timeouts=PATIENT) as server, ExitStack() as stack:
        stack.enter_context(raw_request(server.url + "wait", "Host: localhost"))
        assert begun.wait(LIMIT_S)
        stack.enter_context(crowd(server.url, 100))
        asked = stack.enter_context(raw_request(server.url, "Host: localhost"))
        ended.set()
        assert asked.recv(1000).startswith(b"HTTP/1.1 200 ")


def test_beyond_the_limit_a_connection_is_refused_with_a_sentence(
    small: Room, caplog: pytest.LogCaptureFixture
) -> None:
    began = time.monotonic()  # real time: for the number of lines that a log may have
    with ExitStack() as stack:
        for _ in range(20):
            taken = stack.enter_context(
                raw_request(small.url + "ws/input", "Host: localhost", *UPGRADE)
            )
            assert taken.recv(1000).startswith(b"HTTP/1.1 101 ")
        for _ in range(10):
            answer = http_client.get(small.url + "healthz")
            assert answer.status_code == 503
            assert answer.text.startswith("expected at most 20 connections")
            assert int(answer.headers["Retry-After"]) > 0
    assert len(caplog.messages) <= log_intervals(began)
    until(lambda: http_client.get(small.url + "healthz").status_code == 200)
    with Page(small.url + "ws/input") as page:
        page.receive("hello")


def test_a_lack_of_descriptors_costs_the_new_connection_and_one_line(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    accept = socket.socket.accept
    failures = iter(range(200))
    began = time.monotonic()  # real time: for the number of lines that a log may have

    def fail(listener: socket.socket) -> tuple[socket.socket, Any]:
        if next(failures, None) is not None:
            raise OSError(errno.EMFILE, "Too many open files")
        return accept(listener)

    with served() as room:
        monkeypatch.setattr(socket.socket, "accept", fail)
        assert http_client.get(room.url + "healthz").status_code == 200
        monkeypatch.undo()
        assert http_client.get(room.url + "healthz").status_code == 200
    assert 1 <= len(caplog.records) <= 3 * log_intervals(began)
    assert all(record.levelno == logging.ERROR for record in caplog.records)
