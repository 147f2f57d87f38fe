"""A script's own connection, and everything that may go wrong at its other end."""

import gc
import signal
import socket
import struct
import threading
import time
from collections import Counter
from collections.abc import Callable
from contextlib import closing, suppress
from http import HTTPStatus
from pathlib import Path

import psutil
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.frames import Frame, Opcode
from websockets.http11 import Request, Response
from websockets.sync.server import ServerConnection

from ai4u_edu.remote import channel
from ai4u_edu.remote.connection_options import lost_by
from ai4u_edu.remote.direct_socket import DirectSocket
from ai4u_edu.remote.readiness import is_readable
from tests.remote.far_ends import (
    SOON,
    certificate,
    echo,
    ending,
    facing,
    facing_bare,
    opened,
    serving,
)
from tests.server.rooms import until

LARGE = bytes(range(256)) * 2**12
"""More than lies between two ends."""
SELDOM = 1000.0
"""Seconds from ping to ping where the watch is to stay out of it."""


def idle(far: ServerConnection) -> None:
    """Reads, and says nothing."""
    for _ in far:
        pass


def refusing(far: ServerConnection) -> None:
    far.close(4404, "no such agent")


def wait_for_close(near: DirectSocket) -> None:
    assert is_readable(near.socket, SOON)


def frame(opcode: Opcode, data: bytes, *, fin: bool = True) -> bytes:
    return Frame(opcode, data, fin).serialize(mask=False)


# -- messages -------------------------------------------------------------------------------------


@pytest.mark.parametrize("size", [0, 1, 125, 126, 2**16, len(LARGE)])
def test_what_is_said_comes_back(size: int) -> None:
    with facing(echo) as near:
        for _ in range(3):
            near.send(LARGE[:size])
            assert near.recv(SOON) == LARGE[:size]


def test_text_is_taken_as_bytes() -> None:
    with facing(lambda far: far.send("höre")) as near:
        assert near.recv(SOON) == "höre".encode()


def test_a_message_may_come_in_pieces_with_a_ping_between_them() -> None:
    with facing_bare() as (near, far):
        far.sendall(
            frame(Opcode.BINARY, b"one ", fin=False) + frame(Opcode.CONT, b"two ", fin=False)
        )
        far.sendall(frame(Opcode.PING, b"?"))
        with pytest.raises(TimeoutError):
            near.recv(0.05)
        far.sendall(frame(Opcode.CONT, b"three") + frame(Opcode.TEXT, b"four"))
        assert near.recv(SOON) == b"one two three"
        assert near.recv(SOON) == b"four"


def test_a_message_may_come_byte_by_byte() -> None:
    with facing_bare() as (near, far):
        far.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

        def drip() -> None:
            for byte in frame(Opcode.BINARY, b"slow"):
                far.sendall(bytes([byte]))
                time.sleep(0.005)

        with_drip = threading.Thread(target=drip)
        with_drip.start()
        assert near.recv(SOON) == b"slow"
        with_drip.join()


def test_who_waits_too_short_may_wait_again() -> None:
    with facing(echo) as near:
        with pytest.raises(TimeoutError):
            near.recv(0.02)
        near.send(b"there")
        assert near.recv(SOON) == b"there"


def test_who_is_interrupted_may_go_on() -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    script = threading.main_thread().ident
    assert script is not None
    before = signal.signal(signal.SIGUSR1, interrupt)
    try:
        with facing(echo) as near:
            later = threading.Timer(0.05, signal.pthread_kill, (script, signal.SIGUSR1))
            later.start()
            with pytest.raises(KeyboardInterrupt):
                near.recv(SOON)
            near.send(b"still there")
            assert near.recv(SOON) == b"still there"
    finally:
        signal.signal(signal.SIGUSR1, before)


