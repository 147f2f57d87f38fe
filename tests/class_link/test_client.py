"""Client of a link, and a class whose connections break."""

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from ai4u_edu.class_link import LinkClient, Outbox
from ai4u_edu.class_link import client as client_module
from ai4u_edu.wire.class_link import Attention, FromClass, Problem, State, Welcome
from tests.class_link.messages import drawing, poses, result, state
from tests.class_link.tiny_class import SECRET, TinyClass
from tests.server.rooms import free_port
from tests.waiting import until


@pytest.fixture
def there() -> Iterator[TinyClass]:
    with TinyClass() as there:
        yield there


@contextmanager
def linked(
    url: str,
    outbox: Outbox | None = None,
    secret: str = SECRET,
    heard: list[FromClass] | None = None,
) -> Iterator[LinkClient]:
    client = LinkClient(url, secret, "room", (heard if heard is not None else []).append, outbox)
    client.start()
    try:
        yield client
    finally:
        client.stop()


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
    assert isinstance(heard[0], Welcome)
    assert heard[1] == Attention("pause", "Look here", 0.0)
    assert (there.hellos[0].secret, there.hellos[0].kind) == (SECRET, "room")
    assert not client.is_connected


@pytest.mark.slow
def test_connections_that_break_lose_no_result_and_states_come_again(there: TinyClass) -> None:
    with linked(there.url) as client:
        client.send(state(1))
        for number in range(6):
            until(lambda: client.is_connected)
            there.is_acknowledging = number % 2 == 0
            client.send_result(result(number))
            until(lambda: len(set(there.results)) == number + 1)  # noqa: B023 - called at once
            there.drop()
            until(lambda: not client.is_connected)
        there.is_acknowledging = True
        until(lambda: not len(client.outbox))
        until(lambda: len(there.of(State)) == len(there.hellos))
    assert set(there.results) == {result(number).key for number in range(6)}


def test_a_link_on_which_nothing_is_said_stays(
    there: TinyClass, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(client_module, "OPEN_TIMEOUT_S", 0.1)
    with linked(there.url) as client:
        until(lambda: client.is_connected)
        time.sleep(0.3)
        assert client.is_connected
    assert len(there.hellos) == 1


def test_a_class_that_begins_later_gets_what_was_sent_before(tmp_path: Path) -> None:
    there = TinyClass()
    there.port = free_port()
    with linked(there.url, Outbox(tmp_path)) as client:
        client.send_result(result(1))
        until(lambda: "can't be reached" in client.problem)
        assert "Results are kept and sent later." in client.problem
        with there:
            until(lambda: not len(client.outbox))
            assert client.problem == ""
    assert there.results == [result(1).key]
    assert len(Outbox(tmp_path)) == 0


def test_stop_waits_for_what_is_pending(there: TinyClass) -> None:
    with linked(there.url) as client:
        client.send_result(result(1))
        client.send(state(1))
    assert there.results == [result(1).key]
    assert there.of(State) == [state(1)]


def test_stop_ends_soon_if_nobody_is_there() -> None:
    client = LinkClient(f"http://127.0.0.1:{free_port()}/", SECRET, "room", lambda _: None)
    client.start()
    client.send_result(result(1))
    client.stop(0.1)
    assert "class-link" not in {each.name for each in threading.enumerate()}


def test_a_wrong_secret_is_not_tried_again(there: TinyClass) -> None:
    heard: list[FromClass] = []
    with linked(there.url, secret="forged", heard=heard) as client:
        until(lambda: client.problem)
        assert client.problem == "This seat is not known. Join again."
        assert client.is_over
    assert len(there.hellos) == 1
    assert isinstance(heard[0], Problem)


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
    from tests.server.rooms import served

    with served() as room, linked(room.url) as client:
        until(lambda: client.problem)
        assert "can't be reached (answer " in client.problem


def test_messages_are_received_one_after_the_other_though_the_connection_breaks(
    there: TinyClass,
) -> None:
    inside, most = [0], [0]
    said = []

    def receive(message: FromClass) -> None:
        inside[0] += 1
        most[0] = max(most[0], inside[0])
        time.sleep(0.02)
        inside[0] -= 1
        said.append(message)

    client = LinkClient(there.url, SECRET, "room", receive)
    client.start()
    until(lambda: client.is_connected)
    for number in range(20):
        there.send(Attention("", str(number), 0.0))
    there.drop()
    until(lambda: len(there.hellos) == 2 and client.is_connected)
    client.stop()
    assert most == [1]


def test_a_handler_that_fails_or_stops_the_client_ends_nothing_else(
    there: TinyClass, caplog: pytest.LogCaptureFixture
) -> None:
    def receive(message: FromClass) -> None:
        if isinstance(message, Attention):
            client.stop()
        raise ValueError("a mistake")

    client = LinkClient(there.url, SECRET, "room", receive)
    client.start()
    until(lambda: client.is_connected)
    client.send_result(result(1))
    until(lambda: not len(client.outbox))
    there.send(Attention("", "", 0.0))
    until(lambda: not client._thread.is_alive())
    assert "could not be handled" in caplog.text
