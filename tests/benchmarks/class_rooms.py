"""Cost of a class: ``python -m tests.benchmarks.class_rooms --rooms 30``.

A class on this machine, and as many students that join within a second. Each has a page (a bare
client of viser's socket and of the panel's, which reads everything) and holds A. Printed: the time
from a student's first request to the first tick of the driven world, ticks' lateness, pictures a
second, processor time and memory of rooms and gateway. ``--without-pages`` leaves rooms running
that nobody looks at. ``--scene draw_figure --hold "KeyW KeyA Space" "KeyW KeyD Space"`` draws; the
same without Space does not. The clients compete for the same cores; their share stands beside.
"""

import argparse
import asyncio
import json
import multiprocessing
import os
import tempfile
import time
from contextlib import suppress
from itertools import count
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import psutil
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

from tests.benchmarks import tick_lateness
from tests.classroom.served_class import CODE, ServedClass, served_class
from tests.load.clients import CAMERA, is_picture, page_socket, panel_socket, read_all

HOLD_S = 0.1
HOLDS_OF_KEYS = 9
"""Number of times that the same keys are held before the next ones."""
REST_S = 15.0
"""Time after which a room that nobody looks at stands still, with some room."""
TIMEOUT_S = 120.0


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rooms", type=int, default=30)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--without-pages", action="store_true")
    parser.add_argument("--scene", default="box_chase")
    parser.add_argument("--hold", nargs="+", default=["KeyA"], help="keys, held in turn")
    options = parser.parse_args()
    multiprocessing.set_start_method("spawn")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["AI4U_LATENESS_FOLDER"] = str(folder)
        blocks = ["--blocks", str(tick_lateness.__file__)]
        with served_class(folder / "class", options.scene, *blocks) as served:
            has_pages, keys = not options.without_pages, [each.split() for each in options.hold]
            _measure(served, folder, options.rooms, options.seconds, has_pages, keys)


def _measure(
    served: ServedClass,
    folder: Path,
    rooms: int,
    seconds: float,
    has_pages: bool,
    keys: list[list[str]],
) -> None:
    here, there = multiprocessing.Pipe()
    args = (served.url, rooms, has_pages, keys, there)
    clients = multiprocessing.Process(target=_clients, args=args, daemon=True)
    clients.start()
    starts = sorted(_receive(here))
    print(f"load average {os.getloadavg()[0]:.1f}; {rooms} rooms, pages: {has_pages}")
    print(f"join to first tick: median {np.median(starts):.1f} s, last {starts[-1]:.1f} s")
    time.sleep(3 if has_pages else REST_S)
    gateway = psutil.Process(served.process.pid)
    children = gateway.children(recursive=True)
    before = _times([gateway, *children])
    here.send("begin")
    began = time.monotonic()
    time.sleep(seconds)
    took = time.monotonic() - began
    after = _times([gateway, *children])
    (folder / tick_lateness.REQUEST).touch()
    here.send("end")
    frames, own = _receive(here)
    used = {pid: (after[pid] - before[pid]) / took for pid in after}
    shares = sorted(used[each.pid] for each in children if used.get(each.pid, 0) > 0.0005)
    memory = [each.memory_full_info().pss / 2**20 for each in [gateway, *children]]
    time.sleep(4)  # for the files
    late = [
        value
        for file in folder.glob("*.json")
        for tick_began, value, _delay in json.loads(file.read_text())
        if began <= tick_began < began + took
    ]
    if late:
        print("ticks late (ms): p50 {:.1f}, p99 {:.1f}".format(*_ms(late)))
    if has_pages:
        print(f"pictures a second: least {min(frames):.1f}, median {np.median(frames):.1f}")
    if shares:
        print(f"a room: median {np.median(shares):.1%} of a core, largest {shares[-1]:.1%}")
    print(f"all rooms {sum(shares):.2f} cores, gateway {used[gateway.pid]:.2f}, clients {own:.2f}")
    print(f"memory: {sum(memory):.0f} MB in all, gateway {memory[0]:.0f} MB")


