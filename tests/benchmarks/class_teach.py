"""A class in which all learn at once: ``python -m tests.benchmarks.class_teach``.

A class on this machine, and as many students, each with five drives to the box, a page and a panel
(bare clients that read everything), and a held key until the network drives. All press Learn within
ten seconds. The first ones practise by rewards as soon as their network drives (short, from that
network), so that trainings wait in the line for rewards too. Printed: when each was ready, ticks'
lateness before and meanwhile, and memory. The clients compete for the same cores.

It takes about as long as ``rooms * 5`` seconds on two idle cores, and ends after ``--minutes``,
default 10, whatever is ready then.
"""

import argparse
import asyncio
import json
import multiprocessing
import os
import tempfile
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, NamedTuple

import httpx
import numpy as np
import psutil
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

from ai4u_edu.recording import Episode
from ai4u_edu.teach.drives import FOLDER as DRIVES
from ai4u_edu.teach.drives import DriveFolder
from tests.benchmarks import tick_lateness
from tests.benchmarks.practice_lateness import AS_SERVED, listening
from tests.classroom.served_class import CODE, served_class
from tests.load.clients import CAMERA, page_socket, panel_socket, read_all
from tests.teach.driving import SEEDS, drive
from tests.waiting import until

PRESSES_S = 10.0
"""Time (s) within which all press Learn."""
BEFORE_S = 10.0
"""Time (s) before it in which ticks are measured, too."""
HOLD_S = 0.1
SHORT = 8192
"""Decisions of a short practice."""


class Ready(NamedTuple):
    """Times of a command and of its result."""

    began: float
    """Time (s) of the command."""
    ended: float | None
    """Time (s) at which the network drove; None if that took too long."""

    @property
    def seconds(self) -> float:
        """Return how long it took; infinite if it was not ready."""
        return np.inf if self.ended is None else self.ended - self.began


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rooms", type=int, default=30)
    parser.add_argument("--practices", type=int, default=6)
    parser.add_argument("--minutes", type=float, default=10.0, help="after which it ends")
    options = parser.parse_args()
    multiprocessing.set_start_method("spawn")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["AI4U_LATENESS_FOLDER"] = str(folder)
        shown = ("box_chase", "--blocks", str(tick_lateness.__file__))
        with served_class(folder / "class", *shown, replaced=AS_SERVED) as served:
            here, there = multiprocessing.Pipe()
            limit_s = 60 * options.minutes
            args = (served.url, folder / "class", options.rooms, options.practices, limit_s, there)
            clients = multiprocessing.Process(target=_clients, args=args, daemon=True)
            clients.start()
            gateway = psutil.Process(served.process.pid)
            _receive(here, limit_s)  # all rooms run
            most, learned, practised = _watch_memory(here, gateway, limit_s)
            (folder / tick_lateness.REQUEST).touch()
            files = [folder / f"{pid}.json" for pid in listening(gateway)]
            until(lambda: all(file.is_file() for file in files))
            ticks = [tick for file in files for tick in json.loads(file.read_text())]
    print(f"load average {os.getloadavg()[0]:.1f}, {os.cpu_count()} cores, {options.rooms} rooms")
    _print_ready("learned from five drives", learned)
    _print_ready("practised by rewards", practised)
    first = min(ready.began for ready in learned)
    last = max(ready.ended or ready.began for ready in [*learned, *practised])
    _print_lateness("before", ticks, first - BEFORE_S, first)
    _print_lateness("meanwhile", ticks, first, last)
    print(f"memory of class, rooms and learners, most: {most:.0f} MB")


def _print_ready(title: str, ready: Sequence[Ready]) -> None:
    if not ready:
        return
    seconds = sorted(one.seconds for one in ready)
    known = [second for second in seconds if np.isfinite(second)]
    each = ", ".join(f"{second:.1f}" for second in seconds)
    print(f"{title}, {len(known)} of {len(ready)}; ready after (s): {each}")
    if known:
        print(f"  median {np.median(known):.1f} s, last {known[-1]:.1f} s")


def _print_lateness(
    title: str, ticks: Sequence[tuple[float, float, float]], began: float, ended: float
) -> None:
    late = [1000 * late for time_s, late, _ in ticks if began <= time_s < ended]
    if late:
        p50, p99 = np.percentile(late, [50, 99])
        print(f"ticks late {title} (ms): p50 {p50:.2f}, p99 {p99:.2f}, {len(late):,} ticks")


def _watch_memory(
    end: Connection, gateway: psutil.Process, limit_s: float
) -> tuple[float, list[Ready], list[Ready]]:
    """Return the largest memory (MB) until the clients are ready, and what they found."""
    most, deadline = 0.0, time.monotonic() + limit_s + PRESSES_S + BEFORE_S + 60.0
    while not end.poll(1.0):
        if time.monotonic() > deadline:
            raise SystemExit("the clients do not answer")
        total = 0
        for process in [gateway, *gateway.children(recursive=True)]:
            with suppress(psutil.Error):
                total += process.memory_full_info().pss
        most = max(most, total / 2**20)
    learned, practised = end.recv()
    return most, learned, practised


def _receive(end: Connection, limit_s: float) -> Any:
    if not end.poll(limit_s):
        raise SystemExit("the clients do not answer")
    return end.recv()


