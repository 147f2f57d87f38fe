"""A Wi-Fi that can be gone for a while, between a real browser and a real server."""

import asyncio
import threading
from typing import Self
from urllib.parse import urlsplit


class Wifi:
    """Passes connections on to a server, from a thread of its own.

    While it is gone, nothing comes through and no connection is closed.

    Args:
        url: of the server.
    """

    def __init__(self, url: str) -> None:
        self._server = urlsplit(url)
        self._loop = asyncio.new_event_loop()
        self._is_there = asyncio.Event()
        self._stopping = asyncio.Event()
        self._connections: set[asyncio.Task[None]] = set()
        self._is_ready = threading.Event()
        self._thread = threading.Thread(target=self._run, name="wifi", daemon=True)
        self.url = ""
        """Address at which the server is reached."""

    def __enter__(self) -> Self:
        self._thread.start()
        self._is_ready.wait()
        return self

    def __exit__(self, *_: object) -> None:
        self._loop.call_soon_threadsafe(self._stopping.set)
        self._thread.join()

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

    def _run(self) -> None:
        self._loop.run_until_complete(self._serve())
        self._loop.close()

    async def _serve(self) -> None:
        self._is_there.set()
        server = await asyncio.start_server(self._accept, "127.0.0.1", 0)
        self.url = f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}/"
        self._is_ready.set()
        await self._stopping.wait()
        server.close()
        for task in self._connections:
            task.cancel()
        await asyncio.gather(*self._connections, return_exceptions=True)

    async def _accept(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task is not None
        self._connections.add(task)
        ends = [writer]
        try:
            await self._is_there.wait()
            place = self._server.hostname, self._server.port
            far_reader, far_writer = await asyncio.open_connection(*place)
            ends.append(far_writer)
            async with asyncio.TaskGroup() as both:
                both.create_task(self._pass_on(reader, far_writer))
                both.create_task(self._pass_on(far_reader, writer))
        except* (OSError, asyncio.CancelledError):
            pass
        finally:
            for end in ends:
                end.transport.abort()
            self._connections.discard(task)

    async def _pass_on(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        while data := await reader.read(2**16):
            await self._is_there.wait()
            writer.write(data)
            await writer.drain()
        raise ConnectionError("this end was closed")
