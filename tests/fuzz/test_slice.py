"""A fixed slice of the long fuzz; ``python -m tests.fuzz`` is the whole of it."""

from dataclasses import replace

import pytest

from tests.fuzz.files import TINY
from tests.fuzz.run import run
from tests.fuzz.target import Target
from tests.fuzz.targets import TARGETS

SLICE = {
    "native-said": 250,
    "native-heard": 250,
    "ai4u-request": 250,
    "ai4u-reply": 250,
    "percept": 100,
    "page-words": 100,
    "recording": 75,
    "scene": 20,
    "http": 100,
    "conversations": 15,
}


@pytest.mark.parametrize("name", TARGETS)
def test_nothing_that_comes_is_too_odd(name: str) -> None:
    report = run(TARGETS[name], SLICE[name], seed=4)
    assert report.findings == []
    assert report.inputs == SLICE[name]
    assert report.right < report.inputs or not TARGETS[name].allowed


FOUND = [
    ("native-said", b"\x92\xa3bye" + b"\x91" * 1018 + b"\xc0"),
    ("ai4u-request", b"   1   4eyes5   65000" + b"1" * 64_999 + b"x"),
    ("scene", b"name: x\nbodies: [? {name: r}]\n"),
    ("scene", TINY.replace("tiny", "tiny\ntitle: " + "x" * 70 + " " * 60 + "y").encode()),
    # a page that was sent away, and whoever tells it the news did not hear of that
    ("conversations", b"=K\xe3\x134\x0bDz"),
    ("conversations", b"\xd0kB\x17\x04\xd9\x031"),
]


@pytest.mark.parametrize(("name", "data"), FOUND)
def test_what_was_found_once(name: str, data: bytes) -> None:
    given = replace(TARGETS[name], make=lambda rng: data)
    assert run(given, 1).findings == []


def target(read: object) -> Target:
    return Target("mine", lambda rng: rng.randbytes(4), read, (ValueError,))  # type: ignore[arg-type]


def test_what_is_not_declared_is_a_finding_with_its_input() -> None:
    def read(data: bytes) -> None:
        if data[0] < 128:
            raise ValueError
        raise KeyError(data[0])

    report = run(target(read), 50)
    assert report.right == 0
    assert len(report.findings) == 5
    assert report.findings[0].startswith("KeyError(")
    assert "input: b'" in report.findings[0]


def test_a_hang_is_a_finding() -> None:
    def read(data: bytes) -> None:
        for _ in range(10**9):  # half a minute if nobody ends it
            pass

    report = run(target(read), 1)
    assert report.findings[0].startswith("more than a second")


def test_what_stays_is_a_finding() -> None:
    kept: list[bytes] = []
    report = run(target(kept.append), 10_000)
    assert "objects stay after each input" in report.findings[0]
