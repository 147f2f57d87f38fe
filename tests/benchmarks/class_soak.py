"""A class for a long time: ``python -m tests.benchmarks.class_soak --minutes 30``.

So many students with a page each drive over the edge and begin again, and lose their connection
every minute or so. Printed: how the memory of each process grows, and whether each fall that a room
counted is among the class's results. It fails if a result is lost, or if a process grows by more
than 5 MB an hour.
"""

import argparse
import asyncio
import json
import multiprocessing
import random
import sqlite3
import sys
import tempfile
import time
from contextlib import AsyncExitStack, closing, suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import psutil
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake

from tests.classroom.served_class import CODE, ServedClass, served_class
from tests.load.clients import CAMERA, VISER

SAMPLE_S = 10.0
SETTLED_FRACTION = 0.3
"""Part of the run after which memory should not grow any more."""
MAX_GROWTH_MB_PER_H = 5.0
VISIT_S = (30.0, 90.0)
AWAY_S = (0.0, 5.0)
HOLD_S = 0.1


def main() -> None:
    """Run, and print what was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rooms", type=int, default=30)
    parser.add_argument("--minutes", type=float, default=30)
    options = parser.parse_args()
    multiprocessing.set_start_method("spawn")
    with tempfile.TemporaryDirectory() as name, served_class(Path(name)) as served:
        here, there = multiprocessing.Pipe()
        args = (served.url, options.rooms, there)
        clients = multiprocessing.Process(target=_clients, args=args, daemon=True)
        clients.start()
        here.recv()
        samples = _sampled(served, 60 * options.minutes)
        here.send("end")
        visits = here.recv()
        clients.join()
        time.sleep(3)  # the last results are on their way
        is_well = _report(served, Path(name), samples, visits)
    sys.exit(0 if is_well else 1)


def _sampled(served: ServedClass, seconds: float) -> dict[int, list[tuple[float, float]]]:
    """Return seconds and memory (MB) of each process, every :data:`SAMPLE_S`."""
    found: dict[int, list[tuple[float, float]]] = {}
    root, begin = psutil.Process(served.process.pid), time.monotonic()
    while (now := time.monotonic() - begin) < seconds:
        for each in [root, *root.children(recursive=True)]:
            with suppress(psutil.Error):
                sample = now, each.memory_info().rss / 2**20
                found.setdefault(each.pid, []).append(sample)
        time.sleep(SAMPLE_S)
    return found


def _report(
    served: ServedClass, folder: Path, samples: dict[int, list[tuple[float, float]]], visits: int
) -> bool:
    slopes = []
    for pid, each in samples.items():
        times, megabytes = np.array(each).T
        is_late = times >= SETTLED_FRACTION * times[-1]
        slope = float(np.polyfit(times[is_late], megabytes[is_late], 1)[0]) * 3600
        slopes.append(slope)
        if pid == served.process.pid:
            first, last = megabytes[is_late][0], megabytes[-1]
            print(f"the class itself: {first:.1f} to {last:.1f} MB ({slope:+.1f} MB/h)")
    shown = ", ".join(f"{slope:+.1f}" for slope in sorted(slopes, reverse=True))
    print(f"{len(slopes)} processes, MB/h: {shown}")
    rooms = {room["id"]: room["falls"] for room in served.state()["rooms"]}
    with closing(sqlite3.connect(f"file:{folder / 'class.sqlite3'}?mode=ro", uri=True)) as file:
        stored = dict(
            file.execute("select room, count(*) from results where outcome = 'fell' group by room")
        )
    lost = {room: falls - stored.get(room, 0) for room, falls in rooms.items()}
    print(f"{visits} visits; {sum(rooms.values())} falls counted, {sum(stored.values())} stored")
    print(f"lost results: {sum(abs(each) for each in lost.values())}")
    return max(slopes) <= MAX_GROWTH_MB_PER_H and not any(lost.values())


def _clients(url: str, count: int, ends: Connection) -> None:
    asyncio.run(_Visitors(url, ends).main(count))


class _Visitors:
    def __init__(self, url: str, ends: Connection) -> None:
        self.url, self.ends, self.visits = url, ends, 0

    async def main(self, count: int) -> None:
        tasks = [asyncio.create_task(self._student(number)) for number in range(count)]
        await asyncio.sleep(20)
        self.ends.send("ready")
        await asyncio.to_thread(self.ends.recv)
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        self.ends.send(self.visits)

    async def _student(self, number: int) -> None:
        rng = random.Random(number)
        async with httpx.AsyncClient(base_url=self.url, timeout=60) as client:
            answer = httpx.Response(409)
            while answer.status_code != httpx.codes.OK:
                name = (await client.get("api/names")).json()["names"][0]
                body = {"code": CODE, "name": name, "request": f"benchmark-{number:010}"}
                answer = await client.post("api/join", json=body)
            path = self.url.rstrip("/").replace("http", "ws", 1) + answer.json()["room"]
            cookies = "; ".join(f"{key}={value}" for key, value in client.cookies.items())
        while True:
            self.visits += 1
            with suppress(ConnectionClosed, InvalidHandshake, OSError):
                await self._visit(path, {"Cookie": cookies}, rng.uniform(*VISIT_S))
            await asyncio.sleep(rng.uniform(*AWAY_S))

    async def _visit(self, path: str, headers: dict[str, str], seconds: float) -> None:
        """Drive, and leave without a goodbye."""
        options: dict[str, Any] = {"additional_headers": headers, "max_size": None, "proxy": None}
        async with AsyncExitStack() as stack:
            sockets = []
            for name in ("", "ws/panel", "ws/input"):
                extra: dict[str, Any] = (
                    {"subprotocols": [VISER], "compression": None} if not name else {}
                )
                socket = await connect(path + name, **options, **extra)
                stack.callback(socket.transport.abort)
                sockets.append(socket)
            page, panel, keys = sockets
            await page.send(CAMERA)
            await panel.send(json.dumps({"type": "show", "agent": "0", "tabs": ["agent"]}))
            async with asyncio.TaskGroup() as group:
                reading = [group.create_task(_read(each)) for each in (page, panel)]
                await self._drive(keys, seconds)
                for each in reading:
                    each.cancel()

    async def _drive(self, keys: ClientConnection, seconds: float) -> None:
        end, is_over = time.monotonic() + seconds, False

        async def listen() -> None:
            nonlocal is_over
            async for text in keys:
                event = json.loads(text)
                if event["type"] == "state":
                    is_over = event["terminated"] or event["truncated"]

        listening = asyncio.create_task(listen())
        try:
            while time.monotonic() < end:
                held = ["KeyR"] if is_over else ["KeyW"]
                message = json.dumps({"type": "keys", "held": held})
                await keys.send(message)
                await asyncio.sleep(HOLD_S)
                if is_over:
                    await keys.send('{"type": "keys", "held": []}')
                    await asyncio.sleep(HOLD_S)
        finally:
            listening.cancel()


async def _read(socket: ClientConnection) -> None:
    with suppress(ConnectionClosed):
        async for _ in socket:
            pass


if __name__ == "__main__":
    main()
