"""UDP to one address, over real sockets."""

import socket
import sys
from collections.abc import Iterator
from typing import Any

import pytest

from ai4u_edu.blocks.brains.links.udp import MOST_DRAINED, Datagrams

SOON = 5000
"""Milliseconds within which what was sent is there."""


@pytest.fixture
def other() -> Iterator[socket.socket]:
    """Whom it speaks to."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(("127.0.0.1", 0))
        yield other


@pytest.fixture
def datagrams(other: socket.socket) -> Iterator[Datagrams]:
    datagrams = Datagrams(other.getsockname())
    datagrams.send(b"hello")
    yield datagrams
    datagrams.close()


def heard(other: socket.socket) -> Any:
    """Hears the next datagram; gives the address it came from."""
    other.settimeout(SOON / 1000)
    return other.recvfrom(99)[1]


def test_what_comes_back_is_taken(other: socket.socket, datagrams: Datagrams) -> None:
    assert not datagrams.is_there(0)
    with pytest.raises(BlockingIOError):
        datagrams.take()
    other.sendto(b"hi", heard(other))
    assert datagrams.is_there(SOON)
    assert datagrams.take() == (b"hi", True)
    assert not datagrams.is_there(0)


def test_what_a_stranger_sends_is_told_apart(other: socket.socket, datagrams: Datagrams) -> None:
    address = heard(other)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
        stranger.sendto(b"hi", address)
    assert datagrams.is_there(SOON)
    assert datagrams.take() == (b"hi", False)


def test_draining_counts_and_comes_to_an_end(other: socket.socket, datagrams: Datagrams) -> None:
    assert datagrams.drain() == 0
    address = heard(other)
    for _ in range(7):
        other.sendto(b"hi", address)
    assert datagrams.drain() == 7
    datagrams.is_there = lambda _: True
    datagrams.take = lambda: (b"hi", True)  # type: ignore[method-assign]
    assert datagrams.drain() == MOST_DRAINED


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere nobody says that a port is closed")
@pytest.mark.parametrize("ends", ["take", "drain", "send"])
def test_after_a_refusal_waiting_waits_again(
    other: socket.socket, datagrams: Datagrams, ends: str
) -> None:
    other.close()
    datagrams.send(b"is anybody there?")
    assert datagrams.is_there(SOON)
    if ends == "drain":
        assert datagrams.drain() == 0
    else:
        with pytest.raises(ConnectionRefusedError):
            datagrams.take() if ends == "take" else datagrams.send(b"hello?")
    assert not datagrams.is_there(0)
    with pytest.raises(BlockingIOError):
        datagrams.take()
