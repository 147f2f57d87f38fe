"""``submit``: a notebook hands in a network, and hears what the class says of it."""

from collections.abc import Iterator
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

from ai4u_edu.lessons import class_membership as module
from ai4u_edu.lessons import join_class, leave_class, submit
from ai4u_edu.lessons.class_membership import current_connection
from ai4u_edu.member.notebook import ClassConnection
from ai4u_edu.wire.class_link import (
    MAX_NETWORK_BYTES,
    Ack,
    CheckedNetwork,
    HandedIn,
    HandedInNetwork,
    LinkProblem,
)
from tests.lessons.class_with_a_seat import class_with_a_seat, connected
from tests.member.tiny_class import TinyClass
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.needs("train")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "policy.onnx").write_bytes(b"a network")
    yield tmp_path
    leave_class()


@pytest.fixture
def there(monkeypatch: pytest.MonkeyPatch) -> Iterator[TinyClass]:
    monkeypatch.setattr(module, "CHECK_TIMEOUT_S", LIMIT_S)
    with class_with_a_seat(monkeypatch) as there:
        yield there


def joined(there: TinyClass) -> ClassConnection:
    """Join a class that runs; return the connection with it."""
    there.start()
    join_class(there.url, "BCDFG")
    return connected()


def network_in(there: TinyClass, number: int = 0) -> HandedInNetwork:
    until(lambda: len(there.of(HandedInNetwork)) > number)
    network = there.of(HandedInNetwork)[number]
    assert isinstance(network, HandedInNetwork)
    return network


def checked(network: HandedInNetwork, reason: str = "") -> HandedIn:
    verdict = "refused" if reason else "right"
    facts = (network.scene, network.part, network.file)
    return HandedIn((CheckedNetwork(network.key, *facts, verdict, reason),))  # type: ignore[arg-type]


def test_outside_of_a_class_it_says_what_to_do(capsys: pytest.CaptureFixture[str]) -> None:
    submit("sumo", "policy.onnx")
    told = capsys.readouterr().out
    assert told.startswith("Not handed in. You are in no class. Join it first: `join_class(")
    assert "on a JupyterHub `join_class()`" in told


def test_the_class_tells_its_verdict(
    there: TinyClass, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    outbox = joined(there).client.outbox
    answers = ["", "it is slow"]
    looks: list[bool] = []
    """For each look at the outbox, whether the class has acknowledged everything."""
    keys = outbox.keys

    def look() -> Any:
        waiting = keys()
        looks.append(not waiting)
        return waiting

    monkeypatch.setattr(outbox, "keys", look)

    def judge() -> None:
        for number, reason in enumerate(answers):
            network = network_in(there, number)
            seen = len(looks)  # a check takes longer than the acknowledgement
            until(lambda seen=seen: looks[seen:].count(True) > 1)  # type: ignore[misc]
            there.send(checked(network, reason))

    thread = Thread(target=judge)
    thread.start()
    submit("soccer", Path("policy.onnx"), part="keeper")
    submit("sumo", "policy.onnx")
    thread.join()
    told = capsys.readouterr().out
    assert "Handed in. policy.onnx for soccer (keeper) can play in the tournament." in told
    assert "Not taken. policy.onnx for sumo: it is slow" in told
    assert network_in(there).data == b"a network"
    assert (network_in(there).scene, network_in(there).part) == ("soccer", "keeper")


def test_what_the_class_does_not_take_is_told(
    there: TinyClass, capsys: pytest.CaptureFixture[str]
) -> None:
    there.is_acknowledging = False
    joined(there)

    def refuse() -> None:
        network = network_in(there)
        there.send(LinkProblem("message", "part: Sumo has these parts: none."))
        there.send(Ack(network.key))

    thread = Thread(target=refuse)
    thread.start()
    submit("sumo", "policy.onnx", part="keeper")
    thread.join()
    assert "Not taken. policy.onnx for sumo (keeper): part: Sumo has" in capsys.readouterr().out


def test_without_a_connection_it_is_kept_and_delivered_later(
    there: TinyClass, capsys: pytest.CaptureFixture[str]
) -> None:
    join_class(there.url, "BCDFG")
    submit("sumo", "policy.onnx")
    assert "is sent as soon as it can be." in capsys.readouterr().out
    leave_class()  # and so the kernel might have been restarted
    there.start()
    join_class(there.url, "BCDFG")
    assert network_in(there).data == b"a network"


def test_a_check_that_takes_long_goes_on_without_the_notebook(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    now = 0.0

    def clock() -> float:
        """Tell a time that stands still until the class has the network, and then flies."""
        nonlocal now
        connection = current_connection()
        if (
            connection is not None
            and tiny_class.of(HandedInNetwork)
            and not len(connection.client.outbox)
        ):
            now += module.CHECK_TIMEOUT_S
        return now

    with class_with_a_seat(monkeypatch, clock) as tiny_class:
        joined(tiny_class)
        submit("sumo", "policy.onnx")
        leave_class()
    assert "Handed in. policy.onnx for sumo waits for its check." in capsys.readouterr().out


@pytest.mark.parametrize(
    ("scene", "file", "told"),
    [
        ("sumoo", "policy.onnx", "Expected the name of a scene, got 'sumoo'; did you mean 'sumo'"),
        ("sumo", "policy.zip", "Expected a network as an .onnx file, got 'policy.zip'"),
        ("sumo", "none.onnx", "none.onnx can't be read: No such file"),
        ("sumo", "large.onnx", "expected 1 byte to 5 MB, got 5,242,881 bytes"),
    ],
)
def test_what_can_be_no_network_is_not_sent(
    there: TinyClass,
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    scene: str,
    file: str,
    told: str,
) -> None:
    (folder / "large.onnx").write_bytes(bytes(MAX_NETWORK_BYTES + 1))
    join_class(there.url, "BCDFG")
    capsys.readouterr()
    submit(scene, file)
    assert told in capsys.readouterr().out
