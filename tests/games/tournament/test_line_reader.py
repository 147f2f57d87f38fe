"""Lines of a pipe with a time limit, whatever the writer does."""

import io
import os
import threading
from collections.abc import Iterator
from typing import IO

import pytest

from ai4u_edu.games.tournament import drivers
from ai4u_edu.games.tournament.drivers import MAX_WAITING_LINES, LineReader
from tests.waiting import LIMIT_S, until

MAX_BYTES = 8


@pytest.fixture(autouse=True)
def _patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a reader's end wait for its thread as long as that takes."""
    monkeypatch.setattr(drivers, "READER_END_TIMEOUT_S", LIMIT_S)


@pytest.fixture
def ends() -> Iterator[tuple[LineReader, IO[bytes]]]:
    read, write = os.pipe()
    with os.fdopen(write, "wb", 0) as writer:
        reader = LineReader(os.fdopen(read, "rb"), MAX_BYTES)
        yield reader, writer
    reader.close()


def test_lines_come_as_they_are_written(ends: tuple[LineReader, IO[bytes]]) -> None:
    reader, writer = ends
    assert reader.line(0.01) is None
    writer.write(b"one\ntwo")
    assert reader.line(LIMIT_S) == b"one\n"
    assert reader.line(0.01) is None, "the second one has no end yet"
    writer.write(b"\n")
    assert reader.line(LIMIT_S) == b"two\n"
    writer.close()
    assert reader.line(LIMIT_S) == b""


def test_a_long_line_is_cut_off(ends: tuple[LineReader, IO[bytes]]) -> None:
    reader, writer = ends
    writer.write(b"x" * 100)
    assert reader.line(LIMIT_S) == b"x" * (MAX_BYTES + 1)


class EndlessPipe(io.BytesIO):
    """A pipe whose writer never waits."""

    def __init__(self) -> None:
        super().__init__()
        self.count = 0
        """Lines that were read."""

    def readline(self, _size: int | None = -1, /) -> bytes:
        self.count += 1
        return b"x\n"


def readers() -> set[threading.Thread]:
    """Return the threads that read lines, those of other tests included."""
    return {each for each in threading.enumerate() if each.name == "line reader"}


def test_few_lines_are_read_before_somebody_asks_for_them() -> None:
    before = readers()
    pipe = EndlessPipe()
    reader = LineReader(pipe, MAX_BYTES)
    # one more is read, and waits for its place
    for taken in range(20):
        until(lambda: pipe.count == MAX_WAITING_LINES + 1 + taken)  # noqa: B023 - called at once
        assert reader.line(LIMIT_S) == b"x\n"
    assert pipe.count <= MAX_WAITING_LINES + 1 + 20
    reader.close()
    assert pipe.closed
    assert readers() <= before