def _clients(
    url: str, folder: Path, rooms: int, practices: int, limit_s: float, end: Connection
) -> None:
    driven = [drive(seed) for seed in SEEDS[:5]]
    students = [
        _Student(url, folder, number, number < practices, driven) for number in range(rooms)
    ]
    asyncio.run(_run(students, limit_s, end))


async def _run(students: "list[_Student]", limit_s: float, end: Connection) -> None:
    begin = asyncio.Event()
    opened = [asyncio.Event() for _ in students]
    tasks = [
        asyncio.create_task(student.run(is_open, begin, PRESSES_S * number / len(students)))
        for number, (student, is_open) in enumerate(zip(students, opened, strict=True))
    ]
    await asyncio.gather(*(is_open.wait() for is_open in opened))
    end.send(None)
    await asyncio.sleep(BEFORE_S)
    begin.set()
    done, _ = await asyncio.wait(tasks, timeout=limit_s)
    for task in done:
        task.result()  # raises what it raised
    learned = [Ready(student.pressed, student.learned) for student in students if student.pressed]
    practised = [Ready(student.asked, student.practised) for student in students if student.asked]
    end.send((learned, practised))
    for task in tasks:
        task.cancel()


class _Student:
    """A student's page in a class, without a browser."""

    def __init__(
        self, url: str, folder: Path, number: int, practises: bool, driven: Sequence[Episode]
    ) -> None:
        self._url, self._folder, self._number = url, folder, number
        self._practises, self._driven = practises, driven
        self._part: dict[str, Any] = {}
        self._changed = asyncio.Event()
        self.pressed = self.asked = 0.0
        self.learned: float | None = None
        self.practised: float | None = None

    async def run(self, is_open: asyncio.Event, begin: asyncio.Event, offset_s: float) -> None:
        """Join, drive until all do, learn, and practise then."""
        async with httpx.AsyncClient(base_url=self._url, timeout=120) as client:
            room = await self._join(client)
            drives = DriveFolder(self._folder / "rooms" / room.split("/")[2] / DRIVES)
            for episode in self._driven:
                await asyncio.to_thread(drives.add, episode)
            (await client.get(room)).raise_for_status()
            cookie = "; ".join(f"{key}={value}" for key, value in client.cookies.items())
            headers = {"Cookie": cookie}
            path = self._url.rstrip("/").replace("http", "ws", 1) + room
            async with (
                connect(path + "ws/input", additional_headers=headers, proxy=None) as keys,
                page_socket(path, headers) as page,
                panel_socket(path, headers) as panel,
            ):
                await page.send(CAMERA)
                holding = asyncio.create_task(self._hold(keys))
                reading = [
                    asyncio.create_task(task)
                    for task in (read_all(keys), read_all(page), self._follow(panel))
                ]
                await self._until(lambda part: len(part["drives"]) >= len(self._driven))
                is_open.set()
                await begin.wait()
                await asyncio.sleep(offset_s)
                numbers = [row["number"] for row in self._part["drives"] if not row["reason"]]
                self.pressed = time.monotonic()
                await self._do(panel, "teach_learn", drives=numbers)
                await self._until(lambda part: bool(part["networks"]))
                self.learned = time.monotonic()
                holding.cancel()  # the network drives
                await keys.send(json.dumps({"type": "keys", "held": []}))
                if self._practises:
                    self.asked = time.monotonic()
                    more = {"steps": SHORT, "weights": {}, "begin_with": 1}
                    await self._do(panel, "teach_practise", **more)
                    await self._until(lambda part: len(part["networks"]) == 2)
                    self.practised = time.monotonic()
                for task in reading:
                    task.cancel()

    async def _join(self, client: httpx.AsyncClient) -> str:
        """Return the path of the student's room."""
        for _ in range(5):  # others may take the names first
            names = (await client.get(f"api/names?{self._number}")).json()["names"]
            for name in names:
                body = {"code": CODE, "name": name, "request": f"benchmark-{self._number:010}"}
                answer = await client.post("api/join", json=body)
                if answer.status_code == 200:
                    return str(answer.json()["room"])
        raise SystemExit(f"a student could not join: {answer.text}")

    async def _hold(self, keys: Any) -> None:
        with suppress(ConnectionClosed):
            while True:
                await keys.send(json.dumps({"type": "keys", "held": ["KeyA"]}))
                await asyncio.sleep(HOLD_S)

    async def _do(self, panel: Any, command: str, **arguments: Any) -> None:
        await panel.send(json.dumps({"type": "do", "id": 1, "command": command, **arguments}))

    async def _follow(self, panel: Any) -> None:
        """Keep the panel's part of the tab Teach."""
        with suppress(ConnectionClosed):
            async for text in panel:
                message = json.loads(text)
                if message["type"] == "failed":
                    raise SystemExit(f"a student's command failed: {message['text']}")
                if message["type"] == "part" and message["name"] == "teach":
                    self._part = message
                    self._changed.set()

    async def _until(self, condition: Callable[[dict[str, Any]], bool]) -> None:
        while not (self._part and condition(self._part)):
            self._changed.clear()
            await self._changed.wait()


if __name__ == "__main__":
    main()
