"""UDP to one address, over real sockets."""

import socket
import sys
from collections.abc import Iterator
from typing import Any

import pytest

from ai4u_edu.blocks.brains.links.ai4u import MAX_DRAINED, UdpSocket
from tests.waiting import LIMIT_MS, LIMIT_S


@pytest.fixture
def other() -> Iterator[socket.socket]:
    """Return the socket of the peer."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(("127.0.0.1", 0))
        yield other


@pytest.fixture
def udp(other: socket.socket) -> Iterator[UdpSocket]:
    udp = UdpSocket(other.getsockname())
    udp.send(b"hello")
    yield udp
    udp.close()


def heard(other: socket.socket) -> Any:
    """Receive the next datagram and return its sender's address."""
    other.settimeout(LIMIT_S)
    return other.recvfrom(99)[1]


def test_what_comes_back_is_taken(other: socket.socket, udp: UdpSocket) -> None:
    assert not udp.wait_readable(0)
    with pytest.raises(BlockingIOError):
        udp.receive()
    other.sendto(b"hi", heard(other))
    assert udp.wait_readable(LIMIT_MS)
    assert udp.receive() == (b"hi", True)
    assert not udp.wait_readable(0)


def test_what_a_stranger_sends_is_told_apart(other: socket.socket, udp: UdpSocket) -> None:
    address = heard(other)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
        stranger.sendto(b"hi", address)
    assert udp.wait_readable(LIMIT_MS)
    assert udp.receive() == (b"hi", False)


def test_draining_counts_and_comes_to_an_end(other: socket.socket, udp: UdpSocket) -> None:
    assert udp.drain() == 0
    address = heard(other)
    for _ in range(7):
        other.sendto(b"hi", address)
    assert udp.drain() == 7
    udp.wait_readable = lambda _: True
    udp.receive = lambda: (b"hi", True)  # type: ignore[method-assign]
    assert udp.drain() == MAX_DRAINED


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere nobody says that a port is closed")
@pytest.mark.parametrize("ends", ["receive", "drain", "send"])
def test_after_a_refusal_waiting_waits_again(
    other: socket.socket, udp: UdpSocket, ends: str
) -> None:
    other.close()
    udp.send(b"is anybody there?")
    assert udp.wait_readable(LIMIT_MS)
    if ends == "drain":
        assert udp.drain() == 0
    else:
        with pytest.raises(ConnectionRefusedError):
            udp.receive() if ends == "receive" else udp.send(b"hello?")
    assert not udp.wait_readable(0)
    with pytest.raises(BlockingIOError):
        udp.receive()
