"""Client of a link, and a class whose connections break."""

import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest

from ai4u_edu.member import LinkClient, ResultOutbox
from ai4u_edu.member import client as client_module
from ai4u_edu.wire.class_link import Attention, FromClass, LinkProblem, LinkWelcome, State
from tests.member.messages import drawing, poses, result, state
from tests.member.tiny_class import PATIENT, SECRET, TinyClass
from tests.waiting import LIMIT_S, until


@pytest.fixture
def there() -> Iterator[TinyClass]:
    with TinyClass() as there:
        yield there


@contextmanager
def linked(
    url: str,
    outbox: ResultOutbox | None = None,
    secret: str = SECRET,
    heard: list[FromClass] | None = None,
) -> Iterator[LinkClient]:
    with running(url, (heard if heard is not None else []).append, outbox, secret) as client:
        yield client


@contextmanager
def running(
    url: str,
    receive: Callable[[FromClass], object],
    outbox: ResultOutbox | None = None,
    secret: str = SECRET,
) -> Iterator[LinkClient]:
    client = LinkClient(url, secret, "room", receive, outbox, PATIENT)
    client.start()
    try:
        yield client
    finally:
        client.stop(LIMIT_S)


def test_states_and_results_arrive_and_messages_are_received(there: TinyClass) -> None:
    heard: list[FromClass] = []
    with linked(there.url, heard=heard) as client:
        client.send(drawing(1))
        client.send(poses(1))
        client.send_result(result(1))
        until(lambda: len(there.got) == 3 and not len(client.outbox))
        there.send(Attention("pause", "Look here", 0.0))
        until(lambda: len(heard) == 2)
        assert client.is_connected
        assert client.problem == ""
    assert isinstance(heard[0], LinkWelcome)
    assert heard[1] == Attention("pause", "Look here", 0.0)
    assert (there.hellos[0].secret, there.hellos[0].kind) == (SECRET, "room")
    assert not client.is_connected


@pytest.mark.slow
def test_connections_that_break_lose_no_result_and_states_come_again(there: TinyClass) -> None:
    def is_new(count: int) -> bool:
        # a connection that is over may count as open for a moment
        return len(there.hellos) == count and client.is_connected

    with linked(there.url) as client:
        client.send(state(1))
        for number in range(6):
            until(lambda: is_new(number + 1))  # noqa: B023 - called at once
            there.is_acknowledging = number % 2 == 0
            client.send_result(result(number))
            until(lambda: len(set(there.results)) == number + 1)  # noqa: B023 - called at once
            until(lambda: len(there.of(State)) == number + 1)  # noqa: B023 - called at once
            there.drop()
        until(lambda: is_new(7))
        there.is_acknowledging = True
        there.drop()  # what was not acknowledged comes again over the next one
        until(lambda: not len(client.outbox))
        until(lambda: len(there.hellos) == 8)
        until(lambda: there.got and isinstance(there.got[-1], State))
    assert set(there.results) == {result(number).key for number in range(6)}


