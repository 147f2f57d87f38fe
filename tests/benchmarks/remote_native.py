"""Round trips by our protocol and by a bare echo: ``python -m tests.benchmarks.remote_native``.

A world in lockstep, unpaced, whose agents sense 35 numbers and decide at every tick; the scripts
only answer. In turn with it, a bare echo by the same WebSocket library, with a frame of the same
size: over as many connections, and (the last column) over a single one. Eight echoes are
independent; eight agents of one world wait for each other at every tick. Each server has a process
of its own, which is suspended while the other is measured: a world would keep a core busy, and an
echo is half as fast again beside a core that is awake.
"""

import argparse
import asyncio
import math
import multiprocessing
import os
import signal
import statistics
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

from gymnasium.spaces import Box
from websockets.asyncio.client import connect as connect_async
from websockets.asyncio.server import ServerConnection
from websockets.asyncio.server import serve as serve_echo
from websockets.sync.client import connect as connect_plain

from ai4u_edu.remote import AsyncRobot, Robot, connect

FORWARD = [0.5, 0.1, 0.0, 0.0]
PERCEPT_FRAME_BYTES = 184
"""Size of a percept's frame with 35 numbers (bytes)."""


def serve_world(agents: int, ready: Connection) -> None:
    """Run a world with ``agents`` agents until the process is ended."""
    from ai4u_edu import (
        BasicAgent,
        CircleShape,
        ControlRequestor,
        LocalBrain,
        RBMoveActuator,
        Sensor,
        World,
    )
    from ai4u_edu.page.server import Rules, ServerThread, room_app
    from ai4u_edu.runtime.process_tuning import tuned_process
    from ai4u_edu.runtime.runner import Runner

    class Numbers(Sensor):
        """35 numbers."""

        def space(self) -> Box:
            return Box(-1.0, 1.0, (35,))

        def write(self, out: Any, body: Any, view: Any) -> None:
            out[0] = body.position[0] * 0.001

    world = World()
    for number in range(agents):
        world.add_body(f"robot {number}", CircleShape(radius=0.3), position=(0.0, 2.0 * number))
    crew = [
        BasicAgent(
            id=str(number),
            body=f"robot {number}",
            sensors=[Numbers()],
            actuators=[RBMoveActuator(move_amount=0.1)],
            brains=[LocalBrain(controller=lambda percept: {}, skip_frame=0)],
        )
        for number in range(agents)
    ]
    runner = Runner(ControlRequestor(world, crew), seed=1, time_scale=math.inf)
    runner.start()
    rules = Rules(lockstep=True)
    app = room_app(runner, viser_port=9, title="benchmark", rules=rules)
    with tuned_process(), ServerThread(app) as server:
        ready.send(server.url)
        ready.recv()


def serve_bare(_agents: int, ready: Connection) -> None:
    """Run an echo server until the process is ended."""

    async def echo(socket: ServerConnection) -> None:
        async for frame in socket:
            await socket.send(frame)

    async def main() -> None:
        async with serve_echo(echo, "127.0.0.1", 0, compression=None) as server:
            port = next(iter(server.sockets)).getsockname()[1]
            ready.send(f"ws://127.0.0.1:{port}")
            await asyncio.get_running_loop().run_in_executor(None, ready.recv)

    asyncio.run(main())


def decide(robot: Robot) -> None:
    robot.act(move=FORWARD)
    robot.sense()


def ours_plain(url: str, _agents: int, seconds: float) -> float:
    with connect(url, "0", mode="lockstep") as robot:
        return _timed(lambda: decide(robot), seconds)


def bare_plain(url: str, _agents: int, seconds: float) -> float:
    frame = bytes(PERCEPT_FRAME_BYTES)
    with connect_plain(url, compression=None, proxy=None) as socket:

        def there_and_back() -> None:
            socket.send(frame)
            socket.recv()

        return _timed(there_and_back, seconds)


def ours_async(url: str, agents: int, seconds: float) -> float:
    async def drive(number: int, until: Callable[[], bool]) -> int:
        count = 0
        async with AsyncRobot(url, str(number), mode="lockstep") as robot:
            while until():
                await robot.act(move=FORWARD)
                await robot.sense()
                count += 1
        return count

    return asyncio.run(_together(drive, agents, seconds))


