"""Cost of drawing in a class's room: ``python -m tests.benchmarks.paint_cost``.

One room of a class on this machine has a page: a bare client of viser's socket and of the panel's,
which reads everything. Its robot goes round in loops with its pen up, then in the same way with its
pen down, in turn, each time from a new start without ink. Printed: the room's processor time as a
share of a core in each turn, the pictures of ink that the page got, and the median of the pairs'
differences. The time is the room's alone, so other work on the machine changes it little; the order
of a pair alternates.
"""

import argparse
import asyncio
import json
import statistics
import tempfile
from contextlib import suppress
from itertools import cycle, islice
from pathlib import Path
from typing import Any

import psutil
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

from tests.classroom.served_class import Student, served_class
from tests.load.clients import CAMERA, page_socket, panel_socket, read_all, unpacked

HOLD_S = 0.1
COURSE = [["KeyW", "KeyA"]] * 49 + [["KeyW"]] * 12
"""A circle and a straight piece, again and again: on a floor of 9 m it meets no edge."""
SETTLE_S = 1.0
MAX_SHARE = 0.01
"""Share of a core that drawing may cost."""


class Pupil:
    """A student's page, which drives."""

    def __init__(self, student: Student) -> None:
        self._student = student
        self._sockets: list[Any] = []
        self._reading: list[asyncio.Task[None]] = []
        self._begun = 0
        self.pictures = 0
        """Pictures of ink that the page has got."""

    async def open(self) -> None:
        """Open the room's page."""
        url, headers = self._student.address, self._student.cookies
        keys = url.replace("http", "ws", 1) + "ws/input"
        self._keys = await connect(keys, additional_headers=headers, proxy=None)
        page = await page_socket(url, headers)
        await page.send(CAMERA)
        panel = self._panel = await panel_socket(url, headers)
        await panel.send(json.dumps({"type": "show", "agent": "0", "tabs": ["agent"]}))
        self._sockets = [self._keys, page, panel]
        self._reading = [asyncio.create_task(read_all(each)) for each in (self._keys, panel)]
        self._reading.append(asyncio.create_task(self._count(page)))

    async def close(self) -> None:
        """Close it."""
        for task in self._reading:
            task.cancel()
        for socket in self._sockets:
            await socket.close()

    async def begin(self) -> None:
        """Begin again, without ink."""
        await self._keys.send(json.dumps({"type": "keys", "held": []}))
        self._begun += 1
        command = {"type": "do", "id": self._begun, "command": "new_start"}
        await self._panel.send(json.dumps(command))
        await asyncio.sleep(SETTLE_S)

    async def _count(self, page: Any) -> None:
        with suppress(ConnectionClosed):
            while True:
                frame = await page.recv(decode=False)
                self.pictures += unpacked(frame).count(b"/ink/")

    async def drive(self, seconds: float, *also: str) -> None:
        """Drive for a while, with some keys held besides."""
        loop = asyncio.get_running_loop()
        end = loop.time() + seconds
        for held in cycle(COURSE):
            if loop.time() >= end:
                return
            await self._keys.send(json.dumps({"type": "keys", "held": [*held, *also]}))
            await asyncio.sleep(HOLD_S)


async def measure(student: Student, served: psutil.Process, pairs: int, seconds: float) -> None:
    """Print the shares of all turns.

    Args:
        student: has joined.
        served: the class's process, whose youngest child is the room.
        pairs: turns with the pen up, and as many with it down.
        seconds: of a turn.
    """
    pupil = Pupil(student)
    await pupil.open()
    await pupil.drive(5.0, "Space")
    room = max(served.children(recursive=True), key=psutil.Process.create_time)
    differences, shares = [], {False: list[float](), True: list[float]()}
    for is_first in islice(cycle((False, True)), pairs):
        took, rate = {}, 0.0
        for is_down in (is_first, not is_first):
            await pupil.begin()
            await pupil.drive(SETTLE_S)
            ticks, pictures = _ticks(student), pupil.pictures
            began, before = asyncio.get_running_loop().time(), room.cpu_times()
            await pupil.drive(seconds, *(["Space"] if is_down else []))
            after, end = room.cpu_times(), asyncio.get_running_loop().time()
            if not _ticks(student) - ticks > 50 * seconds:
                raise SystemExit("the robot has fallen, and the world waits")
            if is_down and pupil.pictures == pictures:
                raise SystemExit("nothing was drawn")
            used = after.user + after.system - before.user - before.system
            took[is_down] = used / (end - began)
            shares[is_down].append(took[is_down])
            if is_down:
                rate = (pupil.pictures - pictures) / (end - began)
        differences.append(took[True] - took[False])
        print(f"pen up {took[False]:.1%}, down {took[True]:.1%}, {rate:.1f} pictures/s", flush=True)
    median = statistics.median(differences)
    verdict = "within" if median <= MAX_SHARE else "more than"
    print(
        f"medians: up {statistics.median(shares[False]):.1%}, down "
        f"{statistics.median(shares[True]):.1%}; of {pairs} differences: {median:.2%} of a core, "
        f"{verdict} {MAX_SHARE:.0%}"
    )
    await pupil.close()


def _ticks(student: Student) -> int:
    return int(student.get("api/snapshot").json()["tick"])


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pairs", type=int, default=10)
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--scene", default="draw_figure")
    options = parser.parse_args()
    with (
        tempfile.TemporaryDirectory() as folder,
        served_class(Path(folder) / "class", options.scene) as served,
    ):
        student = served.joined()
        student.get("").raise_for_status()
        process = psutil.Process(served.process.pid)
        asyncio.run(measure(student, process, options.pairs, options.seconds))


if __name__ == "__main__":
    main()
