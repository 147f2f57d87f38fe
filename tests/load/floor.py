"""The least that a server has to do: no world, no viewer, the same bytes to the same clients.

One thread says to every script 15 times a second what the real server would say, and to every page
30 times a second as many bytes as a picture has, in one call for all of them. How late its ticks
are, and how old what a script senses, is what the machine and the clients cost, before anything of
ours.
"""

import asyncio
import os
import resource
import time
from multiprocessing.connection import Connection
from threading import Thread

import numpy as np
import zstandard
from websockets.asyncio.server import ServerConnection, broadcast, serve
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from ai4u_edu.runtime.clock import MAX_LAG_S
from ai4u_edu.wire import native
from tests.load.clients import REMOTE, VISER
from tests.load.world import RAYS, ROUND, SKIP, Told

TICK = 1 / 60
PICTURE = 2
"""Ticks between two pictures."""
BYTES = 500, 150
"""Of a picture: with no agent, and for each one."""
READINGS = (
    native.Reading("clock", "box", "sfloat", "<f4", (1,), 0, b"", b"", "s", True),
    native.Reading("rays", "box", "sfloatarray", "<f4", (2 * RAYS,), 4, b"", b"", "", True),
)
OUTPUTS = (native.Output("move", "box", (-1.0,) * 4, (1.0,) * 4, True),)


class Floor:
    """Everybody who has come, and the ticks.

    Args:
        agents: how many scripts there may be.
    """

    def __init__(self, agents: int) -> None:
        self.late: list[float] = []
        plain = b"/bodies" + os.urandom(BYTES[0] + agents * BYTES[1])
        small = zstandard.compress(plain)
        sizes = (len(each).to_bytes(8, "little") for each in (plain, small))
        self._picture = b"".join((*sizes, small))
        self._pages: set[ServerConnection] = set()
        self._owed: dict[ServerConnection, int] = {}
        """The number of each script's last percept, if it has answered that."""

    async def meet(self, socket: ServerConnection) -> None:
        """One client, until it goes."""
        try:
            if socket.subprotocol == REMOTE:
                await self._hear(socket)
            else:
                self._pages.add(socket)
                await socket.wait_closed()
        except ConnectionClosed:
            pass
        finally:
            self._pages.discard(socket)
            self._owed.pop(socket, None)

    async def _hear(self, socket: ServerConnection) -> None:
        hello = native.decode(await socket.recv(decode=False))
        assert isinstance(hello, native.Hello)
        welcome = native.Welcome(
            native.VERSION, "floor", 1.0, hello.agent, hello.mode, "Floor", 60.0, SKIP, True, 0,
            (), "", READINGS, OUTPUTS,
        )  # fmt: skip
        await socket.send(native.encode(welcome))
        self._owed[socket] = 0
        async for frame in socket:
            said = native.decode(frame if isinstance(frame, bytes) else b"")
            if isinstance(said, native.Action):
                self._owed[socket] = said.seq

    async def tick(self) -> None:
        """Ticks for ever."""
        due, number = time.perf_counter(), 0
        while True:
            due = max(due + TICK, time.perf_counter() - MAX_LAG_S)
            await asyncio.sleep(max(due - time.perf_counter(), 0.0))
            self.late.append(time.perf_counter() - due)
            number += 1
            if number % (SKIP + 1) == 0:
                for socket, answered in self._owed.items():
                    now = np.array([time.monotonic() % ROUND], np.float32).tobytes()
                    percept = native.Percept(
                        1, number, answered + 1, number, 0.0, {}, False, False, False, False,
                        now + bytes(8 * RAYS), (),
                    )  # fmt: skip
                    broadcast([socket], native.encode(percept))
            if number % PICTURE == 0:
                broadcast(self._pages, self._picture)


def serve_floor(agents: int, ends: Connection) -> None:
    """As :func:`tests.load.world.serve`, without a world."""
    floor, loop = Floor(agents), asyncio.new_event_loop()

    async def main() -> None:
        options = {"compression": None, "ping_interval": None}
        async with serve(
            floor.meet,
            "127.0.0.1",
            0,
            subprotocols=[REMOTE, Subprotocol(VISER)],
            **options,  # type: ignore[arg-type]
        ) as server:
            ends.send(f"http://127.0.0.1:{next(iter(server.sockets)).getsockname()[1]}/")
            await floor.tick()

    Thread(target=loop.run_until_complete, args=(main(),), daemon=True).start()
    before = 0.0
    while ends.recv() != "end":
        late, floor.late = floor.late, []
        usage = resource.getrusage(resource.RUSAGE_SELF)
        used = usage.ru_utime + usage.ru_stime
        ends.send(Told(late, used - before, {}))
        before = used
