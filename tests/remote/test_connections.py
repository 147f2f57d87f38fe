"""Connections of scripts, and everything that may go wrong at their other end."""

import errno
import signal
import socket
import struct
import threading
from collections.abc import Callable
from http import HTTPStatus

import psutil
import pytest
from websockets.frames import Frame, Opcode
from websockets.http11 import Request, Response
from websockets.protocol import State
from websockets.server import ServerProtocol
from websockets.sync.server import ServerConnection

from ai4u_edu.agent.block_frames import frames_of_thread
from ai4u_edu.remote.connection_options import OPTIONS, connection_lost_from
from ai4u_edu.remote.steps import ConnectionLostError
from tests.remote.bare_servers import Client, Kind, client, loss_of, raw_server, serving
from tests.remote.rooms import unused_address
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.slow

KINDS = pytest.mark.parametrize("kind", ["sync", "async"])


def echo(far: ServerConnection) -> None:
    for message in far:
        far.send(message)


def idle(far: ServerConnection) -> None:
    """Reads, and sends nothing."""
    for _ in far:
        pass


def refuse(far: ServerConnection) -> None:
    far.close(4404, "no such agent")


def frame(opcode: Opcode, data: bytes) -> bytes:
    return Frame(opcode, data).serialize(mask=False)


# -- messages -------------------------------------------------------------------------------------