def test_who_is_interrupted_between_two_bytes_ends_it(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(_: object) -> None:
        raise KeyboardInterrupt

    with facing(echo) as near:
        monkeypatch.setattr(near._protocol, "receive_data", interrupt)
        near.send(b"?")
        with pytest.raises(KeyboardInterrupt):
            near.recv(SOON)
        monkeypatch.undo()
        ending(lambda: near.recv(SOON))


def test_several_threads_may_say_something() -> None:
    with facing(echo) as near:

        def talk(number: int) -> None:
            for _ in range(50):
                near.send(bytes([number]) * 2000)

        threads = [threading.Thread(target=talk, args=(number,)) for number in range(4)]
        for thread in threads:
            thread.start()
        heard = Counter(near.recv(SOON) for _ in range(200))
        assert heard == {bytes([number]) * 2000: 50 for number in range(4)}
        for thread in threads:
            thread.join()


def test_while_nobody_reads_little_is_kept_and_all_of_it_comes_later() -> None:
    def flood(far: ServerConnection) -> None:
        with suppress(ConnectionClosed):
            for number in range(400):
                far.send(struct.pack("!I", number) + LARGE[:60_000])

    with facing(flood, ping_interval=0.02, ping_timeout=0.1) as near:
        until(lambda: len(near._inbox) >= 16)
        time.sleep(0.3)  # a pong would lie behind all that; that none comes must not matter
        assert len(near._inbox) < 20
        numbers = [struct.unpack_from("!I", near.recv(SOON))[0] for _ in range(400)]
        assert numbers == list(range(400))


# -- while the script thinks ----------------------------------------------------------------------


def test_a_ping_is_answered_while_the_script_thinks() -> None:
    answered = threading.Event()

    def ask(far: ServerConnection) -> None:
        if far.ping().wait(SOON):
            answered.set()
        idle(far)

    with facing(ask):
        assert answered.wait(SOON)


def test_a_ping_is_answered_while_the_script_waits() -> None:
    def ask(far: ServerConnection) -> None:
        if far.ping().wait(SOON):
            far.send(b"answered")

    with facing(ask, ping_interval=SELDOM) as near:
        assert near.recv(SOON) == b"answered"


def test_pings_go_out_and_who_answers_them_stays() -> None:
    with facing_bare(ping_interval=0.04, ping_timeout=0.4) as (_, far):
        for _ in range(15):  # for longer than the timeout
            head = far.recv(2)
            assert head == bytes([0x89, 0x80])
            far.recv(4)
            far.sendall(frame(Opcode.PONG, b""))


def test_an_end_that_answers_no_ping_is_gone_for_who_waits() -> None:
    with facing_bare(ping_interval=0.04, ping_timeout=0.1) as (near, _):
        found = ending(lambda: near.recv(SOON))
        assert found.rcvd is None
        assert "keepalive ping timeout" in str(found)


def test_an_end_that_answers_no_ping_is_gone_for_who_thinks() -> None:
    with facing_bare(ping_interval=0.04, ping_timeout=0.1) as (near, _):
        near.recv_events_thread.join(SOON)
        assert near.socket.fileno() == -1
        assert "keepalive ping timeout" in str(ending(lambda: near.send(b"?")))


def test_a_close_is_noticed_while_the_script_thinks() -> None:
    with facing(refusing) as near:
        near.recv_events_thread.join(SOON)
        assert near.socket.fileno() == -1
        assert lost_by(ending(lambda: near.recv(SOON))).code == 4404


# -- ends -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("noticing", ["recv", "send"])
def test_a_close_says_why(noticing: str) -> None:
    with facing(refusing, ping_interval=SELDOM) as near:
        wait_for_close(near)
        with pytest.raises(ConnectionClosed) as found:  # at the first try
            near.recv(SOON) if noticing == "recv" else near.send(b"?")
        lost = lost_by(found.value)
        assert (lost.code, str(lost)) == (4404, "no such agent")


def test_a_close_before_a_reset_still_says_why() -> None:
    with facing_bare(ping_interval=SELDOM) as (near, far):
        far.sendall(frame(Opcode.CLOSE, struct.pack("!H", 4404) + b"no such agent"))
        near._fresh_until = time.monotonic() + SOON  # as if it had come this very moment
        far.close()
        found = ending(lambda: near.send(b"?"))
        assert lost_by(found).code == 4404


def test_what_came_before_the_close_is_heard() -> None:
    def last_words(far: ServerConnection) -> None:
        far.send(b"one")
        far.send(b"two")

    with facing(last_words) as near:
        near.recv_events_thread.join(SOON)
        assert [near.recv(0), near.recv(0)] == [b"one", b"two"]
        assert lost_by(ending(lambda: near.recv(0))).code == 1000


def test_the_other_end_hears_the_goodbye() -> None:
    codes: list[int | None] = []

    def listen(far: ServerConnection) -> None:
        idle(far)
        codes.append(far.close_code)

    with serving(listen) as url:
        near = opened(url)
        near.close()
        near.close()
        for call in (lambda: near.send(b"?"), lambda: near.recv(SOON)):
            ending(call)
        until(lambda: codes == [1000])


def test_who_says_goodbye_does_not_hang_up_first() -> None:
    with facing_bare(ping_interval=SELDOM, close_timeout=SOON) as (near, far):
        leaving = threading.Thread(target=near.close)
        leaving.start()
        assert far.recv(2) == bytes([0x88, 0x82])
        far.recv(6)
        far.sendall(frame(Opcode.BINARY, b"unheard"))  # unread, it would make a reset of the end
        assert not is_readable(far, 0.1)
        far.close()
        leaving.join(SOON)
        assert not leaving.is_alive()


@pytest.mark.parametrize("clogged", [False, True])
def test_closing_waits_only_so_long(clogged: bool) -> None:
    with facing_bare(ping_interval=SELDOM, close_timeout=0.1, ping_timeout=1000.0) as (near, far):
        far.sendall(frame(Opcode.BINARY, b"unheard"))
        with suppress(BlockingIOError):
            while clogged:
                near.socket.send(LARGE)
        near.close()
        assert near.socket.fileno() == -1


def test_closing_wakes_who_waits() -> None:
    with facing(idle, ping_interval=SELDOM) as near:
        found: list[BaseException] = []
        waiting = threading.Thread(target=lambda: found.append(ending(lambda: near.recv(60.0))))
        waiting.start()
        until(lambda: near._reading.locked())
        near.close()
        waiting.join(SOON)
        assert isinstance(found[0], ConnectionClosed)


@pytest.mark.parametrize("noticing", ["recv", "send"])
def test_a_reset_is_the_end(noticing: str) -> None:
    with facing_bare(ping_interval=SELDOM) as (near, far):
        far.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        far.close()
        found = ending(lambda: near.recv(SOON) if noticing == "recv" else near.send(b"?"))
        assert found.rcvd is None


@pytest.mark.parametrize(
    "rubbish",
    [b"\xff" * 100, b"\x83\x00", b"\x82\x81\0\0\0\0x", b"\x80\x01x", b"HTTP/1.1 200 OK\r\n" * 9],
    ids=["opcode", "reserved", "masked", "nothing to go on with", "text"],
)
def test_rubbish_is_the_end(rubbish: bytes) -> None:
    with facing_bare(ping_interval=SELDOM) as (near, far):
        far.sendall(rubbish)
        assert lost_by(ending(lambda: near.recv(SOON))).code == 0


@pytest.mark.parametrize("pieces", [1, 4])
def test_too_large_a_message_is_the_end(pieces: int) -> None:
    with facing_bare(ping_interval=SELDOM, max_size=1000) as (near, far):
        for number in range(pieces):
            opcode = Opcode.CONT if number else Opcode.BINARY
            far.sendall(frame(opcode, bytes(1200 // pieces), fin=number == pieces - 1))
        found = ending(lambda: near.recv(SOON))
        assert found.sent is not None
        assert found.sent.code == 1009


def test_an_end_that_takes_nothing_is_gone() -> None:
    with facing_bare(ping_interval=SELDOM, ping_timeout=0.2) as (near, _):
        near.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 2**12)
        assert ending(lambda: near.send(LARGE)).rcvd is None
        assert ending(lambda: near.recv(SOON)).rcvd is None


def test_an_end_that_takes_its_time_gets_the_whole_message() -> None:
    with facing_bare(ping_interval=SELDOM) as (near, far):
        near.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 2**12)
        sending = threading.Thread(target=lambda: near.send(LARGE))
        sending.start()
        got = 0
        while got < len(LARGE) + 14:  # the head of a long frame, masked
            got += len(far.recv(2**16))
        sending.join()
        assert got == len(LARGE) + 14


# -- opening --------------------------------------------------------------------------------------


def test_a_refused_handshake_says_why() -> None:
    def no(far: ServerConnection, _: Request) -> Response:
        return far.respond(HTTPStatus.FORBIDDEN, "not from there\n")

    with serving(idle, process_request=no) as url, pytest.raises(InvalidStatus) as found:
        opened(url)
    assert str(lost_by(found.value)) == "answer 403 not from there"


def test_who_does_not_answer_the_handshake_is_not_waited_for() -> None:
    with socket.create_server(("127.0.0.1", 0)) as silent, pytest.raises(TimeoutError):
        opened(f"ws://127.0.0.1:{silent.getsockname()[1]}", open_timeout=0.1)


@pytest.mark.parametrize(
    ("at_once", "ping_interval"),
    [(2**16, 0.1), (300, SELDOM)],
    ids=["whole records of TLS", "parts of them, and nothing behind them"],
)
def test_it_goes_through_tls(
    at_once: int, ping_interval: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(channel, "_AT_ONCE", at_once)
    server, client = certificate(tmp_path)

    def talk(far: ServerConnection) -> None:
        for number in range(100):
            far.send(bytes([number]) * 1000)
        echo(far)

    with (
        serving(talk, ssl=server) as url,
        closing(opened(url, ssl=client, ping_interval=ping_interval)) as near,
    ):
        assert [near.recv(SOON)[0] for _ in range(100)] == list(range(100))
        for size in (1, 2**14, 2**15 + 1, len(LARGE)):
            near.send(LARGE[:size])
            assert near.recv(SOON) == LARGE[:size]
        with pytest.raises(TimeoutError):
            near.recv(0.3)  # several pings long
        near.send(b"still there")
        assert near.recv(SOON) == b"still there"


# -- nothing is left ------------------------------------------------------------------------------


def lost(url: str) -> None:
    near = opened(url)
    near.socket.shutdown(socket.SHUT_RDWR)
    ending(lambda: near.recv(SOON))
    near.recv_events_thread.join()


def dropped(url: str) -> None:
    near = opened(url, ping_interval=0.02)
    watch = near.recv_events_thread
    time.sleep(0.1)  # some turns of it
    del near
    gc.collect()
    watch.join(SOON)
    assert not watch.is_alive()


def closed(url: str) -> None:
    opened(url).close()


def refused(url: str) -> None:
    with pytest.raises(InvalidStatus):
        opened(f"{url}/refused")


@pytest.mark.parametrize("way", [lost, dropped, closed, refused])
def test_nothing_is_left(way: Callable[[str], None]) -> None:
    def door(far: ServerConnection, request: Request) -> Response | None:
        return far.respond(HTTPStatus.FORBIDDEN, "") if request.path == "/refused" else None

    def held() -> tuple[int, int]:
        return threading.active_count(), psutil.Process().num_fds()

    with serving(idle, process_request=door) as url:
        way(url)
        until(lambda: not any("watch" in thread.name for thread in threading.enumerate()))
        time.sleep(0.1)
        before = held()
        for _ in range(3):
            way(url)
        until(lambda: held() <= before)
