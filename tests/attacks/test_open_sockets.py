"""One device that opens many sockets, with a seat or without one, keeps nobody out of a class."""

import asyncio
import os
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from pathlib import Path

import httpx
import pytest
from starlette.applications import Starlette
from starlette.routing import WebSocketRoute
from websockets.exceptions import ConnectionClosed, InvalidStatus

from ai4u_edu.classroom.open_limits import MAX_SEAT_SOCKETS, MAX_STRANGER_SOCKETS
from ai4u_edu.classroom.pages import Echo
from ai4u_edu.page.server import ServerThread
from ai4u_edu.page.server.limits.concurrency_limit import ConcurrencyLimit, TooManyOpenError
from ai4u_edu.page.server.limits.connections import max_connections
from tests.attacks.programs import Crowd, many_descriptors
from tests.classroom.served_class import ServedClass, served_class
from tests.page.server import http_client
from tests.page.server.rooms import PATIENT, open_socket
from tests.waiting import LIMIT_S, Deadline, until

CROWD = 1100
UPGRADE = (
    b"GET %s HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
)
HELD_OPEN = (
    UPGRADE % b"/check/socket",
    UPGRADE % b"/link",
    UPGRADE % b"/teacher/socket",  # without a token: closed at once, but nobody answers the close
    UPGRADE % b"/r/no_room/",
    b"POST /api/join HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000\r\n\r\n{",
)
"""Beginnings of requests without a seat, after which the sender says nothing more."""


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served


@pytest.mark.slow
@pytest.mark.parametrize("paths", [["check/socket"], ["link"], ["check/socket", "link"]])
def test_an_address_has_a_number_of_sockets_without_a_seat(
    tmp_path: Path, paths: list[str]
) -> None:
    # a class without rooms: a room's link counts, too, until its hello is read
    with served_class(tmp_path) as served, ExitStack() as opened:
        for number in range(MAX_STRANGER_SOCKETS):
            path = paths[number % len(paths)]
            opened.enter_context(open_socket(served.url + path))
        for path in paths:
            assert not _is_admitted(served.url + path)
        ada = served.joined()
        assert ada.get("healthz").status_code == 200
        assert served.state()["seats"]
        opened.close()
        until(lambda: _is_admitted(served.url + "check/socket"))


@pytest.mark.slow
def test_behind_a_proxy_on_this_machine_each_address_has_its_own(served: ServedClass) -> None:
    one, another = ({"X-Forwarded-For": each} for each in ("10.9.8.7", "10.9.8.6"))
    url = served.url + "check/socket"
    with ExitStack() as opened:
        for _ in range(MAX_STRANGER_SOCKETS):
            opened.enter_context(open_socket(url, additional_headers=one))
        with pytest.raises(InvalidStatus, match="503"):
            open_socket(url, additional_headers=one)
        opened.enter_context(open_socket(url, additional_headers=another))


@pytest.mark.slow
def test_a_seat_has_a_number_of_sockets_and_others_have_theirs(served: ServedClass) -> None:
    ada, ben = served.joined(), served.joined()
    with ExitStack() as opened:
        for _ in range(MAX_SEAT_SOCKETS):
            address = ada.address + "ws/input"
            # nobody reads from them, and a close would wait behind the world's messages
            socket = open_socket(address, additional_headers=ada.cookies, max_queue=None)
            opened.enter_context(socket)
        with pytest.raises(InvalidStatus, match="503"):
            opened.enter_context(open_socket(address, additional_headers=ada.cookies))
        opened.enter_context(open_socket(ben.address + "ws/input", additional_headers=ben.cookies))


def test_a_socket_without_a_seat_ends_after_its_time() -> None:
    app = Starlette(routes=[WebSocketRoute("/", Echo(ConcurrencyLimit(1, 1.0, life_s=0.01)))])
    with (
        ServerThread(app, timeouts=PATIENT) as server,
        open_socket(server.url) as socket,
    ):
        with pytest.raises(ConnectionClosed) as closed:
            socket.recv(LIMIT_S)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1013


def test_who_has_the_most_gives_one_back_to_who_has_fewer() -> None:
    async def share_four() -> list[str]:
        limit = ConcurrencyLimit(30, 4.5 / max_connections())
        ended: list[str] = []

        async def hold(holder: str) -> None:
            try:
                async with limit.one_of(holder):
                    await asyncio.Event().wait()
            except TooManyOpenError:
                ended.append(holder)

        tasks = [asyncio.create_task(hold(each)) for each in "aaaabbbc"]
        for _ in range(5):
            await asyncio.sleep(0)
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        return ended

    # "a" has four; "b" gets two of them, but not a third, and "c" gets one
    assert sorted(asyncio.run(share_four())) == ["a", "a", "a", "b"]


@pytest.mark.alone
@pytest.mark.skipif(os.name != "posix", reason="sets limits as POSIX has them")
def test_more_held_open_than_the_server_has_connections_keep_nobody_out(
    tmp_path: Path,
) -> None:
    with many_descriptors(2 * CROWD), served_class(tmp_path) as served:
        ada = served.joined()

        async def attack() -> None:
            async with Crowd(served.url, CROWD, HELD_OPEN) as crowd:
                await crowd.until_opened(CROWD)
                await asyncio.to_thread(_use, served, dict(ada.client.cookies), ada.room)
                await crowd.until_opened(CROWD + 300)
                await asyncio.to_thread(_use, served, dict(ada.client.cookies), ada.room)

        asyncio.run(attack())
        assert "Traceback" not in "".join(served.told)


def _use(served: ServedClass, cookies: dict[str, str], room: str) -> None:
    """Ask for everything that a student, the teacher and a newcomer ask for."""
    headers = {"Cookie": "; ".join(f"{name}={value}" for name, value in cookies.items())}
    teacher = {"Authorization": f"Bearer {served.token}"}
    assert _ask(served.url + room.strip("/") + "/healthz", headers).status_code == 200
    assert _ask(served.url + "teacher/state", teacher).status_code == 200
    assert _ask(served.url + "api/names", {}).status_code == 200


def _ask(url: str, headers: dict[str, str]) -> httpx.Response:
    """Ask again if the connection was closed before it was asked anything."""
    deadline = Deadline()
    while deadline.left():
        with suppress(httpx.RemoteProtocolError, httpx.ReadError, httpx.WriteError):
            return http_client.get(url, headers=headers)
    raise AssertionError  # the deadline's own came before


def _is_admitted(url: str) -> bool:
    """Return True if a socket is opened, and stays open until a text ends it."""
    try:
        with open_socket(url) as socket:
            socket.send("x" * 200)
            socket.recv(LIMIT_S)
    except InvalidStatus:
        return False
    except ConnectionClosed as closed:
        return closed.rcvd is not None and closed.rcvd.code != 1013
    return True