def _ms(seconds: list[float]) -> tuple[float, float]:
    p50, p99 = np.percentile(1000 * np.array(seconds), [50, 99])
    return float(p50), float(p99)


def _times(processes: list[psutil.Process]) -> dict[int, float]:
    times = {}
    for each in processes:
        with suppress(psutil.Error):
            used = each.cpu_times()
            times[each.pid] = used.user + used.system
    return times


def _receive(end: Connection) -> Any:
    if not end.poll(TIMEOUT_S):
        raise SystemExit("the clients do not answer")
    return end.recv()


def _clients(
    url: str, count: int, has_pages: bool, keys: list[list[str]], ends: Connection
) -> None:
    asyncio.run(_Students(url, count, has_pages, keys, ends).main())


class _Students:
    def __init__(
        self, url: str, count: int, has_pages: bool, keys: list[list[str]], ends: Connection
    ) -> None:
        self.url, self.count, self.has_pages, self.ends = url, count, has_pages, ends
        self.keys = [json.dumps({"type": "keys", "held": each}) for each in keys]
        self.frames = [0] * count
        self.is_counting = False

    async def main(self) -> None:
        begun: list[asyncio.Future[float]] = [asyncio.Future() for _ in range(self.count)]
        tasks = [asyncio.create_task(self._student(*each)) for each in enumerate(begun)]
        self.ends.send(await asyncio.gather(*begun))
        await asyncio.to_thread(self.ends.recv)
        self.is_counting, before = True, time.process_time()
        began = time.monotonic()
        await asyncio.to_thread(self.ends.recv)
        took = time.monotonic() - began
        rates = [each / took for each in self.frames]
        self.ends.send((rates, (time.process_time() - before) / took))
        for task in tasks:
            task.cancel()

    async def _student(self, number: int, begun: "asyncio.Future[float]") -> None:
        first = time.monotonic()
        async with httpx.AsyncClient(base_url=self.url, timeout=60) as client:
            names = (await client.get(f"api/names?{number}")).json()["names"]
            answer = None
            for name in names * 5:
                body = {"code": CODE, "name": name, "request": f"benchmark-{number:010}"}
                answer = await client.post("api/join", json=body)
                if answer.status_code == 200:
                    break
                names = (await client.get("api/names")).json()["names"]
            assert answer is not None
            room = answer.json()["room"]
            (await client.get(room)).raise_for_status()
            cookie = "; ".join(f"{key}={value}" for key, value in client.cookies.items())
            path = self.url.rstrip("/").replace("http", "ws", 1) + room
            headers = {"Cookie": cookie}
            async with connect(path + "ws/input", additional_headers=headers, proxy=None) as keys:
                reading = [asyncio.create_task(read_all(keys))]
                await keys.send(self.keys[0])
                while (await client.get(room + "api/snapshot")).json()["tick"] == 0:
                    await asyncio.sleep(0.05)
                begun.set_result(time.monotonic() - first)
                if not self.has_pages:
                    return
                sockets = await self._open_page(path, headers)
                reading += [asyncio.create_task(read_all(sockets[1]))]
                reading += [asyncio.create_task(self._count(sockets[0], number))]
                for sent in count():
                    await keys.send(self.keys[sent // HOLDS_OF_KEYS % len(self.keys)])
                    await asyncio.sleep(HOLD_S)

    async def _open_page(self, path: str, headers: dict[str, str]) -> list[Any]:
        page = await page_socket(path, headers)
        panel = await panel_socket(path, headers)
        await page.send(CAMERA)
        await panel.send(json.dumps({"type": "show", "agent": "0", "tabs": ["agent"]}))
        return [page, panel]

    async def _count(self, page: Any, number: int) -> None:
        with suppress(ConnectionClosed):
            while True:
                frame = await page.recv(decode=False)
                if self.is_counting:
                    self.frames[number] += is_picture(frame)


if __name__ == "__main__":
    main()