def test_a_silent_link_has_no_timeout_of_reading(
    there: TinyClass, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[socket.socket] = []
    create, port = socket.create_connection, urlsplit(there.url).port

    def noting(address: Any, *args: Any) -> socket.socket:
        connection = create(address, *args)
        if address[1] == port:  # threads of other tests may go elsewhere
            made.append(connection)
        return connection

    monkeypatch.setattr(socket, "create_connection", noting)
    with linked(there.url) as client:
        until(lambda: client.is_connected)
        (only,) = made
        assert only.gettimeout() is None
    assert len(there.hellos) == 1


def test_a_class_that_begins_later_gets_what_was_sent_before(tmp_path: Path) -> None:
    there = TinyClass()
    with linked(there.url, ResultOutbox(tmp_path)) as client:
        client.send_result(result(1))
        until(lambda: "can't be reached" in client.problem)
        assert "Results are kept and sent later." in client.problem
        with there:
            until(lambda: not len(client.outbox))
            assert client.problem == ""
    assert there.results == [result(1).key]
    assert len(ResultOutbox(tmp_path)) == 0


def test_stop_waits_for_what_is_pending(there: TinyClass) -> None:
    with linked(there.url) as client:
        until(lambda: client.is_connected)
        client.send_result(result(1))
        client.send(state(1))
    assert there.results == [result(1).key]
    until(lambda: there.of(State) == [state(1)])  # the class reads it after the client has gone


def test_stop_does_not_wait_for_a_class_that_is_not_there() -> None:
    there = TinyClass()
    with running(there.url, lambda _: None) as client:
        client.send_result(result(1))
        until(lambda: "can't be reached" in client.problem)
        stopping = threading.Thread(target=client.stop, args=[10 * LIMIT_S])
        stopping.start()
        stopping.join(LIMIT_S)
        assert not stopping.is_alive()
    assert not client._thread.is_alive()


def test_a_wrong_secret_is_not_tried_again(there: TinyClass) -> None:
    heard: list[FromClass] = []
    with linked(there.url, secret="forged", heard=heard) as client:
        until(lambda: client.is_over)
        assert client.problem == "This seat is not known. Join again."
    assert len(there.hellos) == 1
    assert isinstance(heard[0], LinkProblem)


def test_a_class_that_closes_for_good_is_not_asked_again(there: TinyClass) -> None:
    there.refusal = "You may not join this class."
    with linked(there.url) as client:
        until(lambda: client.is_over)
        assert client.problem == "You may not join this class."
        assert len(there.hellos) == 1
        there.refusal = ""
        client.send_result(result(1))
        client.renew()
        until(lambda: not len(client.outbox))
    assert len(there.hellos) == 2


def test_another_server_is_no_class(there: TinyClass) -> None:
    from tests.page.server.rooms import served

    with served() as room, linked(room.url) as client:
        until(lambda: client.problem)
        assert "can't be reached (answer " in client.problem


def test_messages_are_received_one_after_the_other_though_the_connection_breaks(
    there: TinyClass, monkeypatch: pytest.MonkeyPatch
) -> None:
    is_inside, may_go_on, is_waited_for = (threading.Event() for _ in range(3))
    inside, most = [0], [0]

    class Joined(threading.Thread):
        def join(self, timeout: float | None = None) -> None:
            is_waited_for.set()
            super().join(timeout)

    def receive(message: FromClass) -> None:
        inside[0] += 1
        most[0] = max(most[0], inside[0])
        if isinstance(message, Attention):
            is_inside.set()
            assert may_go_on.wait(LIMIT_S)
        inside[0] -= 1

    monkeypatch.setattr(client_module, "Thread", Joined)
    with running(there.url, receive) as client:
        until(lambda: client.is_connected)
        there.send(Attention("", "", 0.0))
        assert is_inside.wait(LIMIT_S)
        there.drop()

        def has_noticed() -> bool:
            client.send(state(1))  # which can't be sent
            return is_waited_for.is_set()

        until(has_noticed)
        # the next connection may not be opened before the message of this one was handled
        assert len(there.hellos) == 1
        may_go_on.set()
        until(lambda: len(there.hellos) == 2 and client.is_connected)
    assert most == [1]


def test_a_handler_that_fails_or_stops_the_client_ends_nothing_else(
    there: TinyClass, caplog: pytest.LogCaptureFixture
) -> None:
    def receive(message: FromClass) -> None:
        if isinstance(message, Attention):
            client.stop(LIMIT_S)
        raise ValueError("a mistake")

    with running(there.url, receive) as client:
        until(lambda: client.is_connected)
        client.send_result(result(1))
        until(lambda: not len(client.outbox))
        there.send(Attention("", "", 0.0))
        until(lambda: not client._thread.is_alive())
    assert "could not be handled" in caplog.text


def test_nothing_is_delivered_after_stop_has_returned(there: TinyClass) -> None:
    """Messages may have arrived before: whoever has stopped the client may have gone away."""
    is_inside, may_go_on = threading.Event(), threading.Event()
    heard: list[FromClass] = []

    def receive(message: FromClass) -> None:
        heard.append(message)
        if isinstance(message, Attention):
            is_inside.set()
            assert may_go_on.wait(LIMIT_S)

    impatient = replace(PATIENT, close=0.0)
    client = LinkClient(there.url, SECRET, "room", receive, timeouts=impatient)
    client.start()
    until(lambda: client.is_connected)
    there.send(Attention("", "first", 0.0))
    there.send(Attention("", "second", 0.0))
    assert is_inside.wait(LIMIT_S)
    client.stop(0.0)
    before = len(heard)
    may_go_on.set()
    until(lambda: not client._thread.is_alive())
    assert len(heard) == before
