"""Load clients in processes of their own: scripts, viewers, and some that misbehave."""

import asyncio
import gc
import json
import resource
import time
from collections.abc import Mapping
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any, NamedTuple

import msgspec
import viser
import zstandard
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from ai4u_edu.remote import AsyncRobot
from ai4u_edu.wire import native

CLOCK_PERIOD_S = 256.0
VISER = Subprotocol(f"viser-v{viser.__version__}")
REMOTE = Subprotocol(native.SUBPROTOCOL)
SLOW_DECISION_S = 0.5
"""Time (s) that a slow script takes for a decision."""


class Found(NamedTuple):
    """Measurements of a process of clients."""

    ages: dict[str, list[float]]
    """Seconds from sensing to receipt of the percept, by agent."""
    frames: list[float]
    """Frames per second of each viewer that reads."""
    closes: list[tuple[int, str]]
    """Code and reason of each connection that the server closed."""
    processor: float
    """Processor time (s)."""


def brains(url: str, agents: list[int], slow: int, seconds: float, ends: Connection) -> None:
    """Drive agents; the scripts of the first ``slow`` of them decide slowly."""
    ages: dict[str, list[float]] = {str(number): [] for number in agents}

    async def drive(name: str, pause: float, end: float) -> None:
        async with AsyncRobot(url, name, mode="realtime") as robot:
            while time.monotonic() < end:
                percept = await robot.sense()
                ages[name].append((time.monotonic() - float(percept["clock"][0])) % CLOCK_PERIOD_S)
                if pause:
                    await asyncio.sleep(pause)
                await robot.act(move=[0.2, 0.5, 0.0, 0.0])

    async def main(end: float) -> None:
        await asyncio.gather(
            *(
                drive(str(number), SLOW_DECISION_S if index < slow else 0.0, end)
                for index, number in enumerate(agents)
            )
        )

    _run(main, seconds, ends, lambda: Found(ages, [], [], 0.0))


def viewers(url: str, count: int, stopped: int, seconds: float, ends: Connection) -> None:
    """Look at the page, each at another agent; the first ``stopped`` viewers never read."""
    frames = [0] * count

    async def look(number: int, end: float) -> None:
        async with page_socket(url) as page, panel_socket(url) as panel:
            await page.send(CAMERA)
            await panel.send(json.dumps({"type": "show", "agent": str(number), "tabs": ["agent"]}))
            if number < stopped:
                await asyncio.sleep(end - time.monotonic())
                page.transport.abort()
                panel.transport.abort()
                return
            reading = asyncio.create_task(read_all(panel))
            warm = end - seconds
            with suppress(TimeoutError, ConnectionClosed):
                async with asyncio.timeout(end - time.monotonic()):
                    while True:
                        frame = await page.recv(decode=False)
                        frames[number] += time.monotonic() > warm and is_picture(frame)
            reading.cancel()
            page.transport.abort()
            panel.transport.abort()

    async def main(end: float) -> None:
        await asyncio.gather(*(look(number, end) for number in range(count)))

    _run(
        main,
        seconds,
        ends,
        lambda: Found({}, [each / seconds for each in frames[stopped:]], [], 0.0),
    )


def flood(url: str, _count: int, _unused: int, seconds: float, ends: Connection) -> None:
    """One client of each socket that sends as fast as it can."""
    closes: list[tuple[int, str]] = []
    path = url.replace("http", "ws", 1)

    async def pour(socket: Any, frame: bytes | str) -> None:
        async with socket as open_socket:
            with suppress(ConnectionClosed):
                while True:
                    for _ in range(100):
                        await open_socket.send(frame)
                    await asyncio.sleep(0)
            with suppress(ConnectionClosed):
                while True:
                    await open_socket.recv()
            closes.append((open_socket.close_code or 0, open_socket.close_reason or ""))

    async def main(end: float) -> None:
        late = native.encode(native.Action(1, 1, 2**40, {"move": (1.0, 0.0, 0.0, 0.0)}))
        with suppress(TimeoutError):
            async with asyncio.timeout(end - time.monotonic()):
                await asyncio.gather(
                    pour(connect(path + "ws/input", proxy=None), '{"type": "take"}'),
                    pour(connect(path + "ws/remote", proxy=None, subprotocols=[REMOTE]), late),
                    pour(panel_socket(url), '{"type": "show", "agent": "0"}'),
                )
                # viser's socket slows down who says too much, and goes on
                await pour(page_socket(url), CAMERA)

    _run(main, seconds, ends, lambda: Found({}, [], closes, 0.0))


def is_picture(frame: bytes) -> bool:
    """Return True for a frame with moved bodies, False for one with data of a single page."""
    return b"/bodies" in unpacked(frame)


def unpacked(frame: bytes) -> bytes:
    """Return the messages of a frame of viser's socket."""
    plain, small = (int.from_bytes(frame[at : at + 8], "little") for at in (0, 8))
    return zstandard.decompress(frame[16 : 16 + small], max_output_size=plain)


def page_socket(url: str, headers: Mapping[str, str] | None = None) -> connect:
    """Return the connection to a page's picture.

    Args:
        url: of the page, with a slash at its end.
        headers: of the request, such as a cookie.
    """
    return connect(
        url.replace("http", "ws", 1),
        subprotocols=[VISER],
        additional_headers=headers,
        compression=None,
        max_size=None,
        proxy=None,
        ping_interval=None,
    )


def panel_socket(url: str, headers: Mapping[str, str] | None = None) -> connect:
    """Return the connection to a page's panel; see :func:`page_socket`."""
    return connect(
        url.replace("http", "ws", 1) + "ws/panel",
        additional_headers=headers,
        max_size=None,
        proxy=None,
    )


async def read_all(socket: Any) -> None:
    """Read what a socket sends, until it is closed."""
    with suppress(ConnectionClosed):
        async for _ in socket:
            pass


CAMERA = msgspec.msgpack.encode(
    {
        "type": "ViewerCameraMessage",
        "wxyz": (0.0, 1.0, 0.0, 0.0),
        "position": (3.0, 3.0, 160.0),
        "fov": 0.1,
        "near": 0.1,
        "far": 1000.0,
        "image_height": 800,
        "image_width": 960,
        "look_at": (3.0, 3.0, 0.0),
        "up_direction": (0.0, 1.0, 0.0),
    }
)

WARMUP_S = 6.0
"""Time (s) for all clients to connect before measurements count."""


def _run(main: Any, seconds: float, ends: Connection, found: Any) -> None:
    # in reality each script is a process, whose garbage collection delays no other one
    gc.collect()
    gc.freeze()
    begin = resource.getrusage(resource.RUSAGE_SELF)
    asyncio.run(main(time.monotonic() + WARMUP_S + seconds))
    end = resource.getrusage(resource.RUSAGE_SELF)
    used = end.ru_utime + end.ru_stime - begin.ru_utime - begin.ru_stime
    ends.send(found()._replace(processor=used))
