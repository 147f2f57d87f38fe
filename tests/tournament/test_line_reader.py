"""Lines of a pipe with a time limit, whatever the writer does."""

import os
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from typing import IO

import pytest

from ai4u_edu.tournament.line_reader import LineReader

MAX_BYTES = 8
MAX_ROUNDS = 10


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
    assert reader.line(10) == b"one\n"
    assert reader.line(0.01) is None, "the second one has no end yet"
    writer.write(b"\n")
    assert reader.line(10) == b"two\n"
    writer.close()
    assert reader.line(10) == b""


def test_a_long_line_is_cut_off(ends: tuple[LineReader, IO[bytes]]) -> None:
    reader, writer = ends
    writer.write(b"x" * 100)
    assert reader.line(10) == b"x" * (MAX_BYTES + 1)


def test_who_writes_without_being_asked_has_to_wait(ends: tuple[LineReader, IO[bytes]]) -> None:
    reader, writer = ends
    os.set_blocking(writer.fileno(), False)
    taken = [fill(writer)]
    while taken[-1]:
        time.sleep(0.2)  # the thread has time to read on, if it does
        taken.append(fill(writer))
        assert len(taken) < MAX_ROUNDS
    threads = threading.active_count()
    writer.close()
    reader.close()
    assert threading.active_count() == threads - 1


def fill(writer: IO[bytes]) -> int:
    """Write lines until the pipe takes no more, and return the number of bytes."""
    count = 0
    with suppress(BlockingIOError):
        while True:
            count += os.write(writer.fileno(), b"x\n" * 4096)
    return count
