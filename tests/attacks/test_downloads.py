"""A whole class downloads at once: the page drives on, and nothing is made that nobody wants."""

import asyncio
import os
from pathlib import Path

import httpx
import pytest

from tests.attacks.programs import program
from tests.page.server import http_client
from tests.page.server.rooms import Page
from tests.waiting import until

COUNT = 45
EPISODES = 4
ENDINGS = ("gif", "mp4", "html", "csv")

pytestmark = [
    pytest.mark.alone,
    pytest.mark.skipif(os.name != "posix", reason="ends a server as POSIX does"),
]


def test_a_page_drives_on_and_the_server_ends_at_once(tmp_path: Path) -> None:
    with program(tmp_path, episodes=EPISODES) as server, Page(server.url + "ws/input") as page:
        page.receive("hello")

        async def attack() -> tuple[int, str]:
            async with http_client.AsyncClient(base_url=server.url, limits=MANY) as client:
                wanted = [
                    f"api/past/{1 + number % EPISODES}.{ENDINGS[number % len(ENDINGS)]}"
                    for number in range(COUNT)
                ]
                downloads = [asyncio.create_task(client.get(path)) for path in wanted]
                await asyncio.wait(downloads, return_when=asyncio.FIRST_COMPLETED)
                await asyncio.to_thread(_drive, server.url, page)
                for each in downloads[::2]:
                    each.cancel()  # they hang up
                await asyncio.to_thread(_drive, server.url, page)
                ended = await asyncio.to_thread(server.terminate)
                answers = await asyncio.gather(*downloads, return_exceptions=True)
            for answer in answers:
                assert isinstance(answer, asyncio.CancelledError | httpx.HTTPError) or (
                    answer.status_code in (200, 503)  # type: ignore[union-attr]
                )
            return ended

        status, said = asyncio.run(attack())
        assert status == 0
        assert said.startswith("ENDED\n")
        assert server.log_lines() == []


MANY = httpx.Limits(max_connections=COUNT)


def _drive(url: str, page: Page) -> None:
    before = http_client.get(url + "api/snapshot").json()["tick"]
    page.send("let_go")
    page.receive("state", held=[])
    page.hold("KeyW")
    page.receive("state", held=["KeyW"])
    for _ in range(5):
        assert http_client.get(url + "healthz").json()["status"] == "ok"
    assert http_client.get(url).status_code == 200
    until(lambda: http_client.get(url + "api/snapshot").json()["tick"] > before)