@KINDS
@pytest.mark.parametrize("size", [0, 1, 126, 2**16, 2**20])
def test_a_frame_comes_back_from_an_echo(kind: Kind, size: int) -> None:
    data = bytes(range(256)) * (size // 256 + 1)
    with serving(echo) as url, client(kind, url) as near:
        for _ in range(3):
            near.send(data[:size])
            assert near.receive() == data[:size]


@KINDS
def test_text_is_taken_as_bytes(kind: Kind) -> None:
    with serving(lambda far: far.send("höre")) as url, client(kind, url) as near:
        assert near.receive() == "höre".encode()


@KINDS
def test_after_a_timeout_the_next_frame_is_received(kind: Kind) -> None:
    with serving(echo) as url, client(kind, url) as near:
        assert near.receive(0.02) is None
        near.send(b"there")
        assert near.receive() == b"there"


@KINDS
def test_an_interrupted_script_may_go_on(kind: Kind) -> None:
    script = threading.main_thread().ident
    assert script is not None

    def interrupt_what_waits() -> None:
        until(lambda: frames_of_thread(script)[-1].f_code.co_name in ("get_next_frame", "select"))
        signal.pthread_kill(script, signal.SIGINT)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with serving(echo) as url, client(kind, url) as near:
            later = threading.Thread(target=interrupt_what_waits)
            later.start()
            with pytest.raises(KeyboardInterrupt):
                near.receive()
            later.join()
            near.send(b"still there")
            assert near.receive() == b"still there"
    finally:
        signal.signal(signal.SIGINT, before)


def test_frames_before_a_close_are_received() -> None:
    def send_and_end(far: ServerConnection) -> None:
        far.send(b"one")
        far.send(b"two")

    with serving(send_and_end) as url, client("sync", url) as near:
        assert [near.receive(), near.receive()] == [b"one", b"two"]
        assert loss_of(near.receive).code == 1000


@KINDS
def test_a_message_that_is_too_large_is_the_end(
    kind: Kind, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(OPTIONS, "max_size", 1000)
    with raw_server(kind) as (near, far):
        far.sendall(frame(Opcode.BINARY, bytes(1001)))
        assert "1009" in str(loss_of(near.receive))


# -- keep-alive -----------------------------------------------------------------------------------


def test_a_ping_is_answered_while_the_script_computes() -> None:
    answered = threading.Event()

    def ping(far: ServerConnection) -> None:
        if far.ping().wait(LIMIT_S):
            answered.set()
        idle(far)

    with serving(ping) as url, client("sync", url):
        assert answered.wait(LIMIT_S)


@KINDS
def test_a_server_that_answers_pings_stays(kind: Kind, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(OPTIONS, "ping_interval", 0.02)
    with raw_server(kind) as (near, far):

        def answer_ten_pings() -> None:
            protocol = ServerProtocol(state=State.OPEN)
            answered = 0
            while answered < 10:
                protocol.receive_data(far.recv(2**12))
                far.sendall(b"".join(protocol.data_to_send()))
                frames = (each for each in protocol.events_received() if isinstance(each, Frame))
                answered += sum(each.opcode is Opcode.PING for each in frames)
            far.sendall(frame(Opcode.BINARY, b"still there"))

        answering = threading.Thread(target=answer_ten_pings)
        answering.start()
        assert near.receive() == b"still there"
        answering.join()


@KINDS
def test_a_server_that_answers_no_ping_is_lost(kind: Kind, monkeypatch: pytest.MonkeyPatch) -> None:
    # real time: both are to pass
    monkeypatch.setitem(OPTIONS, "ping_interval", 0.04)
    monkeypatch.setitem(OPTIONS, "ping_timeout", 0.1)
    with raw_server(kind) as (near, _):
        lost = loss_of(near.receive)
        assert lost.code == 0
        assert "keepalive ping timeout" in str(lost)


# -- ends -----------------------------------------------------------------------------------------


@KINDS
@pytest.mark.parametrize("noticing", ["receive", "send"])
def test_a_close_says_why(kind: Kind, noticing: str) -> None:
    with serving(refuse) as url, client(kind, url) as near:
        lost = loss_of(near.receive if noticing == "receive" else lambda: near.send(b"?"))
        assert (lost.code, str(lost)) == (4404, "no such agent")


@KINDS
def test_the_server_hears_the_goodbye(kind: Kind) -> None:
    codes: list[int | None] = []

    def listen(far: ServerConnection) -> None:
        idle(far)
        codes.append(far.close_code)

    with serving(listen) as url, client(kind, url) as near:
        near.close()
        near.close()
        for call in (lambda: near.send(b"?"), near.receive):
            with pytest.raises(ConnectionLostError, match="there is no connection"):
                call()
        until(lambda: codes == [1000])


@KINDS
def test_closing_does_not_wait_for_ever_for_a_server_that_is_silent(kind: Kind) -> None:
    with raw_server(kind) as (near, far):
        far.sendall(frame(Opcode.BINARY, b"unread"))
        near.close()
        with pytest.raises(ConnectionLostError, match="there is no connection"):
            near.receive()


@KINDS
def test_a_reset_is_the_end(kind: Kind) -> None:
    with raw_server(kind) as (near, far):
        far.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        far.close()
        assert loss_of(near.receive).code == 0


@KINDS
@pytest.mark.parametrize(
    "rubbish",
    [b"\xff" * 100, b"\x83\x00", b"\x82\x81\0\0\0\0x", b"\x80\x01x", b"HTTP/1.1 200 OK\r\n" * 9],
    ids=["opcode", "reserved", "masked", "nothing to go on with", "text"],
)
def test_rubbish_is_the_end(kind: Kind, rubbish: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(OPTIONS, "close_timeout", 0.05)
    with raw_server(kind) as (near, far):
        far.sendall(rubbish)
        assert loss_of(near.receive).code == 0


# -- opening --------------------------------------------------------------------------------------


@KINDS
def test_a_refused_handshake_says_why(kind: Kind) -> None:
    def no(far: ServerConnection, _: Request) -> Response:
        return far.respond(HTTPStatus.FORBIDDEN, "not from there\n")

    with serving(idle, process_request=no) as url:
        near = Client(kind, url)
        with pytest.raises(ConnectionLostError, match=r"^answer 403 not from there$") as found:
            near.open()
        near.end()
    assert found.value.is_permanent


@KINDS
def test_a_server_that_does_not_answer_the_handshake(kind: Kind) -> None:
    with socket.create_server(("127.0.0.1", 0)) as silent:
        near = Client(kind, f"ws://127.0.0.1:{silent.getsockname()[1]}")
        with pytest.raises(ConnectionLostError) as found:
            near.open(0.1)
        near.end()
    assert not found.value.is_permanent


@KINDS
def test_a_port_at_which_nobody_listens(kind: Kind) -> None:
    with unused_address() as address:
        near = Client(kind, f"ws://{address}")
        with pytest.raises(ConnectionLostError, match="nothing listens there") as found:
            near.open()
        near.end()
    assert not found.value.is_permanent  # a world may start there


def test_nobody_listens_at_any_address_of_a_name() -> None:
    """The name ``localhost`` has two addresses, and asyncio names both."""
    refused = f"[Errno {errno.ECONNREFUSED}] Connect call failed ('{{}}', 8080)"
    both = "Multiple exceptions: " + ", ".join(map(refused.format, ("::1", "127.0.0.1")))
    assert str(connection_lost_from(OSError(both))).endswith("nothing listens there")
    other = both.replace(str(errno.ECONNREFUSED), str(errno.ENETUNREACH), 1)
    assert str(connection_lost_from(OSError(other))) == other


# -- resources ------------------------------------------------------------------------------------


def _lose(url: str) -> None:
    with client("sync", f"{url}/lost") as near:
        loss_of(near.receive)


def _close(url: str) -> None:
    with client("sync", url):
        pass


def _be_refused(url: str) -> None:
    with pytest.raises(ConnectionLostError, match="403"):
        Client("sync", f"{url}/refused").open()


@pytest.mark.parametrize("use", [_lose, _close, _be_refused])
def test_no_thread_and_no_descriptor_is_left(use: Callable[[str], None]) -> None:
    def check(far: ServerConnection, request: Request) -> Response | None:
        return far.respond(HTTPStatus.FORBIDDEN, "") if request.path == "/refused" else None

    def serve(far: ServerConnection) -> None:
        if far.request is not None and far.request.path == "/lost":
            far.socket.shutdown(socket.SHUT_RDWR)
        idle(far)

    def resources() -> tuple[int, int]:
        return threading.active_count(), psutil.Process().num_fds()

    with serving(serve, process_request=check) as url:
        threads = threading.active_count()
        use(url)  # what is loaded once stays
        until(lambda: threading.active_count() <= threads)
        before = resources()
        for _ in range(3):
            use(url)
        until(lambda: all(now <= then for now, then in zip(resources(), before, strict=True)))
