"""A Wi-Fi that can be gone for a while, between a real browser and a real server."""

import asyncio
from collections.abc import Sequence

from tests.thread_proxy import ThreadProxy


class Wifi(ThreadProxy):
    """Passes connections on; while it is gone, nothing comes through and no connection is closed.

    Args:
        url: of the server.
    """

    def __init__(self, url: str) -> None:
        super().__init__(url)
        self._is_there = asyncio.Event()
        self._is_there.set()

    def go(self) -> None:
        """Let nothing through from now on."""
        self._loop.call_soon_threadsafe(self._is_there.clear)

    def come_back(self, *, with_connections: bool) -> None:
        """Let everything through again.

        Args:
            with_connections: with what was sent meanwhile; else all connections are broken.
        """

        def act() -> None:
            if not with_connections:
                for task in self._connections:
                    task.cancel()
            self._is_there.set()

        self._loop.call_soon_threadsafe(act)

    async def before_connection(self) -> None:
        await self._is_there.wait()

    async def direction(
        self,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        writers: Sequence[asyncio.StreamWriter],
    ) -> None:
        while data := await reader.read(2**16):
            await self._is_there.wait()
            writer.write(data)
            await writer.drain()
