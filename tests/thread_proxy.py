"""A proxy in front of a server, in a thread of its own; what it does to data is its subclass's."""

import asyncio
import socket
import threading
from collections.abc import Coroutine, Sequence
from contextlib import suppress
from typing import Self
from urllib.parse import urlsplit

Direction = Coroutine[None, None, None]


class ThreadProxy:
    """Opens a connection to the server for each of its own, and breaks both when one ends.

    Args:
        url: of the server.
    """

    def __init__(self, url: str) -> None:
        self._port = urlsplit(url).port
        self._loop = asyncio.new_event_loop()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.url = f"http://127.0.0.1:{self._listener.getsockname()[1]}/"
        self._thread = threading.Thread(target=self._run, name="proxy", daemon=True)
        self._stopping = asyncio.Event()
        self._connections: set[asyncio.Task[None]] = set()
        self._writers: list[asyncio.StreamWriter] = []
        """Both ends of connections that are over."""

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._loop.call_soon_threadsafe(self._stopping.set)
        self._thread.join()

    def _run(self) -> None:
        self._loop.run_until_complete(self._serve())
        self._loop.close()

    async def _serve(self) -> None:
        server = await asyncio.start_server(self._accept, sock=self._listener)
        await self._stopping.wait()
        while left := asyncio.all_tasks() - {asyncio.current_task()}:
            for task in self._connections:
                task.cancel()
            await asyncio.gather(*left, return_exceptions=True)
        server.close()  # not while it accepts a connection, which would stay open
        closed = [each.wait_closed() for each in self._writers]
        await asyncio.gather(*closed, return_exceptions=True)
        await asyncio.sleep(0)  # connections that were just opened close in the loop's next turn

    def _accept(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        writers = [writer]
        task = self._loop.create_task(self._connect(reader, writers))

        def end(_: object) -> None:
            for each in writers:
                each.transport.abort()
            self._writers += writers
            self._connections.discard(task)

        self._connections.add(task)
        task.add_done_callback(end)  # it may be cancelled before it begins, and while it ends

    async def _connect(
        self, reader: asyncio.StreamReader, writers: list[asyncio.StreamWriter]
    ) -> None:
        both: list[asyncio.Task[None]] = []
        with suppress(OSError):  # the server may not be there
            try:
                await self.before_connection()
                far_reader, far_writer = await asyncio.open_connection("127.0.0.1", self._port)
                writers.append(far_writer)
                both = [
                    asyncio.create_task(self.direction(reader, far_writer, writers)),
                    asyncio.create_task(self.direction(far_reader, writers[0], writers)),
                ]
                await asyncio.wait(both, return_when=asyncio.FIRST_COMPLETED)
            finally:
                for each in both:
                    each.cancel()
                await asyncio.gather(*both, return_exceptions=True)

    async def before_connection(self) -> None:
        """Do what comes before a connection to the server is opened."""

    def direction(
        self,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        writers: Sequence[asyncio.StreamWriter],
    ) -> Direction:
        """Pass data on in one direction until one end is closed.

        Args:
            reader: gives the data.
            writer: gets it.
            writers: of both ends.
        """
        raise NotImplementedError  # each proxy has its own
