"""Listening and ending, in real processes."""

import asyncio
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import replace
from typing import Any
from urllib.parse import urlsplit

import httpx
import pytest
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.page.server import AddressError, PortTakenError, ServerThread, serve
from ai4u_edu.page.server.limits.frames import FramesProtocol
from tests.page.server import http_client
from tests.page.server.rooms import (
    PATIENT,
    UPGRADE,
    Page,
    log_intervals,
    raw_answer,
    raw_request,
    served,
)
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.slow

PATIENT_AT_END = replace(PATIENT, shutdown=LIMIT_S)
"""Time limits of a server that would tell in its log if it waited for an app at its end."""

PROGRAM = """
import sys
from dataclasses import replace
from math import inf
import viser
from ai4u_edu import WASDRBMoveController
from ai4u_edu.blocks import Keyboard
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.page.server import room_app, serve
from tests.builders import small_sim
from tests.page.server.rooms import PATIENT
from tests.waiting import LIMIT_S

Keyboard.timeout_s = inf
# what does not end in time is told in its log
timeouts = replace(PATIENT, shutdown=LIMIT_S)
runner = Runner(small_sim(controller=WASDRBMoveController()))
runner.start()
inner = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
app = room_app(runner, viser_port=inner.get_port(), title="A room")
announce = lambda url: print("READY", url, flush=True)
serve(app, "127.0.0.1", int(sys.argv[1]), announce, timeouts=timeouts)
runner.stop(LIMIT_S)
print("ENDED", flush=True)
"""


