"""More idle connections than the server has descriptors keep nobody out, and fill no log."""

import asyncio
import os
import time
from contextlib import suppress
from pathlib import Path

import httpx
import pytest

from tests.attacks.programs import Crowd, many_descriptors, program
from tests.page.server import http_client
from tests.page.server.rooms import Page, log_intervals
from tests.waiting import Deadline, until

IDLE = (
    b"",
    b"GET /heal",
    b"GET / HTTP/1.1\r\nHost: localhost\r\nX-Slow: ",
    b"POST /healthz HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000\r\n\r\nx",
)
COUNT = 1100
LOG_LINES = 36

pytestmark = [
    pytest.mark.alone,
    pytest.mark.skipif(os.name != "posix", reason="sets limits as POSIX has them"),
]


def test_a_page_drives_on_and_new_ones_come_in(tmp_path: Path) -> None:
    with (
        many_descriptors(2 * COUNT),
        program(tmp_path) as server,
        Page(server.url + "ws/input") as page,
    ):
        page.receive("hello")
        began = time.monotonic()  # real time: for the number of lines that a log may have

        async def attack() -> tuple[int, str]:
            async with Crowd(server.url, COUNT, IDLE) as crowd:
                await crowd.until_opened(COUNT)
                await asyncio.to_thread(_drive, server.url, page)
                await crowd.until_opened(COUNT + 300)  # the idle ones were closed, and came again
                await asyncio.to_thread(_drive, server.url, page)
                return await asyncio.to_thread(server.terminate)

        status, said = asyncio.run(attack())
        assert status == 0
        assert said.startswith("ENDED\n")
        assert len(server.log_lines()) <= LOG_LINES * log_intervals(began), server.log.read_text()


def _drive(url: str, page: Page) -> None:
    """Everything that those who are there, and those who come, want to do."""
    before = ask(url + "api/snapshot").json()["tick"]
    for code in ("KeyW", "KeyA"):
        page.hold(code)
        page.receive("state", held=[code])
    for _ in range(5):
        assert ask(url + "healthz").json()["status"] == "ok"
    assert ask(url).status_code == 200
    with Page(url + "ws/input") as another:
        another.receive("hello")
    until(lambda: ask(url + "api/snapshot").json()["tick"] > before)


def ask(url: str) -> httpx.Response:
    """Ask again if the server has closed the connection before it was asked anything.

    To the server, a client that stands still after it has connected is idle as well.
    """
    deadline = Deadline()
    while deadline.left():
        with suppress(httpx.RemoteProtocolError, httpx.ReadError, httpx.WriteError):
            return http_client.get(url)
    raise AssertionError  # the deadline's own came before
