"""Cost of a class for rooms elsewhere: ``python -m tests.benchmarks.class_links --rooms 100``.

As many links as there are students' own machines: each sends a drawing, poses four times a second,
a state every two seconds, and a result every five. One teacher's page follows all of them on its
socket. Printed: processor time and memory of the class's process, messages to the teacher a second,
and the time from a result to its acknowledgement, which comes when it is on disk.
"""

import argparse
import asyncio
import json
import math
import multiprocessing
import tempfile
import time
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import psutil
from websockets.asyncio.client import connect
from websockets.typing import Subprotocol

from ai4u_edu.wire.class_link import (
    HEARTBEAT_S,
    POSES_PER_S,
    SUBPROTOCOL,
    VERSION,
    Ack,
    BodyDrawing,
    Drawing,
    DrawnShape,
    ExerciseResult,
    LinkHello,
    Poses,
    State,
    decode_from_class,
    encode_from_room,
)
from tests.classroom.served_class import CODE, served_class

RESULT_S = 5.0
BODIES = 12


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rooms", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=20)
    options = parser.parse_args()
    multiprocessing.set_start_method("spawn")
    with tempfile.TemporaryDirectory() as folder, served_class(Path(folder) / "class") as served:
        here, there = multiprocessing.Pipe()
        args = (served.url, served.token, options.rooms, there)
        multiprocessing.Process(target=_clients, args=args, daemon=True).start()
        here.recv()
        time.sleep(2)
        gateway = psutil.Process(served.process.pid)
        here.send("begin")
        before, began = gateway.cpu_times(), time.monotonic()
        time.sleep(options.seconds)
        after, took = gateway.cpu_times(), time.monotonic() - began
        here.send("end")
        told, acks = here.recv()
        used = after.user + after.system - before.user - before.system
        print(f"{options.rooms} links: {used / took:.0%} of a core, ", end="")
        print(f"{gateway.memory_info().rss / 2**20:.0f} MB")
        print(f"to the teacher: {told / took:.1f} messages a second")
        p50, p99 = np.percentile(1000 * np.array(acks), [50, 99])
        print(f"results acknowledged after (ms): p50 {p50:.1f}, p99 {p99:.1f}, {len(acks)} of them")


def _clients(url: str, token: str, count: int, ends: Connection) -> None:
    asyncio.run(_Links(url, token, count, ends).main())


class _Links:
    def __init__(self, url: str, token: str, count: int, ends: Connection) -> None:
        self.url, self.token, self.count, self.ends = url, token, count, ends
        self.told = 0
        self.acks: list[float] = []
        self.sent: dict[str, float] = {}

    async def main(self) -> None:
        secrets = [await self._join(number) for number in range(self.count)]
        tasks = [asyncio.create_task(self._link(*each)) for each in enumerate(secrets)]
        tasks.append(asyncio.create_task(self._teach()))
        await asyncio.sleep(1)
        self.ends.send("ready")
        await asyncio.to_thread(self.ends.recv)
        self.told, self.acks = 0, []
        await asyncio.to_thread(self.ends.recv)
        self.ends.send((self.told, self.acks))
        for task in tasks:
            task.cancel()

    async def _join(self, number: int) -> str:
        async with httpx.AsyncClient(base_url=self.url, timeout=60) as client:
            name = (await client.get("api/names")).json()["names"][0]
            body = {"code": CODE, "name": name, "request": f"benchmark-{number:010}"}
            (await client.post("api/join", json=body)).raise_for_status()
            cookies = client.cookies.items()  # each class has a name of its own for it
            return next(value for name, value in cookies if name.startswith("ai4u_edu_seat"))

    async def _teach(self) -> None:
        path = self.url.replace("http", "ws", 1) + "teacher/socket"
        headers = {"Authorization": f"Bearer {self.token}"}
        async with connect(path, additional_headers=headers, max_size=None, proxy=None) as wall:
            async for text in wall:
                json.loads(text)
                self.told += 1

    async def _link(self, number: int, secret: str) -> None:
        path = self.url.replace("http", "ws", 1) + "link"
        async with connect(
            path, subprotocols=[Subprotocol(SUBPROTOCOL)], max_size=None, proxy=None
        ) as link:
            await link.send(encode_from_room(LinkHello(VERSION, secret, "room")))
            await link.send(encode_from_room(_drawing()))
            await asyncio.gather(
                self._poses(link, number),
                self._states(link),
                self._results(link, number),
                self._read(link),
            )

    async def _poses(self, link: Any, number: int) -> None:
        await asyncio.sleep(number / self.count / POSES_PER_S)
        while True:
            phase = time.monotonic() + number
            values = [
                value
                for body in range(BODIES)
                for value in (round(math.sin(phase + body), 3), round(math.cos(phase), 3), 0.5, 1)
            ]
            await link.send(encode_from_room(Poses(1, tuple(values))))
            await asyncio.sleep(1 / POSES_PER_S)

    async def _states(self, link: Any) -> None:
        while True:
            seconds = round(time.monotonic() % 1000, 1)
            state = State("driving", "Box chase", "A person", seconds, 1, 0, False)
            await link.send(encode_from_room(state))
            await asyncio.sleep(HEARTBEAT_S)

    async def _results(self, link: Any, number: int) -> None:
        await asyncio.sleep(number / self.count * RESULT_S)
        while True:
            key = f"key-{number}-{time.monotonic_ns()}"
            self.sent[key] = time.monotonic()
            await link.send(encode_from_room(ExerciseResult(key, "04.2", "wrong", "04.2/narrow")))
            await asyncio.sleep(RESULT_S)

    async def _read(self, link: Any) -> None:
        async for frame in link:
            message = decode_from_class(frame)
            if isinstance(message, Ack):
                self.acks.append(time.monotonic() - self.sent.pop(message.key))


def _drawing() -> Drawing:
    square = (-4.0, -4.0, 4.0, -4.0, 4.0, 4.0, -4.0, 4.0)
    body = BodyDrawing("body", False, (DrawnShape("#0072b2", 0.4, (0.0, 0.0)),))
    return Drawing(
        1, (-4.0, -4.0, 4.0, 4.0), (DrawnShape("#e4e8ec", 0.0, square),), (body,) * BODIES
    )


if __name__ == "__main__":
    main()
