"""Baseline of the load test: no world and no viewer, but the same bytes to the same clients.

One thread sends every script the real server's messages 15 times a second, and every page as many
bytes as a frame has 30 times a second, in one call for all of them. The lateness of its ticks and
the age of its percepts are the cost of the machine and of the clients alone.
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
from tests.load.world import CLOCK_PERIOD_S, RAYS, SKIP, WorldReport

TICK = 1 / 60
PICTURE = 2
"""Ticks between two frames."""
FRAME_BYTES = 500, 150
"""Bytes of a frame without agents, and for each agent."""
READINGS = (
    native.Reading("clock", "box", "sfloat", "<f4", (1,), 0, b"", b"", "s", True),
    native.Reading("rays", "box", "sfloatarray", "<f4", (2 * RAYS,), 4, b"", b"", "", True),
)
OUTPUTS = (native.Output("move", "box", (-1.0,) * 4, (1.0,) * 4, True),)


class Floor:
    """All connected clients, and the ticks.

    Args:
        agents: most scripts.
    """

    def __init__(self, agents: int) -> None:
        self.late: list[float] = []
        plain = b"/bodies" + os.urandom(FRAME_BYTES[0] + agents * FRAME_BYTES[1])
        small = zstandard.compress(plain)
        sizes = (len(each).to_bytes(8, "little") for each in (plain, small))
        self._picture = b"".join((*sizes, small))
        self._pages: set[ServerConnection] = set()
        self._owed: dict[ServerConnection, int] = {}
        """Number of each script's last percept, if it was answered."""

    async def meet(self, socket: ServerConnection) -> None:
        """Serve one client until it disconnects."""
        try:
            if socket.subprotocol == REMOTE:
                await self._hear(socket)
            elif socket.subprotocol is None:  # a panel; its texts are few
                await socket.wait_closed()
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
        """Run ticks forever."""
        due, number = time.perf_counter(), 0
        while True:
            due = max(due + TICK, time.perf_counter() - MAX_LAG_S)
            await asyncio.sleep(max(due - time.perf_counter(), 0.0))
            self.late.append(time.perf_counter() - due)
            number += 1
            if number % (SKIP + 1) == 0:
                for socket, answered in self._owed.items():
                    now = np.array([time.monotonic() % CLOCK_PERIOD_S], np.float32).tobytes()
                    percept = native.Percept(
                        1, number, answered + 1, number, 0.0, {}, False, False, False, False,
                        now + bytes(8 * RAYS), (),
                    )  # fmt: skip
                    broadcast([socket], native.encode(percept))
            if number % PICTURE == 0:
                broadcast(self._pages, self._picture)


def serve_floor(agents: int, ends: Connection) -> None:
    """Serve like :func:`tests.load.world.serve`, without a world."""
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
        ends.send(WorldReport(late, used - before, {}))
        before = used
