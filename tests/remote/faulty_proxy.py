"""A bad network: a proxy between a real client and a real server, that does to frames what it may.

It knows just enough of WebSocket to tell frames apart. Frames of the application may be dropped, be
sent twice or overtake each other; everything may be late, come byte by byte, stall, break off, or
vanish with both ends still open.
"""

import asyncio
import random
import socket
import struct
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

from tests.thread_proxy import Direction, ThreadProxy


@dataclass(frozen=True)
class Faults:
    """Probability of each fault per frame, and its size."""

    drop: float = 0.0
    duplicate: float = 0.0
    reorder: float = 0.0
    latency: float = 0.0
    """Longest random delay (s)."""
    single_bytes: float = 0.0
    stall: float = 0.0
    stall_seconds: float = 2.0
    reset: float = 0.0
    half_open: float = 0.0


class FaultyProxy(ThreadProxy):
    """A proxy in a thread of its own, in front of a server.

    Args:
        url: of the server.
        faults: what may happen.
        seed: seed of the random faults.
    """

    def __init__(self, url: str, faults: Faults, seed: int = 1) -> None:
        super().__init__(url)
        self._faults = faults
        self._chance = random.Random(seed)
        self.happened: Counter[str] = Counter()

    async def before_connection(self) -> None:
        self.happened["connection"] += 1

    def direction(
        self,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        writers: Sequence[asyncio.StreamWriter],
    ) -> Direction:
        return _Direction(self, reader, writer, writers).run()

    def happens(self, what: str, share: float) -> bool:
        """Throws the dice."""
        if self._chance.random() >= share:
            return False
        self.happened[what] += 1
        return True


class _Direction:
    """One direction of one connection."""

    def __init__(
        self,
        proxy: FaultyProxy,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        writers: Sequence[asyncio.StreamWriter],
    ) -> None:
        self._proxy = proxy
        self._faults = proxy._faults
        self._reader = reader
        self._writer = writer
        self._writers = writers
        self._writing = asyncio.Lock()
        self._overtaken: set[asyncio.Task[None]] = set()

    async def run(self) -> None:
        with suppress(asyncio.IncompleteReadError, OSError):
            self._writer.write(await self._reader.readuntil(b"\r\n\r\n"))  # the handshake
            try:
                while True:
                    await self._pass(*await self._frame())
            finally:
                for task in self._overtaken:
                    task.cancel()

    async def _frame(self) -> tuple[int, bytes]:
        """The next frame: its kind, and all its bytes."""
        head = await self._reader.readexactly(2)
        size, more = head[1] & 0x7F, b""
        if size >= 126:
            more = await self._reader.readexactly(2 if size == 126 else 8)
            size = int.from_bytes(more, "big")
        mask = 4 if head[1] & 0x80 else 0
        return head[0] & 0x0F, head + more + await self._reader.readexactly(mask + size)

    async def _pass(self, kind: int, frame: bytes) -> None:
        proxy, faults = self._proxy, self._faults
        if kind != 2:  # pings and farewells are the connection's own
            await self._write(frame)
            return
        proxy.happened["frame"] += 1
        if proxy.happens("reset", faults.reset):
            for writer in self._writers:
                raw: socket.socket = writer.get_extra_info("socket")
                raw.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                writer.transport.abort()
            raise OSError("reset")
        if proxy.happens("half-open", faults.half_open):
            # real time: nothing goes this way any more, and nobody is told
            await asyncio.sleep(3600)
        if proxy.happens("stall", faults.stall):
            # real time: the fault; a longer one is worse, and no test expects how long it takes
            await asyncio.sleep(faults.stall_seconds)
        if proxy.happens("drop", faults.drop):
            return
        if proxy.happens("reorder", faults.reorder):
            task = asyncio.create_task(self._late(frame))
            self._overtaken.add(task)
            task.add_done_callback(self._overtaken.discard)
            return
        if faults.latency:
            # real time: see above
            await asyncio.sleep(proxy._chance.uniform(0.0, faults.latency))
        await self._write(frame)
        if proxy.happens("duplicate", faults.duplicate):
            await self._write(frame)

    async def _late(self, frame: bytes) -> None:
        # real time: see above
        await asyncio.sleep(self._proxy._chance.uniform(0.02, 0.4))
        with suppress(OSError):
            await self._write(frame)

    async def _write(self, frame: bytes) -> None:
        async with self._writing:
            if self._proxy.happens("single bytes", self._faults.single_bytes):
                for byte in frame:
                    self._writer.write(bytes([byte]))
                    await self._writer.drain()
                    await asyncio.sleep(0)
            else:
                self._writer.write(frame)
                await self._writer.drain()