@contextmanager
def program() -> Iterator[tuple[subprocess.Popen[str], str]]:
    """A server in a process of its own, and its address."""
    process = subprocess.Popen(
        [sys.executable, "-W", "default", "-c", PROGRAM, "0"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stdout is not None
        for line in process.stdout:
            if line.startswith("READY"):
                yield process, line.split()[1]
                break
        else:
            raise AssertionError(process.communicate()[1])
    finally:
        process.kill()
        process.communicate()


posix = pytest.mark.skipif(os.name != "posix", reason="sends signals as POSIX has them")


@posix
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_cleanly_with_pages_open(number: signal.Signals) -> None:
    with program() as (process, url):
        with Page(url + "ws/input") as page, raw_request(url, "Host: localhost", *UPGRADE):
            page.receive("hello")
            page.hold("KeyW")
            page.receive("state", held=["KeyW"])
            process.send_signal(number)
            code, _ = page.end()
            assert code == 1012, "as a server that will be back"
            out, err = process.communicate(timeout=LIMIT_S)
        assert process.returncode == 0
        assert "ENDED" in out
        assert err == ""


@posix
def test_server_stops_despite_half_requests_and_stalled_readers() -> None:
    ask = b"GET /api/openapi.json HTTP/1.1\r\nHost: localhost\r\n\r\n"
    with program() as (process, url), ExitStack() as stack:
        place = ("127.0.0.1", int(url.rstrip("/").rpartition(":")[2]))
        for said in (
            b"",
            b"GET /heal",
            b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\n\r\n",
            ask * 2000,
        ):
            connection = stack.enter_context(socket.create_connection(place))
            connection.sendall(said)
        assert connection.recv(1).startswith(b"H")
        assert http_client.get(url + "healthz").status_code == 200
        process.send_signal(signal.SIGTERM)
        out, err = process.communicate(timeout=LIMIT_S)
        assert process.returncode == 0
        assert "ENDED" in out
        assert err == ""


def test_malformed_messages_write_a_line_of_each_kind(caplog: pytest.LogCaptureFixture) -> None:
    began = time.monotonic()  # real time: for the number of lines that a log may have
    with served(timeouts=PATIENT_AT_END) as room:
        for _ in range(20):
            with room.page() as page:
                page.socket.send(b"\xff", text=True)
                assert page.end()[0] == 1007
            assert raw_answer(room.url, "no header")[0] == 400
    messages = [record.getMessage() for record in caplog.records]
    intervals = log_intervals(began)
    assert len(messages) == len(set(messages)) <= 2 * intervals
    assert sum(record.exc_info is not None for record in caplog.records) <= 1


def test_a_taken_port_is_told_with_what_to_do() -> None:
    with ServerThread(_nothing) as server:
        port = int(server.url.rstrip("/").rpartition(":")[2])
        with pytest.raises(PortTakenError) as raised:
            serve(_nothing, "127.0.0.1", port)
        assert isinstance(raised.value, AI4UError)
        assert str(raised.value) == (
            f"port {port} is taken by another program (or another AI4U Edu); "
            f"use --port 0 for a free one, or --port {port + 1}"
        )


def test_a_port_that_is_bound_but_silent_is_taken_too() -> None:
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        with pytest.raises(PortTakenError):
            ServerThread(_nothing, port=other.getsockname()[1])


@pytest.mark.parametrize("host", ["203.0.113.7", "no such host", "x" * 300])
def test_an_address_that_is_not_ours_is_told(host: str) -> None:
    with pytest.raises(AddressError, match="expected an address of this machine"):
        serve(_nothing, host, 0)


def test_a_port_is_free_again_at_once() -> None:
    port = 0
    for _ in range(4):
        with ServerThread(_nothing, port=port) as server:
            port = port or urlsplit(server.url).port or 0
            assert server.url == f"http://127.0.0.1:{port}/"
            assert http_client.get(server.url).status_code == 200


def test_the_address_can_be_opened_wherever_it_listens() -> None:
    for host, shown in [
        ("127.0.0.1", "127.0.0.1"),
        ("localhost", "localhost"),
        ("0.0.0.0", "127.0.0.1"),  # noqa: S104 - what is tested here
    ]:
        with ServerThread(_nothing, host) as server:
            assert server.url.startswith(f"http://{shown}:")
            assert http_client.get(server.url).status_code == 200


@pytest.mark.skipif(not socket.has_ipv6, reason="no IPv6")
def test_ipv6_is_written_in_brackets() -> None:
    try:
        server = ServerThread(_nothing, "::1")
    except AddressError:
        pytest.skip("no IPv6 here")
    with server:
        assert server.url.startswith("http://[::1]:")
        assert http_client.get(server.url).status_code == 200


def test_small_frames_wait_for_no_others(monkeypatch: pytest.MonkeyPatch) -> None:
    at_once = []
    meet = FramesProtocol.handle_connect

    def look(protocol: FramesProtocol, event: Any) -> None:
        end = protocol.transport.get_extra_info("socket")
        at_once.append(end.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY))
        meet(protocol, event)

    monkeypatch.setattr(FramesProtocol, "handle_connect", look)
    with served() as room, room.page():
        pass
    assert at_once
    assert all(at_once)


def test_stopping_with_pages_open_waits_for_none_and_frees_control(
    caplog: pytest.LogCaptureFixture,
) -> None:
    with served(timeouts=PATIENT_AT_END) as room:
        page = room.page()
        page.hold("KeyW")
        page.receive("seat", driver=1)
    assert caplog.records == [], "it would tell that it waited"
    assert room.held == []
    assert page.end()[0] == 1012
    until(lambda: not any(thread.name == "server" for thread in threading.enumerate()))


def test_an_answer_that_is_read_to_its_end_while_stopping_leaves_no_error(
    caplog: pytest.LogCaptureFixture,
) -> None:
    asked = threading.Semaphore(0)
    skipped = 0.0

    def large(_: Request) -> Response:
        asked.release()
        with suppress(OSError):  # until the server has begun to stop
            while True:
                socket.create_connection((parts.hostname, parts.port), LIMIT_S).close()
                # real time: a pause between two connections; else there are too many for a moment
                time.sleep(0.01)
        return Response(b"x" * 5_000_000)

    async def wait(request: Request) -> Response:
        loop = asyncio.get_running_loop()
        clock = loop.time
        loop.time = lambda: clock() + skipped  # type: ignore[method-assign]
        asked.release()
        while not await request.is_disconnected():
            await asyncio.sleep(0.01)  # real time: a pause between two looks
        return Response()

    app = Starlette(routes=[Route("/", large), Route("/wait", wait)])
    timeouts = replace(PATIENT, abort=LIMIT_S, shutdown=3 * LIMIT_S)
    with ThreadPoolExecutor(2) as pool, ExitStack() as stack:
        room = ServerThread(app, timeouts=timeouts).start()
        parts: Any = urlsplit(room.url)
        answer = pool.submit(http_client.get, room.url)
        # keeps the server until the end
        stack.enter_context(raw_request(f"{room.url}wait", "Host: localhost"))
        assert asked.acquire(timeout=LIMIT_S)
        assert asked.acquire(timeout=LIMIT_S)
        stopping = pool.submit(room.stop)
        assert len(answer.result(LIMIT_S).content) == 5_000_000
        skipped = 2.0 * LIMIT_S  # now all that is left is aborted
        stopping.result(LIMIT_S)
    assert caplog.records == []


def test_stopping_waits_for_no_worker_that_does_not_return() -> None:
    begun, goes_on = threading.Event(), threading.Event()

    def wait(_: Request) -> Response:
        begun.set()
        goes_on.wait()
        return PlainTextResponse("late")

    with ServerThread(Starlette(routes=[Route("/", wait)])) as server:
        asking = threading.Thread(target=lambda: _suppressed_get(server.url))
        asking.start()
        assert begun.wait(LIMIT_S)
        server.stop()
        assert not goes_on.is_set()
    goes_on.set()
    asking.join(LIMIT_S)
    assert not asking.is_alive()


def _suppressed_get(url: str) -> None:
    with suppress(httpx.HTTPError):
        http_client.get(url)


async def _nothing(scope: object, receive: object, send: object) -> None:
    await PlainTextResponse("fine")(scope, receive, send)  # type: ignore[arg-type]


def test_connections_that_come_while_it_ends_are_closed_too() -> None:
    for _ in range(5):  # which of them come in its last moments is chance
        with ServerThread(Starlette(), timeouts=PATIENT) as ending:
            place = urlsplit(ending.url)
            with ExitStack() as stack, ThreadPoolExecutor(1) as pool:
                knocking = pool.submit(knock, (str(place.hostname), place.port or 80), stack)
                ending.stop()
                for connection in knocking.result():
                    read_to_the_end(connection)


def knock(place: tuple[str, int], stack: ExitStack) -> list[socket.socket]:
    """Connect again and again until nobody listens."""
    made: list[socket.socket] = []
    with suppress(OSError):
        while len(made) < 2000:
            made.append(stack.enter_context(socket.create_connection(place, timeout=LIMIT_S)))
    return made


def read_to_the_end(connection: socket.socket) -> None:
    """Read until the other side has closed; one that stays open ends in a TimeoutError.

    It sends first: the system forgets, without a word, a connection whose last step of three came
    while its listener closed, and resets it with the next that comes.
    """
    with suppress(ConnectionResetError, BrokenPipeError):
        connection.sendall(b"G")
        while connection.recv(1000):  # a refusal, if there were too many
            pass
