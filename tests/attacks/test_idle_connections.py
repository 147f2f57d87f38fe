"""More idle connections than the server has descriptors keep nobody out, and fill no log."""

import asyncio
import os
from pathlib import Path

import httpx
import pytest

from tests.attacks.programs import Crowd, many_descriptors, program
from tests.server.rooms import Page

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
        assert len(server.log_lines()) <= LOG_LINES, server.log.read_text()


def _drive(url: str, page: Page) -> None:
    """Everything that those who are there, and those who come, want to do."""
    before = httpx.get(url + "api/snapshot").json()["tick"]
    for code in ("KeyW", "KeyA"):
        held: list[str] = []
        while held != [code]:
            page.hold(code)  # as a page does, which says it ten times a second
            held = page.receive("state")["held"]
    for _ in range(5):
        assert httpx.get(url + "healthz").json()["status"] == "ok"
    assert httpx.get(url).status_code == 200
    with Page(url + "ws/input") as another:
        another.receive("hello")
    while httpx.get(url + "api/snapshot").json()["tick"] <= before:
        pass