def bare_async(url: str, agents: int, seconds: float) -> float:
    async def drive(_number: int, until: Callable[[], bool]) -> int:
        count, frame = 0, bytes(PERCEPT_FRAME_BYTES)
        async with connect_async(url, compression=None, proxy=None) as socket:
            while until():
                await socket.send(frame)
                await socket.recv()
                count += 1
        return count

    return asyncio.run(_together(drive, agents, seconds))


def ours_processes(url: str, agents: int, seconds: float) -> float:
    return _spread(ours_one, url, agents, seconds)


def bare_processes(url: str, agents: int, seconds: float) -> float:
    return _spread(bare_one, url, agents, seconds)


def ours_one(url: str, number: int, seconds: float, rate: Any, all_here: Any) -> None:
    with connect(url, str(number), mode="lockstep") as robot:
        all_here.wait()
        rate.put(_timed(lambda: decide(robot), seconds))


def bare_one(url: str, _number: int, seconds: float, rate: Any, all_here: Any) -> None:
    all_here.wait()
    rate.put(bare_plain(url, 1, seconds))


def _send(process: Any, which: signal.Signals) -> None:
    os.kill(process.pid, which)


async def _together(drive: Any, agents: int, seconds: float) -> float:
    end = time.perf_counter() + seconds
    began = time.perf_counter()
    counts = await asyncio.gather(
        *(drive(number, lambda: time.perf_counter() < end) for number in range(agents))
    )
    return float(sum(counts)) / (time.perf_counter() - began)


def _timed(once: Callable[[], object], seconds: float) -> float:
    for _ in range(100):
        once()
    began, count = time.perf_counter(), 0
    while time.perf_counter() - began < seconds:
        once()
        count += 1
    return count / (time.perf_counter() - began)


def _spread(one: Any, url: str, agents: int, seconds: float) -> float:
    rates: Any = multiprocessing.Queue()
    # begin together, so that none has the machine to itself while others start
    all_here = multiprocessing.Barrier(agents)
    scripts = [
        multiprocessing.Process(
            target=one, args=(url, number, seconds, rates, all_here), daemon=True
        )
        for number in range(agents)
    ]
    for script in scripts:
        script.start()
    found = [rates.get() for _ in scripts]
    for script in scripts:
        script.join()
    return float(sum(found))


WAYS: list[tuple[str, int, Any, Any]] = [
    ("one script that waits", 1, ours_plain, bare_plain),
    ("one asynchronous script", 1, ours_async, bare_async),
    ("eight in one asynchronous script", 8, ours_async, bare_async),
    ("eight scripts that wait", 8, ours_processes, bare_processes),
]


def main() -> None:
    """Run the benchmark and print its table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=2)
    parser.add_argument("--times", type=int, default=5)
    options = parser.parse_args()
    multiprocessing.set_start_method("spawn")
    print(f"{os.cpu_count()} cores; round trips a second, median of {options.times}")
    print("| scripts | ours | bare echoes | share | of a single echo |\n|---|---|---|---|---|")
    single: dict[bool, float] = {}
    for name, agents, ours, bare in WAYS:
        rates: dict[Any, list[float]] = {ours: [], bare: []}
        served = []
        for serve in (serve_world, serve_bare):
            here, there = multiprocessing.Pipe()
            process = multiprocessing.Process(target=serve, args=(agents, there), daemon=True)
            process.start()
            served.append((here.recv(), here, process))
            _send(process, signal.SIGSTOP)
        for _ in range(options.times):
            for measure, (url, _, process) in zip((ours, bare), served, strict=True):
                _send(process, signal.SIGCONT)
                rates[measure].append(measure(url, agents, options.seconds))
                _send(process, signal.SIGSTOP)
        for _, here, process in served:
            _send(process, signal.SIGCONT)
            here.send("end")
            process.join(10)
        mine, other = (statistics.median(rates[measure]) for measure in (ours, bare))
        one = single.setdefault(bare is bare_async, other)  # the rows with one script come first
        print(
            f"| {name} | {mine:,.0f} | {other:,.0f} | {mine / other:.0%} | {mine / one:.0%} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
