"""Cost of a page: ``python -m tests.benchmarks.page_cost``.

Thirty bodies, eight agents with 64 rays each, 60 ticks a second. The world and its viewer have a
process of their own; the pages are bare clients of viser's socket and of the panel's, which read
everything and decode no text. The table shows the frames with moved bodies and the bytes that each
page got a second, the processor time of the serving process, and the time to draw a picture for all
pages (which other load on the machine changes least).
"""

import argparse
import json
import multiprocessing
import threading
import time
from contextlib import ExitStack, suppress
from multiprocessing.connection import Connection
from uuid import uuid4

import msgspec
import psutil
import viser
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CircleShape,
    ControlRequestor,
    LinearRayCastingSensor,
    LocalBrain,
    OrientationSensor,
    RBMoveActuator,
    TouchRewardFunc,
    World,
)
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.room import serve_world
from ai4u_edu.runtime.process_tuning import tuned_process
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot
from tests.load.clients import is_picture

AGENTS, BODIES, RAYS = 8, 30, 64


def crowd() -> ControlRequestor:
    """Return a world with eight agents that drive in circles among boxes."""
    world = World()
    world.add_floor("plate", BoxShape(size=(24, 24)))
    agents = []
    for number in range(BODIES):
        place = 4.0 * (number % 6) - 10, 4.0 * (number // 6) - 8
        name = f"body {number}"
        tags = ("robot",) if number < AGENTS else ("box",)
        world.add_body(name, CircleShape(radius=0.5), position=place, tags=tags)
        if number < AGENTS:
            agents.append(
                BasicAgent(
                    id=str(number),
                    body=name,
                    sensors=[
                        LinearRayCastingSensor(
                            perception_key="fan",
                            number_of_rays=RAYS,
                            field_of_view=180,
                            group_code={"robot": 1, "box": 2},
                        ),
                        OrientationSensor(target="body 29"),
                    ],
                    actuators=[RBMoveActuator(move_amount=2, turn_amount=2)],
                    rewards=[TouchRewardFunc(target="body 29", reward=1)],
                    brains=[
                        LocalBrain(
                            controller=lambda percept: {"move": [0.5, 0.5, 0, 0]}, skip_frame=4
                        )
                    ],
                )
            )
    return ControlRequestor(world, agents)


def serve(there: Connection) -> None:
    """Run the world until the other process ends it."""
    runner = Runner(crowd(), seed=1)
    drawn, draw = [0, 0.0], Viewer.draw

    def timed(self: Viewer, snapshot: Snapshot) -> None:
        began = time.thread_time()
        draw(self, snapshot)
        drawn[0] += 1
        drawn[1] += time.thread_time() - began

    Viewer.draw = timed  # type: ignore[method-assign]
    runner.start()
    with tuned_process(), serve_world(runner, title="Cost") as world:
        there.send(world.url)
        while there.recv() != "enough":
            there.send(tuple(drawn))
    runner.stop()


class Reader:
    """A page that counts frames of its picture, and the bytes of it and of its panel.

    Args:
        url: address of the page.
    """

    def __init__(self, url: str) -> None:
        address, page = url.replace("http", "ws", 1), uuid4()
        protocol = Subprotocol(f"viser-v{viser.__version__}")
        self._picture = connect(
            f"{address}?page={page}",
            subprotocols=[protocol],
            max_size=None,
            compression=None,
            proxy=None,
        )
        self._picture.send(msgspec.msgpack.encode(CAMERA))
        self._panel = connect(f"{address}ws/panel?page={page}", max_size=None, proxy=None)
        self._panel.send(json.dumps({"type": "show", "agent": "0", "tabs": ["agent"]}))
        self.bytes = self.frames = 0
        for read in (self._read_picture, self._read_panel):
            threading.Thread(target=read, daemon=True).start()

    def __enter__(self) -> "Reader":
        return self

    def __exit__(self, *_: object) -> None:
        self._panel.close()
        self._picture.close()

    def _read_picture(self) -> None:
        with suppress(ConnectionClosed):
            for frame in self._picture:
                assert isinstance(frame, bytes)
                self.bytes += len(frame)
                self.frames += is_picture(frame)

    def _read_panel(self) -> None:
        with suppress(ConnectionClosed):
            for text in self._panel:
                self.bytes += len(text)


CAMERA = {
    "type": "ViewerCameraMessage",
    "wxyz": (0.0, 1.0, 0.0, 0.0),
    "position": (3.0, 3.0, 3.0),
    "fov": 1.0,
    "near": 0.1,
    "far": 1000.0,
    "image_height": 800,
    "image_width": 1280,
    "look_at": (3.0, 3.0, 0.0),
    "up_direction": (0.0, 1.0, 0.0),
}


def measure(
    url: str, process: psutil.Process, here: Connection, pages: int, seconds: float
) -> tuple[float, ...]:
    """Return frames and bytes a second and page, the server's share of a core, ms a picture."""
    with ExitStack() as stack:
        readers = [stack.enter_context(Reader(url)) for _ in range(pages)]
        time.sleep(3.0)
        before = [(reader.frames, reader.bytes) for reader in readers]
        here.send("drawn")
        count, spent = here.recv()
        used, began = process.cpu_times(), time.perf_counter()
        time.sleep(seconds)
        took, now = time.perf_counter() - began, process.cpu_times()
        share = (now.user + now.system - used.user - used.system) / took
        here.send("drawn")
        drawn, drew = here.recv()
        frames = [r.frames - f for r, (f, _) in zip(readers, before, strict=True)]
        sent = [r.bytes - b for r, (_, b) in zip(readers, before, strict=True)]
    many = max(pages, 1)
    each = 1000 * (drew - spent) / max(drawn - count, 1)
    return min(frames, default=0) / took, sum(sent) / many / took, share, each


def main() -> None:
    """Run the benchmark and print its table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--pages", default="1,4,16")
    options = parser.parse_args()
    multiprocessing.set_start_method("spawn")
    here, there = multiprocessing.Pipe()
    served = multiprocessing.Process(target=serve, args=(there,), daemon=True)
    served.start()
    url = here.recv()
    process = psutil.Process(served.pid)
    print("| pages | frames/s, least | kB/s a page | server, of a core | ms to draw a picture |")
    print("|---|---|---|---|---|")
    *_, idle, _ = measure(url, process, here, 0, options.seconds)
    print(f"| 0 | | | {idle:.0%} | |")
    for pages in map(int, options.pages.split(",")):
        frames, sent, share, each = measure(url, process, here, pages, options.seconds)
        print(f"| {pages} | {frames:.0f} | {sent / 1000:.0f} | {share:.0%} | {each:.2f} |")
    here.send("enough")
    served.join(10)


if __name__ == "__main__":
    main()
