"""Pages of one world that look for changed parts at the same moment."""

import asyncio
import json
from collections import defaultdict
from typing import Any

from ai4u_edu.page.panel.socket import PanelSockets
from tests.page.panel.rooms import panel_room
from tests.waiting import LIMIT_S

PAGES = 6


def test_other_work_of_the_server_has_its_turn_between_two_pages() -> None:
    """A script's percept waits for one page, and not for thirty that each show another agent."""
    sent_at: dict[int, set[str]] = defaultdict(set)
    rounds = 0

    async def look(panel: PanelSockets, page: str, has_all: asyncio.Event) -> None:
        messages = iter([{"type": "websocket.connect"}])

        async def receive() -> Any:
            message = next(messages, None)
            return message or await asyncio.Event().wait()

        async def send(message: Any) -> None:
            if message["type"] == "websocket.send":
                part = json.loads(message["text"]).get("name")
                if part is not None:  # else a keepalive
                    sent_at[rounds].add(page)
                if part == "view":
                    has_all.set()

        scope = {"type": "websocket", "query_string": b"", "headers": [], "path": "/"}
        await panel(scope, receive, send)

    async def main(panel: PanelSockets) -> None:
        nonlocal rounds
        ready = [asyncio.Event() for _ in range(PAGES)]
        pages = [
            asyncio.create_task(look(panel, str(index), each)) for index, each in enumerate(ready)
        ]
        async with asyncio.timeout(LIMIT_S):
            while not all(each.is_set() for each in ready):
                await asyncio.sleep(0)
                rounds += 1
        for page in pages:
            page.cancel()
        await asyncio.gather(*pages, return_exceptions=True)

    with panel_room() as room:
        asyncio.run(main(PanelSockets(room.context)))
    assert [len(pages) for pages in sent_at.values()] == [1] * PAGES
